// SPDX-License-Identifier: MIT
// The page as a document: its title, size, requests, phones, and what it says where it cannot work.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { ensure, exportPage, openPage, takeDownload, withBrowser } from './browser.mjs';

export async function limits(tools) {
  const bytes = readFileSync(exportPage(tools, 'pipe'));
  const net = /<script type="text\/plain" id="net"[^>]*>([^<]*)<\/script>/.exec(bytes.toString('latin1'));
  const bare = Buffer.from(bytes.toString('latin1').replace(net[1], ''), 'latin1');
  const zipped = gzipSync(bare, { level: 9 }).length;
  console.log(`${bytes.length} bytes: the net ${net[1].length}, the rest ${bare.length}, ${zipped} by gzip`);
  ensure(bare.length < 900000 && zipped < 400000, 'the page is too large');
  ensure(bytes.includes('three.js authors') && bytes.includes('Permission is hereby granted'), 'the notices are missing');
  const core = /id="core">([^<]*)</.exec(bytes.toString('latin1'))[1];
  const module = await WebAssembly.compile(Buffer.from(core, 'base64'));
  ensure(WebAssembly.Module.imports(module).length === 0, 'the core imports something');
  await withBrowser(tools, {}, async (context) => {
    const all = [];
    context.on('request', (request) => all.push(request.url()));
    const { page, ready, complaints } = await openPage(context, join(tools.out, 'pipe.html'));
    for (const key of ['2', '3', '4', 'n', '+', 'ArrowLeft']) await page.keyboard.press(key);
    await page.locator('#more').evaluate((more) => (more.open = true));
    await page.getByText('About', { exact: true }).click();
    ensure(await page.getByText('three.js authors').isVisible(), 'the notices are not shown');
    await page.waitForTimeout(500);
    console.log(`requests: ${all.length}`);
    ensure(ready === 'yes' && complaints.length === 0, `the page complains: ${complaints.join('; ')}`);
    ensure(all.length === 1 && all[0].endsWith('/pipe.html'), `the page asked for ${all.join(', ')}`);
    /* The policy of the page forbids what it does not need anyway. */
    const fetched = await page.evaluate(() => fetch('data:,x').then(() => true, () => false));
    ensure(!fetched, 'a script in the page could ask the network');
  });
}

export async function title(tools) {
  const names = ['plain', 'a <b>&amp; "quoted" \'ß\' 曲面', '</title><script>document.title = 1</script>', '$& $1 @NET@'];
  await withBrowser(tools, {}, async (context) => {
    for (const name of names) {
      const path = exportPage(tools, 'cube', 'title', '--name', name);
      const { page, ready } = await openPage(context, path);
      ensure(ready === 'yes', `with the name ${name} the page does not draw`);
      ensure((await page.title()) === name, `the title is ${await page.title()}, not ${name}`);
      ensure((await page.locator('h1').textContent()) === name, `the heading is not ${name}`);
      await page.close();
    }
    exportPage(tools, 'cube', 'given name');
    const { page } = await openPage(context, join(tools.out, 'given name.html'));
    ensure((await page.title()) === 'given name', `the title is ${await page.title()}, not that of the file`);
    exportPage(tools, 'cube', 'scene', '--scene', 'isophote');
    const second = await openPage(context, join(tools.out, 'scene.html'));
    ensure(await second.page.getByLabel('Isophotes').isChecked(), '--scene does not choose what is shown first');
  });
}

