// SPDX-License-Identifier: MIT
// Single role: the surface of a control net, made by fairsurf's core compiled to WebAssembly (entry.c).

export async function openSurface(wasm, net) {
  const { instance } = await WebAssembly.instantiate(wasm, {});
  const core = instance.exports;
  core._initialize();
  const copy = (Kind, address, length) => new Kind(core.memory.buffer, address, length).slice();

  const message = () => {
    const bytes = new Uint8Array(core.memory.buffer, core.page_message(page));
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  };
  const check = (status) => {
    if (status !== 0) throw new Error(message());
  };

  const page = core.page_create();
  const block = core.allocate(net.bytes.length);
  if (page === 0 || block === 0) throw new Error('There is not enough memory for this surface.');
  new Uint8Array(core.memory.buffer, block, net.bytes.length).set(net.bytes);
  check(core.page_open(page, net.nVertices, block, net.nFaces, block + net.faceStartAt, block + net.cornerAt, net.nCaps,
    block + net.capAt, net.nOffsets, block + net.offsetAt));
  core.release(block);

  return {
    nPatches: core.page_n_patches(page),
    /* n x n quadrilaterals per patch: position, normal [3 vertices], curvature [4 vertices], corner [3 triangles]. */
    tessellate(n) {
      check(core.page_tessellate(page, n));
      const nVertices = core.page_n_vertices(page), nTriangles = core.page_n_triangles(page);
      return {
        nVertices, nTriangles,
        position: copy(Float64Array, core.page_positions(page), 3 * nVertices),
        normal: copy(Float64Array, core.page_normals(page), 3 * nVertices),
        curvature: copy(Float64Array, core.page_curvatures(page), 4 * nVertices),
        corner: copy(Uint32Array, core.page_corners(page), 3 * nTriangles),
      };
    },
  };
}
