// SPDX-License-Identifier: MIT
// Turning and zooming with real events of mouse, wheel, keys and fingers; gliding, and none where motion is reduced.
import { cameraOf, countDifferences, ensure, exportPage, openCoarse, settle, takePicture, withBrowser } from './browser.mjs';

/* In degrees, precise for small ones too; EXACT is what repeated rounding of a camera at rest may add up to. */
const EXACT = 1e-9;
function angle({ position: a }, { position: b }) {
  const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  return (180 / Math.PI) * Math.atan2(cross, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/* What acting does to the camera, and to the picture. */
async function observe(tools, page, name, act) {
  const before = await takePicture(tools, page, `${name}-before`), start = await cameraOf(page);
  await act();
  await settle(page);
  const end = await cameraOf(page), after = await takePicture(tools, page, `${name}-after`);
  const seen = { turn: angle(start, end), zoom: end.distance / start.distance, pixels: countDifferences(tools, before, after) };
  console.log(`${name}: turned ${seen.turn.toFixed(1)} degrees, distance x ${seen.zoom.toFixed(3)},`,
    `${seen.pixels} pixels changed`);
  return seen;
}

async function drag(page, from, to, button = 'left') {
  await page.mouse.move(...from);
  await page.mouse.down({ button });
  const at = (t, k) => from[k] + t * (to[k] - from[k]);
  for (let k = 1; k <= 5; k++) await page.mouse.move(at(k / 5, 0), at(k / 5, 1));
  await page.mouse.up({ button });
}

export async function mouse(tools) {
  await withBrowser(tools, {}, async (context) => {
    const { page } = await openCoarse(context, exportPage(tools, 'pipe'));
    let seen = await observe(tools, page, 'drag', () => drag(page, [550, 250], [650, 280]));
    ensure(seen.turn > 10 && Math.abs(seen.zoom - 1) < EXACT && seen.pixels > 2000, 'dragging does not turn');
    seen = await observe(tools, page, 'wheel-in', () => page.mouse.wheel(0, -300));
    ensure(seen.zoom < 0.9 && seen.turn < 0.01 && seen.pixels > 2000, 'the wheel does not zoom in');
    seen = await observe(tools, page, 'wheel-out', () => page.mouse.wheel(0, 600));
    ensure(seen.zoom > 1.1 && seen.turn < 0.01, 'the wheel does not zoom out');
    seen = await observe(tools, page, 'move', () => drag(page, [550, 250], [600, 250], 'right'));
    ensure(seen.pixels > 2000, 'the right button does not move the model');
    await page.getByRole('button', { name: 'Reset view' }).click();
    seen = await observe(tools, page, 'no-event', () => page.mouse.move(400, 300));
    ensure(seen.turn < EXACT && Math.abs(seen.zoom - 1) < EXACT && seen.pixels === 0,
      'moving the mouse with no button down changes the view');
  });
}

export async function keyboard(tools) {
  await withBrowser(tools, {}, async (context) => {
    const { page } = await openCoarse(context, exportPage(tools, 'pipe'));
    const first = await takePicture(tools, page, 'keys-start');
    for (const [name, key, test] of [
      ['left', 'ArrowLeft', (s) => s.turn > 4], ['right', 'ArrowRight', (s) => s.turn > 4],
      ['up', 'ArrowUp', (s) => s.turn > 4], ['down', 'ArrowDown', (s) => s.turn > 4],
      ['plus', '+', (s) => s.zoom < 0.9 && s.turn < 0.01], ['minus', '-', (s) => s.zoom > 1.1 && s.turn < 0.01],
    ]) {
      const seen = await observe(tools, page, `key-${name}`, () => page.keyboard.press(key));
      const isClean = !key.startsWith('Arrow') || Math.abs(seen.zoom - 1) < EXACT;
      ensure(test(seen) && isClean && seen.pixels > 1000, `the key ${key} does not do its work`);
    }
    /* Each of these undid the one before. */
    ensure(countDifferences(tools, first, await takePicture(tools, page, 'keys-back')) <= 50, 'turning back does not lead back');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('0');
    ensure(countDifferences(tools, first, await takePicture(tools, page, 'keys-reset')) === 0, 'key 0 does not reset the view');
    for (const [key, mode] of [['2', 'zebra'], ['3', 'isophotes'], ['4', 'curvature'], ['1', 'shaded']]) {
      await page.keyboard.press(key);
      ensure((await page.evaluate(() => document.documentElement.dataset.mode)) === mode, `key ${key} does not show ${mode}`);
      ensure(await page.locator(`#modes input[value=${mode}]`).isChecked(), `key ${key} does not choose ${mode}`);
    }
    await page.keyboard.press('n');
    ensure(await page.getByLabel('Control net').isChecked(), 'key n does not show the net');
    /* In a control, arrows belong to it. */
    await page.locator('#steps').focus();
    const start = await cameraOf(page);
    const n = Number(await page.locator('#steps').inputValue());
    await page.keyboard.press('ArrowLeft');
    await settle(page);
    ensure(Number(await page.locator('#steps').inputValue()) === n - 1, 'arrows do not move the slider');
    ensure(angle(start, await cameraOf(page)) < EXACT, 'arrows in a slider turn the model');
    const shown = await page.evaluate(() => {
      const { steps, triangles, surface } = globalThis.fairsurf;
      return [steps, triangles.nTriangles, surface.nPatches];
    });
    ensure(shown[0] === n - 1 && shown[1] === 2 * (n - 1) ** 2 * shown[2], 'the resolution does not follow the slider');
    /* More stripes: another picture. */
    await page.locator('#canvas').focus();
    await page.keyboard.press('2');
    const few = await takePicture(tools, page, 'stripes-12');
    await page.locator('#stripes').fill('30');
    ensure(countDifferences(tools, few, await takePicture(tools, page, 'stripes-30')) > 2000, 'the stripes stay as they are');
  });
}

export async function touch(tools) {
  const options = { viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 };
  await withBrowser(tools, options, async (context) => {
    const { page } = await openCoarse(context, exportPage(tools, 'pipe'));
    const session = await context.newCDPSession(page);
    const send = (type, ...points) => session.send('Input.dispatchTouchEvent',
      { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    let seen = await observe(tools, page, 'finger', async () => {
      await send('touchStart', [150, 250]);
      for (let k = 1; k <= 5; k++) await send('touchMove', [150 + 20 * k, 250 + 4 * k]);
      await send('touchEnd');
    });
    ensure(seen.turn > 10 && Math.abs(seen.zoom - 1) < EXACT && seen.pixels > 2000, 'a finger does not turn');
    seen = await observe(tools, page, 'pinch', async () => {
      await send('touchStart', [170, 250], [220, 250]);
      for (let k = 1; k <= 5; k++) await send('touchMove', [170 - 10 * k, 250], [220 + 10 * k, 250]);
      await send('touchEnd');
    });
    ensure(seen.zoom < 0.8 && seen.pixels > 2000, 'two fingers do not zoom');
  });
}

/* Where the camera stands in the frames after an event: it glides on, or it jumps where motion is reduced. */
async function countSteps(page, type, act) {
  await page.evaluate((type) => {
    globalThis.steps = new Promise((done) => {
      const { camera } = globalThis.fairsurf.scene.orbit, seen = new Set();
      let frames = 60;
      const next = () => {
        seen.add(camera.position.x.toFixed(9)); /* the last digits are those of rounding */
        if (frames-- > 0) requestAnimationFrame(next);
        else done(seen.size - 1);
      };
      addEventListener(type, next, { once: true, capture: true });
    });
  }, type);
  await act();
  return page.evaluate(() => globalThis.steps);
}

export async function motion(tools) {
  await withBrowser(tools, {}, async (context) => {
    const path = exportPage(tools, 'star5');
    for (const [reducedMotion, glides] of [['no-preference', true], ['reduce', false]]) {
      const page = await context.newPage();
      await page.emulateMedia({ reducedMotion });
      await openCoarse(context, path, page);
      const key = await countSteps(page, 'keydown', () => page.keyboard.press('ArrowLeft'));
      const release = await countSteps(page, 'pointerup', () => drag(page, [500, 250], [600, 260]));
      console.log(`${reducedMotion}: a key turns the model in ${key} steps; after a drag ${release} steps follow`);
      ensure(glides ? key > 5 && release > 5 : key === 1 && release <= 1,
        `with ${reducedMotion} the model does not ${glides ? 'glide' : 'jump'}`);
      await page.close();
    }
  });
}
