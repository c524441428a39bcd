// SPDX-License-Identifier: MIT
// Single role: turning and zooming, by mouse and touch (OrbitControls) and by keys; gliding to rest unless the viewer asked
// for reduced motion. z is up.
import { PerspectiveCamera, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const TURN = Math.PI / 24, ZOOM = 1.15, GLIDE = 0.3;
const FIELD = 30; /* degrees, of the shorter side of the part of the window that the panel leaves free */
const KEYS = {
  ArrowLeft: { turn: TURN }, ArrowRight: { turn: -TURN }, ArrowUp: { tilt: TURN }, ArrowDown: { tilt: -TURN },
  '+': { zoom: 1 / ZOOM }, '=': { zoom: 1 / ZOOM }, '-': { zoom: ZOOM }, PageUp: { zoom: 1 / ZOOM }, PageDown: { zoom: ZOOM },
};

export function makeOrbit(canvas, radius, invalidate) {
  const camera = new PerspectiveCamera(FIELD, 1, 0.01 * radius, 100 * radius);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.minDistance = 0.2 * radius;
  controls.maxDistance = 40 * radius;
  controls.addEventListener('change', invalidate);
  const wishes = { turn: 0, tilt: 0, zoom: 0 }; /* what keys asked for and has not been done */

  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  const setCalm = () => (controls.enableDamping = !calm.matches);
  calm.addEventListener('change', setCalm);
  setCalm();

  const reset = () => {
    controls.target.set(0, 0, 0);
    camera.position.set(0.9, -2.5, 1.5).setLength((1.08 * radius) / Math.sin((FIELD * Math.PI) / 360));
    Object.assign(wishes, { turn: 0, tilt: 0, zoom: 0 });
    controls.update();
    invalidate();
  };

  /* A part of what is wished; all of it where motion is reduced or the rest is too small to see. */
  const step = () => {
    const isSmall = Math.hypot(wishes.turn, wishes.tilt, wishes.zoom) < 1e-3;
    const part = calm.matches || isSmall ? 1 : GLIDE;
    const { turn, tilt, zoom } = wishes;
    if (turn === 0 && tilt === 0 && zoom === 0) return;
    const arm = new Vector3().subVectors(camera.position, controls.target);
    const s = new Spherical().setFromCartesianCoords(arm.x, arm.z, -arm.y);
    s.theta += part * turn;
    s.phi -= part * tilt;
    s.radius = Math.min(Math.max(s.radius * Math.exp(part * zoom), controls.minDistance), controls.maxDistance);
    s.makeSafe();
    arm.setFromSpherical(s);
    camera.position.set(arm.x, -arm.z, arm.y).add(controls.target);
    for (const k of Object.keys(wishes)) wishes[k] *= 1 - part;
    invalidate();
  };

  return {
    camera, reset,
    /* True where the key means something here. */
    press(key) {
      const wish = KEYS[key];
      if (!wish) return false;
      wishes.turn += wish.turn ?? 0;
      wishes.tilt += wish.tilt ?? 0;
      wishes.zoom += Math.log(wish.zoom ?? 1);
      invalidate();
      return true;
    },
    /* Once per frame, before drawing; motion that goes on asks for the next frame. */
    advance() {
      step();
      controls.update();
      const distance = camera.position.distanceTo(controls.target);
      camera.near = Math.max(distance - 3 * radius, 0.01 * radius);
      camera.far = distance + 6 * radius;
      camera.updateProjectionMatrix();
    },
    /* The target appears in the middle of what lies right of left and above bottom, in pixels. */
    resize(width, height, left, bottom) {
      const half = Math.tan((FIELD * Math.PI) / 360), side = Math.max(1, Math.min(width - left, height - bottom));
      camera.aspect = width / height;
      camera.fov = (360 / Math.PI) * Math.atan((half * height) / side);
      camera.setViewOffset(width, height, -left / 2, bottom / 2, width, height);
    },
  };
}
