// SPDX-License-Identifier: MIT
// three's GLTFLoader with its DRACOLoader, as a web page uses them. They expect a browser: workers, a file loader and
// pictures are given to them here, the decoder and its worker are three's own.
import fs from 'node:fs';
import { resolveObjectURL } from 'node:buffer';
import { Worker as Thread } from 'node:worker_threads';

globalThis.self ??= globalThis;
globalThis.ProgressEvent ??= class extends Event {};
globalThis.createImageBitmap ??= async () => ({ width: 256, height: 1, close() {} });

// The script comes by the URL of a blob; what it expects of its surroundings is put before it.
globalThis.Worker ??= class {
  constructor(url) {
    this.thread = resolveObjectURL(url).text().then((script) => {
      const thread = new Thread(
        `const { parentPort } = require('node:worker_threads');
         globalThis.self = globalThis;
         globalThis.postMessage = (message, transfer) => parentPort.postMessage(message, transfer);
         parentPort.on('message', (data) => onmessage({ data }));\n` + script, { eval: true });
      thread.on('message', (data) => this.onmessage({ data }));
      thread.on('error', (error) => { throw error; });
      return thread;
    });
  }
  postMessage(message, transfer) { this.thread.then((thread) => thread.postMessage(message, transfer)); }
  terminate() { this.thread.then((thread) => thread.terminate()); }
};

const THREE = await import('three');
const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
const { DRACOLoader } = await import('three/addons/loaders/DRACOLoader.js');

// The decoder is a file of the package instead of an address.
class LocalDracoLoader extends DRACOLoader {
  async _loadLibrary(name, responseType) {
    const file = fs.readFileSync(new URL(`node_modules/three/examples/jsm/libs/draco/gltf/${name.split('/').pop()}`, import.meta.url));
    return responseType === 'arraybuffer' ? file.buffer.slice(file.byteOffset, file.byteOffset + file.length) : file.toString();
  }
}

export async function readWithThree(bytes) {
  const loader = new GLTFLoader().setDRACOLoader(new LocalDracoLoader());
  const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
  const parts = [];
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse((object) => {
    if (!object.isMesh) return;
    const { geometry } = object;
    geometry.computeBoundingBox();
    parts.push({
      vertices: geometry.attributes.position.count,
      triangles: geometry.index.count / 3,
      min: geometry.boundingBox.min.toArray(),
      max: geometry.boundingBox.max.toArray(),
      attributes: Object.keys(geometry.attributes).sort(),
      hasPicture: object.material.map !== null,
      up: new THREE.Vector3(0, 0, 1).transformDirection(object.matrixWorld).toArray(), // where z of the file shows
    });
  });
  return { parts };
}
