// SPDX-License-Identifier: MIT
// Single role: puts the page of the HTML exporter together and writes it as C arrays, cut where the exporter adds the title
// and the net. Usage: node build.mjs MODULES CORE.wasm VERSION OUT.c      MODULES: the folder that holds node_modules
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [modules, core, version, out] = process.argv.slice(2);
const esbuild = createRequire(resolve(modules, 'package.json'))('esbuild');
const nodePaths = [resolve(modules, 'node_modules')];
const text = (name) => readFile(join(here, name), 'utf8');
const escapeText = (s) => s.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

const bundle = await esbuild.build({
  entryPoints: [join(here, 'viewer.js')], bundle: true, minify: true, write: false, format: 'iife', target: 'es2020',
  charset: 'utf8', legalComments: 'none', nodePaths, absWorkingDir: here, logLevel: 'warning',
});
const style = await esbuild.transform(await text('page.css'), { loader: 'css', minify: true, legalComments: 'none' });
const parts = {
  VERSION: version,
  STYLE: style.code.trim(),
  NOTICES: escapeText((await text('notices.txt')).trim()),
  CORE: (await readFile(core)).toString('base64'),
  SCRIPT: bundle.outputFiles[0].text.trim().replace(/<(\/script|script|!--)/gi, '\\x3c$1'),
};
const page = (await text('page.html')).replace(/@([A-Z]+)@/g, (mark, name) => parts[name] ?? mark);
const pieces = page.split(/@TITLE@|@NET@/);
if (pieces.length !== 3) throw new Error(`page.html has ${pieces.length - 1} places for the title and the net, not 2`);

let source = `/* Made by web/build.mjs. */
#include <stddef.h>

extern const unsigned char *const fs_html_piece[3];
extern const size_t fs_html_piece_size[3];
`;
pieces.forEach((piece, i) => {
  source += `\nstatic const unsigned char piece_${i}[] = {\n${Buffer.from(piece).join(',').replace(/(.{100,}?,)/g, '$1\n')}};\n`;
});
source += '\nconst unsigned char *const fs_html_piece[3] = {piece_0, piece_1, piece_2};\n';
source += 'const size_t fs_html_piece_size[3] = {sizeof piece_0, sizeof piece_1, sizeof piece_2};\n';
await writeFile(out, source);
