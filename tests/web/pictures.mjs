// SPDX-License-Identifier: MIT
// Pictures of the four modes against references, and that the comparison sees a control point that moved.
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { countDifferences, ensure, exportPage, openPage, settle, takePicture, withBrowser } from './browser.mjs';

const ALLOWED = 200; /* pixels of 400 000: other versions of the browser may round edges differently */

const shots = [
  ['pipe', 'shaded'], ['pipe', 'zebra'], ['pipe', 'isophotes'], ['pipe', 'curvature'], ['pipe', 'net'],
  ['genus2', 'zebra'], ['hull', 'curvature'],
];

async function choose(page, what) {
  await page.getByLabel('Control net').setChecked(what === 'net');
  await page.locator(`#modes input[value=${what === 'net' ? 'shaded' : what}]`).check({ force: true });
  await settle(page);
}

export async function modes(tools) {
  await withBrowser(tools, {}, async (context) => {
    let opened = null, last = null;
    for (const [mesh, what] of shots) {
      if (mesh !== last) opened = await openPage(context, exportPage(tools, mesh));
      last = mesh;
      ensure(opened.ready === 'yes', `the page of ${mesh} did not draw: ${opened.complaints.join('; ')}`);
      await choose(opened.page, what);
      const name = `${mesh}-${what}`, reference = join(tools.references, `${name}.png`);
      const picture = await takePicture(tools, opened.page, name);
      if (process.env.UPDATE === '1') copyFileSync(picture, reference);
      const shown = ['--difference', join(tools.out, `${name}-difference.png`)];
      const n = countDifferences(tools, reference, picture, 8, ...shown);
      console.log(`${mesh} ${what}: ${n} pixels differ`);
      ensure(n <= ALLOWED, `${mesh} ${what}: ${n} pixels differ from the reference, ${ALLOWED} are allowed`);
      ensure(opened.complaints.length === 0, `the page complains: ${opened.complaints.join('; ')}`);
    }
  });
}

/* One inner coordinate of the net in the page moved: the picture must fail the comparison that it passed above. */
export async function moved(tools) {
  const path = exportPage(tools, 'pipe'), changed = join(tools.out, 'changed.html');
  const page = readFileSync(path, 'utf8').replace(/(id="net"[^>]*>)([^<]*)/, (_, tag, text) => {
    const bytes = Buffer.from(text, 'base64');
    const n = Number(/data-vertices="(\d+)"/.exec(tag)[1]), read = (v, k) => bytes.readDoubleLE(24 * v + 8 * k);
    let top = 0; /* the upper vertex that is nearest to the z axis */
    const distance = (v) => Math.hypot(read(v, 0), read(v, 1));
    for (let v = 0; v < n; v++) if (read(v, 2) > 0 && distance(v) < distance(top)) top = v;
    bytes.writeDoubleLE(read(top, 2) + 0.1, 24 * top + 16);
    return tag + bytes.toString('base64');
  });
  writeFileSync(changed, page);
  await withBrowser(tools, {}, async (context) => {
    const { page } = await openPage(context, changed);
    await choose(page, 'zebra');
    const n = countDifferences(tools, join(tools.references, 'pipe-zebra.png'), await takePicture(tools, page, 'changed'));
    console.log(`${n} pixels differ`);
    ensure(n > ALLOWED, `a moved control point changes ${n} pixels only`);
  });
}
