// SPDX-License-Identifier: MIT
// What three readers say about GLB files: readers.mjs FILE... prints one line of JSON per file. The packages lie beside it.
import fs from 'node:fs';
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import draco3d from 'draco3d';
import validator from 'gltf-validator';
import { readWithThree } from './three_reader.mjs';

const io = new NodeIO()
  .registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({ 'draco3d.decoder': await draco3d.createDecoderModule() });

async function validate(bytes) {
  const report = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 20 });
  return report.issues;
}

// Sums over all primitives; the box is that of the decoded numbers.
async function readWithTransform(bytes) {
  const root = (await io.readBinary(new Uint8Array(bytes))).getRoot();
  const found = { parts: [], extensions: root.listExtensionsRequired().map((e) => e.extensionName), images: 0 };
  found.images = root.listTextures().length;
  for (const mesh of root.listMeshes())
    for (const primitive of mesh.listPrimitives()) {
      const position = primitive.getAttribute('POSITION'), indices = primitive.getIndices().getArray();
      found.parts.push({
        vertices: position.getCount(),
        triangles: indices.length / 3,
        largest: indices.reduce((a, b) => Math.max(a, b), 0),
        min: position.getMin([]),
        max: position.getMax([]),
        attributes: Object.fromEntries(
          primitive.listSemantics().map((name) => [name, primitive.getAttribute(name).getCount()])),
      });
    }
  return found;
}

for (const file of process.argv.slice(2)) {
  const bytes = fs.readFileSync(file);
  console.log(JSON.stringify({
    file,
    validator: await validate(bytes),
    transform: await readWithTransform(bytes),
    three: await readWithThree(bytes),
  }));
}
process.exit(0); // the workers of the decoder would wait for more
