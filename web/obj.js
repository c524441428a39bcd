// SPDX-License-Identifier: MIT
// Single role: triangles as the text of an OBJ file, in full precision, with normals; in pieces, so that no string is long.

export function writeObj(triangles, comment) {
  const { nVertices, nTriangles, position, normal, corner } = triangles;
  const pieces = [`# ${comment.replace(/[\r\n]+/g, ' ')}\n`];
  let lines = [];
  const flush = () => {
    pieces.push(lines.join(''));
    lines = [];
  };
  const vectors = (keyword, array) => {
    for (let v = 0; v < nVertices; v++) {
      lines.push(`${keyword} ${array[3 * v]} ${array[3 * v + 1]} ${array[3 * v + 2]}\n`);
      if (lines.length === 4096) flush();
    }
  };
  vectors('v', position);
  vectors('vn', normal);
  for (let t = 0; t < nTriangles; t++) {
    const [a, b, c] = [corner[3 * t] + 1, corner[3 * t + 1] + 1, corner[3 * t + 2] + 1];
    lines.push(`f ${a}//${a} ${b}//${b} ${c}//${c}\n`);
    if (lines.length === 4096) flush();
  }
  flush();
  return pieces;
}
