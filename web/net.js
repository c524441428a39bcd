// SPDX-License-Identifier: MIT
// Single role: reads the control net that the exporter wrote into the page. The element's text is base64 of, all of it
// little-endian: float64 position[vertices][3], float64 offset[offsets][3], int32 faceStart[faces + 1], int32 corner[corners],
// int32 cap[caps][4].

export function decodeBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export function readNet(element) {
  const count = (name) => Number(element.dataset[name]);
  const net = {
    nVertices: count('vertices'), nFaces: count('faces'), nCorners: count('corners'), nOffsets: count('offsets'),
    nCaps: count('caps'), bytes: decodeBase64(element.textContent),
  };
  net.offsetAt = 24 * net.nVertices;
  net.faceStartAt = net.offsetAt + 24 * net.nOffsets;
  net.cornerAt = net.faceStartAt + 4 * (net.nFaces + 1);
  net.capAt = net.cornerAt + 4 * net.nCorners;
  if (net.bytes.length !== net.capAt + 16 * net.nCaps) throw new Error('The control net of this page is damaged.');
  net.position = new Float64Array(net.bytes.buffer, 0, 3 * net.nVertices);
  net.faceStart = new Int32Array(net.bytes.buffer, net.faceStartAt, net.nFaces + 1);
  net.corner = new Int32Array(net.bytes.buffer, net.cornerAt, net.nCorners);
  return net;
}

/* Curves on the surface, or null where the page holds none: float64 position[points][3], int32 line[lines][2],
   uint8 colour[points][3]. */
export function readCurves(element) {
  if (!element) return null;
  const nPoints = Number(element.dataset.points), nLines = Number(element.dataset.lines);
  const bytes = decodeBase64(element.textContent), lineAt = 24 * nPoints, colourAt = lineAt + 8 * nLines;
  if (bytes.length !== colourAt + 3 * nPoints) throw new Error('The curves of this page are damaged.');
  return {
    position: new Float64Array(bytes.buffer, 0, 3 * nPoints),
    line: new Uint32Array(bytes.buffer, lineAt, 2 * nLines),
    colour: bytes.subarray(colourAt),
  };
}

/* Pairs of vertices, every edge once: [2 edges]. */
export function netEdges(net) {
  const seen = new Set();
  const pairs = [];
  for (let f = 0; f < net.nFaces; f++) {
    const start = net.faceStart[f], end = net.faceStart[f + 1];
    for (let h = start; h < end; h++) {
      const a = net.corner[h], b = net.corner[h + 1 < end ? h + 1 : start];
      const key = Math.min(a, b) * net.nVertices + Math.max(a, b);
      if (!seen.has(key)) pairs.push(a, b);
      seen.add(key);
    }
  }
  return new Uint32Array(pairs);
}
