// SPDX-License-Identifier: MIT
// Numbers of the page against those of the library on the same net: curvature, and the file that it offers.
import { readFileSync } from 'node:fs';
import { ensure, makePage, openPage, settle, takeDownload, withBrowser } from './browser.mjs';

async function chooseSteps(page, n) {
  await page.locator('#steps').fill(String(n));
  await page.locator('#steps').dispatchEvent('change');
  await settle(page);
}

/* Nets as they are, and faired ones whose caps have inner coefficients. 100 vertices: positions, normals and four curvatures, to 1e-5 of the largest principal curvature (its square for K). */
export async function curvature(tools) {
  await withBrowser(tools, {}, async (context) => {
    for (const [mesh, steps, iterations] of [['pipe', 5, 2], ['genus2', 4, 0], ['hull', 6, 0], ['star7', 8, 2]]) {
      const { path, facts } = makePage(tools, mesh, String(steps), String(iterations));
      const { page, ready, complaints } = await openPage(context, path);
      ensure(ready === 'yes', `the page of ${mesh} did not draw: ${complaints.join('; ')}`);
      ensure((facts.coefficients > 0) === (iterations > 0), `${mesh}: ${facts.coefficients} inner coefficients of caps`);
      await chooseSteps(page, steps);
      const shown = await page.evaluate((vertices) => {
        const { triangles: t } = globalThis.fairsurf;
        const row = (array, n, v) => [...array.slice(n * v, n * v + n)];
        return {
          vertices: t.nVertices, triangles: t.nTriangles,
          points: vertices.map((v) => ({
            position: row(t.position, 3, v), normal: row(t.normal, 3, v), curvature: row(t.curvature, 4, v),
          })),
        };
      }, facts.points.map((p) => p.vertex));
      ensure(shown.vertices === facts.vertices && shown.triangles === facts.triangles,
        `${mesh}: ${shown.vertices} vertices and ${shown.triangles} triangles, not ${facts.vertices} and ${facts.triangles}`);
      const worst = { position: 0, normal: 0, curvature: 0 };
      facts.points.forEach((point, i) => {
        for (const what of Object.keys(worst))
          point[what].forEach((x, k) => {
            const unit = what !== 'curvature' ? 1 : k === 1 ? facts.largest ** 2 : facts.largest;
            const difference = Math.abs(x - shown.points[i][what][k]) / unit;
            worst[what] = Number.isNaN(difference) ? Infinity : Math.max(worst[what], difference);
          });
      });
      console.log(`${mesh}: ${facts.points.length} points, ${facts.coefficients} inner coefficients,`,
        `largest principal curvature ${facts.largest.toPrecision(5)};`,
        `differences: position ${worst.position.toExponential(1)}, normal ${worst.normal.toExponential(1)},`,
        `curvature ${worst.curvature.toExponential(1)} of it`);
      ensure(facts.points.length === 100, 'there are not 100 points');
      ensure(worst.curvature <= 1e-5 && worst.position <= 1e-9 && worst.normal <= 1e-9,
        `${mesh}: the page differs from the library`);
      await page.close();
    }
  });
}

function readObj(text) {
  const v = [], vn = [], f = [];
  for (const line of text.split('\n')) {
    const [key, ...rest] = line.split(' ');
    if (key === 'v') v.push(rest.map(Number));
    if (key === 'vn') vn.push(rest.map(Number));
    if (key === 'f') f.push(rest.map((corner) => corner.split('//').map(Number)));
  }
  return { v, vn, f };
}

export async function download(tools) {
  const { path, facts } = makePage(tools, 'genus2', '3', '0');
  await withBrowser(tools, {}, async (context) => {
    const { page, requests } = await openPage(context, path);
    await chooseSteps(page, 3);
    const file = await takeDownload(page);
    ensure(file.suggestedFilename() === 'genus2-3.obj', `the file is called ${file.suggestedFilename()}`);
    const text = readFileSync(await file.path(), 'utf8'), obj = readObj(text);
    ensure(text.startsWith('# genus2-3: make_page\n'), 'the first line does not say where the file comes from');
    ensure(obj.v.length === facts.vertices && obj.vn.length === facts.vertices && obj.f.length === facts.triangles,
      `${obj.v.length} vertices, ${obj.vn.length} normals, ${obj.f.length} triangles`);
    for (const { vertex, position, normal } of facts.points)
      ensure([[position, obj.v], [normal, obj.vn]].every(([a, b]) => a.every((x, k) => Math.abs(x - b[vertex][k]) < 1e-9)),
        `vertex ${vertex} of the file is not that of the library`);
    const sides = new Map();
    for (const corners of obj.f)
      corners.forEach(([a, n], k) => {
        ensure(a === n && a >= 1 && a <= facts.vertices, 'a corner is out of range');
        const key = `${a} ${corners[(k + 1) % 3][0]}`;
        sides.set(key, (sides.get(key) ?? 0) + 1);
      });
    const isPaired = (key) => sides.get(key) === 1 && sides.has(key.split(' ').reverse().join(' '));
    for (const key of sides.keys()) ensure(isPaired(key), `edge ${key} is open or doubled`);
    ensure(requests.every((url) => /^(file|blob):/.test(url)), `requests: ${requests.join(', ')}`);
    console.log(`${obj.f.length} triangles, closed and oriented; ${facts.points.length} vertices are those of the library`);
  });
}
