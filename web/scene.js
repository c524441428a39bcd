// SPDX-License-Identifier: MIT
// Single role: what is drawn: the surface and the edges of its control net, about a common centre so that single precision
// is enough wherever the model lies; drawn when something changed, never otherwise.
import {
  BufferAttribute, BufferGeometry, Color, GreaterDepth, LineBasicMaterial, LineSegments, Mesh, Scene, WebGLRenderer,
} from 'three';
import { bendRange, makeMaterial } from './shading.js';
import { makeOrbit } from './orbit.js';
import { netEdges } from './net.js';

/* Middle of the box around points [3 n], and the distance of the farthest one from it. */
function findBall(points) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    min[i % 3] = Math.min(min[i % 3], points[i]);
    max[i % 3] = Math.max(max[i % 3], points[i]);
  }
  const centre = min.map((m, k) => m / 2 + max[k] / 2);
  let radius = 0;
  for (let i = 0; i < points.length; i += 3)
    radius = Math.max(radius, Math.hypot(points[i] - centre[0], points[i + 1] - centre[1], points[i + 2] - centre[2]));
  return { centre, radius: radius || 1 };
}

/* Lines with the colours of the curves, which the surface hides as it hides anything. */
function makeCurves(curves, shrink) {
  const lines = new BufferGeometry();
  lines.setAttribute('position', new BufferAttribute(shrink(curves.position), 3));
  lines.setAttribute('color', new BufferAttribute(curves.colour, 3, true));
  lines.setIndex(new BufferAttribute(curves.line, 1));
  const part = new LineSegments(lines, new LineBasicMaterial({ vertexColors: true }));
  part.frustumCulled = false;
  return part;
}

export function makeScene(canvas, net, triangles, curves) {
  const { centre, radius } = findBall(triangles.position);
  const shrink = (points) => Float32Array.from(points, (x, i) => (x - centre[i % 3]) / radius);
  const renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'low-power' });
  const scene = new Scene();
  const material = makeMaterial();
  const mesh = new Mesh(new BufferGeometry(), material);
  mesh.frustumCulled = false;
  scene.add(mesh);

  let isWaiting = false;
  const draw = () => {
    isWaiting = false;
    orbit.advance();
    renderer.render(scene, orbit.camera);
  };
  const invalidate = () => {
    if (!isWaiting) requestAnimationFrame(draw);
    isWaiting = true;
  };
  const orbit = makeOrbit(canvas, 1, invalidate);

  /* Lines before the surface, and paler ones of what it hides. */
  const lines = new BufferGeometry();
  lines.setAttribute('position', new BufferAttribute(shrink(net.position), 3));
  lines.setIndex(new BufferAttribute(netEdges(net), 1));
  const seen = new LineBasicMaterial();
  const hidden = new LineBasicMaterial({ transparent: true, opacity: 0.25, depthFunc: GreaterDepth, depthWrite: false });
  const nets = [new LineSegments(lines, hidden), new LineSegments(lines, seen)];
  for (const part of nets) {
    part.frustumCulled = false;
    part.visible = false;
    scene.add(part);
  }

  if (curves) scene.add(makeCurves(curves, shrink));

  const show = {
    canvas, orbit, invalidate,
    setMode(mode) {
      material.uniforms.mode.value = mode;
      invalidate();
    },
    setStripes(n) {
      material.uniforms.stripes.value = n;
      invalidate();
    },
    setNet(isShown) {
      for (const part of nets) part.visible = isShown;
      invalidate();
    },
    setTriangles(t) {
      const old = mesh.geometry;
      mesh.geometry = new BufferGeometry();
      mesh.geometry.setAttribute('position', new BufferAttribute(shrink(t.position), 3));
      mesh.geometry.setAttribute('normal', new BufferAttribute(Float32Array.from(t.normal), 3));
      mesh.geometry.setIndex(new BufferAttribute(t.corner, 1));
      old.dispose();
      invalidate();
    },
    /* bend[vertices] is coloured from -range to range, which is returned. */
    setBend(bend) {
      const range = bendRange(bend);
      const scaled = Float32Array.from(bend, (x) => (Number.isFinite(x) ? x / range : 0));
      mesh.geometry.setAttribute('bend', new BufferAttribute(scaled, 1));
      invalidate();
      return range;
    },
    resize() {
      const { clientWidth: width, clientHeight: height } = canvas;
      if (width === 0 || height === 0) return;
      renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
      renderer.setSize(width, height, false);
      const style = getComputedStyle(document.documentElement);
      const used = (name) => parseFloat(style.getPropertyValue(name)) || 0;
      orbit.resize(width, height, used('--used-left'), used('--used-bottom'));
      invalidate();
    },
    takeColours() {
      const style = getComputedStyle(document.documentElement);
      renderer.setClearColor(new Color(style.getPropertyValue('--paper').trim()));
      for (const line of [seen, hidden]) line.color.set(style.getPropertyValue('--net').trim());
      invalidate();
    },
  };
  new ResizeObserver(show.resize).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', show.takeColours);
  canvas.addEventListener('webglcontextrestored', invalidate);
  show.takeColours();
  show.setTriangles(triangles);
  show.resize();
  orbit.reset();
  return show;
}
