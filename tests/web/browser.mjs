// SPDX-License-Identifier: MIT
// What the browser tests share: making pages, opening them in headless Chromium from file://, pictures, and failing.
import { execFileSync, spawnSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { existsSync, mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

export const SKIPPED = 77;
const chromiumPath = process.env.CHROMIUM ?? '/usr/bin/chromium';
const flags = [
  '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
  '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--force-color-profile=srgb', '--hide-scrollbars',
];

export function readArguments() {
  const [modules, fairsurf, makePage, compare, meshes, references, out, name] = process.argv.slice(2);
  mkdirSync(out, { recursive: true });
  return { modules, fairsurf, makePage, compare, meshes, references, out, name };
}

export function skipWithoutBrowser() {
  if (existsSync(chromiumPath)) return;
  console.log(`skipped: there is no ${chromiumPath}`);
  process.exit(SKIPPED);
}

export function ensure(condition, message) {
  if (!condition) throw new Error(message);
}

/* A page of the mesh, by the command line. */
export function exportPage(tools, mesh, name = mesh, ...options) {
  const path = join(tools.out, `${name}.html`);
  execFileSync(tools.fairsurf, ['export', join(tools.meshes, `${mesh}.obj`), '-q', '-o', path, ...options]);
  return path;
}

/* A page of the mesh with what the library says about it. */
export function makePage(tools, mesh, steps, iterations) {
  const path = join(tools.out, `${mesh}-${steps}.html`);
  const given = [join(tools.meshes, `${mesh}.obj`), path, steps, iterations];
  const text = execFileSync(tools.makePage, given, { maxBuffer: 1 << 26 });
  return { path, facts: JSON.parse(text) };
}

/* Calls use(context) with a fresh browser; options as those of playwright's contexts. */
export async function withBrowser(tools, options, use) {
  const { chromium } = createRequire(resolve(tools.modules, 'package.json'))('playwright-core');
  const folder = mkdtempSync(join(tmpdir(), 'fairsurf-web-'));
  const context = await chromium.launchPersistentContext(folder, {
    executablePath: chromiumPath, headless: true, args: flags, viewport: { width: 800, height: 500 }, reducedMotion: 'reduce',
    colorScheme: 'light', ...options,
  });
  try {
    return await use(context);
  } finally {
    await context.close();
    rmSync(folder, { recursive: true, force: true });
  }
}

/* The page, in a given window or a new one, once it has drawn, with what it asked for and what it complained about. */
export async function openPage(context, path, given = null) {
  const page = given ?? (await context.newPage()), requests = [], complaints = [];
  page.on('request', (request) => requests.push(request.url()));
  page.on('console', (message) => complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.goto(pathToFileURL(path).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, { timeout: 60000 });
  const ready = await page.evaluate(() => document.documentElement.dataset.ready);
  return { page, requests, complaints, ready };
}

/* A page with few triangles: drawing without a graphics card takes half a second of work for a picture of many. */
export async function openCoarse(context, path, given = null) {
  const opened = await openPage(context, path, given);
  await opened.page.locator('#steps').evaluate((slider) => {
    slider.value = 3; /* hidden on phones, so not by hand */
    for (const event of ['input', 'change']) slider.dispatchEvent(new Event(event));
  });
  await settle(opened.page);
  return opened;
}

/* Lets drawing come to rest: a few frames after the last event. */
export async function settle(page) {
  await page.evaluate(() => new Promise((done) => {
    let frames = 4;
    const next = () => (frames-- > 0 ? requestAnimationFrame(next) : done());
    next();
  }));
}

/* A picture of the surface alone. */
export async function takePicture(tools, page, name) {
  await page.addStyleTag({ content: '.bare #panel, .bare header { visibility: hidden }' });
  await page.evaluate(() => document.documentElement.classList.add('bare'));
  await settle(page);
  const path = join(tools.out, `${name}.png`);
  await page.screenshot({ path });
  await page.evaluate(() => document.documentElement.classList.remove('bare'));
  return path;
}

/* How many pixels differ by more than the tolerance, of 255. */
export function countDifferences(tools, a, b, tolerance = 8, ...rest) {
  const result = spawnSync(tools.compare, [a, b, '--tolerance', String(tolerance), ...rest], { encoding: 'utf8' });
  const found = /(\d+) pixels/.exec(result.stdout);
  ensure(found, `the pictures ${a} and ${b} cannot be compared: ${result.stdout}${result.stderr}`);
  return Number(found[1]);
}

export const cameraOf = (page) => page.evaluate(() => {
  const { camera } = globalThis.fairsurf.scene.orbit;
  return { position: camera.position.toArray(), distance: camera.position.length() };
});

/* The file that the page offers. */
export async function takeDownload(page) {
  const coming = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Download OBJ' }).click();
  return coming;
}