export async function phone(tools) {
  const handheld = { hasTouch: true, isMobile: true, deviceScaleFactor: 1 };
  const path = exportPage(tools, 'pipe');
  await withBrowser(tools, handheld, async (context) => {
    for (const [width, height] of [[390, 780], [320, 568], [780, 360]]) {
      const page = await context.newPage();
      await page.setViewportSize({ width, height });
      const { ready } = await openPage(context, path, page);
      ensure(ready === 'yes', 'the page does not draw');
      await page.screenshot({ path: join(tools.out, `phone-${width}x${height}.png`) });
      await page.locator('label', { hasText: 'Curvature' }).first().tap();
      ensure((await page.evaluate(() => document.documentElement.dataset.mode)) === 'curvature', 'tapping does not choose a mode');
      await page.getByText('More', { exact: true }).tap();
      await page.screenshot({ path: join(tools.out, `phone-${width}x${height}-open.png`) });
      const facts = await page.evaluate(() => {
        const box = (e) => e.getBoundingClientRect().toJSON();
        return {
          overflow: document.documentElement.scrollWidth - innerWidth, panel: box(document.getElementById('panel')),
          targets: [...document.querySelectorAll('#modes label, #panel button, #panel select')].map(box),
          fonts: [...document.querySelectorAll('#panel *')].filter((e) => e.checkVisibility())
            .map((e) => parseFloat(getComputedStyle(e).fontSize)),
          canvas: box(document.getElementById('canvas')),
        };
      });
      console.log(`${width} x ${height}: panel ${facts.panel.width} x ${Math.round(facts.panel.height)}, smallest target`,
        `${Math.min(...facts.targets.map((t) => t.height))} high, smallest letters ${Math.min(...facts.fonts)}`);
      ensure(facts.overflow <= 0, `the page is ${facts.overflow} pixels too wide`);
      const { left, right, top, bottom } = facts.panel;
      ensure(left >= 0 && right <= width && top >= 0 && bottom <= height, 'the panel leaves the window');
      ensure(facts.targets.every((t) => t.height >= 40), 'a button is too small for a finger');
      ensure(facts.fonts.every((size) => size >= 12), 'letters are too small');
      ensure(facts.canvas.width === width && facts.canvas.height === height, 'the surface does not fill the window');
      await page.close();
    }
  });
}

/* The page says why it does not work: a damaged net, no drawing in this browser. */
export async function refusal(tools) {
  const path = exportPage(tools, 'cube'), text = readFileSync(path, 'utf8');
  const write = (name, content) => {
    writeFileSync(join(tools.out, `${name}.html`), content);
    return join(tools.out, `${name}.html`);
  };
  const expect = async (context, file, ready, message) => {
    const opened = await openPage(context, file);
    const said = await opened.page.locator('#message').textContent();
    console.log(`${said}`);
    ensure(opened.ready === ready && said.includes(message), `the page is ${opened.ready} and says "${said}"`);
    return opened.page;
  };
  await withBrowser(tools, {}, async (context) => {
    await expect(context, write('short', text.replace(/(id="net"[^>]*>)..../, '$1')), 'error', 'damaged');
    await expect(context, write('torn', text.replace(/(id="net"[^>]*>)([^<]*)/, (_, tag, net) => {
      const bytes = Buffer.from(net, 'base64');
      bytes.writeInt32LE(1 << 20, bytes.length - 4);
      return tag + bytes.toString('base64');
    })), 'error', 'vertex');
    const withCap = text.replace('data-caps="0"', 'data-caps="1"');
    await expect(context, write('few', withCap), 'error', 'damaged');
    await expect(context, write('caps', withCap.replace(/(id="net"[^>]*>)([^<]*)/, (_, tag, net) => {
      const cap = Buffer.alloc(16); /* vertex 0, valence 3, no coefficients; its spoke is the vertex itself */
      cap.writeInt32LE(3, 8);
      return tag + Buffer.concat([Buffer.from(net, 'base64'), cap]).toString('base64');
    })), 'error', 'the cap at vertex 0');
  });
  const blind = ['--no-sandbox', '--disable-gpu', '--disable-3d-apis', '--disable-background-networking'];
  await withBrowser(tools, { args: blind }, async (context) => {
    const page = await expect(context, path, 'error', 'WebGL 2');
    const file = await takeDownload(page);
    ensure(readFileSync(await file.path(), 'utf8').includes('\nf '), 'the download does not work without WebGL');
  });
}
