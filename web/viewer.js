// SPDX-License-Identifier: MIT
// Single role: the page: reads the net, has the surface made, and ties the controls to the scene.
import { decodeBase64, readCurves, readNet } from './net.js';
import { openSurface } from './surface.js';
import { MODES, RAMP } from './shading.js';
import { makeScene } from './scene.js';
import { writeObj } from './obj.js';

const N_BENDS = 4; /* curvatures per vertex: mean, Gaussian, larger, smaller principal */
const FIRST_TRIANGLES = 120000, MOST_TRIANGLES = 3000000, MOST_STEPS = 32;
const element = (id) => document.getElementById(id);
const modeInputs = [...document.querySelectorAll('input[name=mode]')];
const state = { surface: null, triangles: null, scene: null, steps: 1 };

function complain(error) {
  element('message').textContent = error.message;
  element('message').hidden = false;
}

const threeDigits = (x) => String(Number(x.toPrecision(3)));

/* The chosen curvature of every vertex, in the numbers of the core. */
function chosenBend() {
  const { curvature, nVertices } = state.triangles, k = Number(element('bend').value);
  return Float64Array.from({ length: nVertices }, (_, v) => curvature[N_BENDS * v + k]);
}

function showBend() {
  if (!state.scene) return;
  const range = state.scene.setBend(chosenBend());
  element('legend-min').textContent = `≤ −${threeDigits(range)}`;
  element('legend-max').textContent = `≥ ${threeDigits(range)}`;
}

function showMode() {
  const mode = MODES.indexOf(modeInputs.find((input) => input.checked).value);
  document.documentElement.dataset.mode = MODES[mode];
  state.scene?.setMode(mode);
}

function showStripes() {
  element('stripes-count').value = element('stripes').value;
  state.scene?.setStripes(Number(element('stripes').value));
}

function describeSteps() {
  const n = Number(element('steps').value), count = 2 * n * n * state.surface.nPatches;
  element('steps-count').value = `${n} × ${n} per patch, ${count.toLocaleString('en')} triangles`;
}

function tessellate() {
  const n = Number(element('steps').value);
  state.triangles = state.surface.tessellate(n);
  state.steps = n;
  state.scene?.setTriangles(state.triangles);
  showBend();
  describeSteps();
  document.documentElement.dataset.triangles = state.triangles.nTriangles;
}

function chooseSteps() {
  const { nPatches } = state.surface;
  const within = (triangles) => Math.floor(Math.sqrt(triangles / 2 / nPatches));
  element('steps').max = Math.max(1, Math.min(MOST_STEPS, within(MOST_TRIANGLES)));
  element('steps').value = Math.max(1, Math.min(16, within(FIRST_TRIANGLES)));
}

function download() {
  const made = element('net').dataset.madeWith, title = document.title;
  const blob = new Blob(writeObj(state.triangles, made ? `${title}: ${made}` : title), { type: 'model/obj' });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = `${title.replace(/[^\p{L}\p{N} ._-]/gu, '_')}.obj`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function toggleNet() {
  element('show-net').checked = !element('show-net').checked;
  state.scene.setNet(element('show-net').checked);
}

function pressKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
  const input = /^[1-4]$/.test(event.key) ? modeInputs[Number(event.key) - 1] : null;
  if (input) {
    input.checked = true;
    showMode();
  } else if (event.key === '0' || event.key === 'Home') state.scene.orbit.reset();
  else if (event.key === 'n') toggleNet();
  else if (!state.scene.orbit.press(event.key)) return;
  event.preventDefault();
}

function tieControls() {
  const attempt = (action) => () => {
    try {
      action();
    } catch (error) {
      complain(error);
    }
  };
  for (const input of modeInputs) input.addEventListener('change', showMode);
  element('stripes').addEventListener('input', showStripes);
  element('steps').addEventListener('input', describeSteps);
  element('steps').addEventListener('change', attempt(tessellate));
  element('bend').addEventListener('change', showBend);
  element('show-net').addEventListener('change', () => state.scene?.setNet(element('show-net').checked));
  element('download').addEventListener('click', attempt(download));
  element('reset').addEventListener('click', () => state.scene?.orbit.reset());
  element('legend').style.background = `linear-gradient(to right, ${RAMP.join(', ')})`;
}

async function start() {
  element('title').textContent = document.title;
  element('made-with').textContent = element('net').dataset.madeWith ?? '';
  element('more').open = matchMedia('(min-width: 641px) and (min-height: 481px)').matches;
  tieControls();
  const net = readNet(element('net'));
  state.surface = await openSurface(decodeBase64(element('core').textContent), net);
  chooseSteps();
  tessellate();
  try {
    state.scene = makeScene(element('canvas'), net, state.triangles, readCurves(element('curves')));
  } catch (error) {
    throw new Error(`This browser cannot draw here: WebGL 2 is needed (${error.message}). The download works.`);
  }
  addEventListener('keydown', pressKey);
  (modeInputs[element('net').dataset.scene] ?? modeInputs[0]).checked = true;
  showMode();
  showStripes();
  showBend();
  state.scene.setNet(element('show-net').checked);
}

/* For scripts in the page and for tests: the triangles that are shown, and the curvatures of their vertices. */
globalThis.fairsurf = state;

start().then(
  () => requestAnimationFrame(() => requestAnimationFrame(() => (document.documentElement.dataset.ready = 'yes'))),
  (error) => {
    complain(error);
    document.documentElement.dataset.ready = 'error';
  },
);
