// SPDX-License-Identifier: MIT
// Tests the page of the HTML exporter in headless Chromium, from file://.
// Usage: node run.mjs MODULES FAIRSURF MAKE_PAGE COMPARE MESHES REFERENCES OUT CASE      exit 77: no browser
// With UPDATE=1 in the environment the reference pictures are replaced; look at them before keeping them.
import { readArguments, skipWithoutBrowser } from './browser.mjs';
import { modes, moved } from './pictures.mjs';
import { curvature, download } from './numbers.mjs';
import { keyboard, mouse, motion, touch } from './input.mjs';
import { limits, phone, refusal, title } from './page.mjs';

const cases = { curvature, download, keyboard, limits, modes, motion, mouse, moved, phone, refusal, title, touch };
const tools = readArguments();
if (!cases[tools.name]) {
  console.error(`there is no case ${tools.name}; there are ${Object.keys(cases).join(', ')}`);
  process.exit(2);
}
skipWithoutBrowser();
try {
  await cases[tools.name](tools);
} catch (error) {
  console.error(`${tools.name}: ${error.message}`);
  process.exit(1);
}
