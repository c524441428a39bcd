// SPDX-License-Identifier: MIT
// Single role: how the surface looks: one material with four modes, per pixel from the exact normals.
// Zebra stripes are those of parallel light strips at infinity, seen in the surface: the angle of the mirrored line of sight
// about the horizontal axis of the screen. Isophotes are lines of equal angle between the normal and a light that stays
// with the viewer. Both are smoothed over a pixel, and fade to grey where they are finer than that.
import { Color, DoubleSide, GLSL3, ShaderMaterial } from 'three';

export const MODES = ['shaded', 'zebra', 'isophotes', 'curvature'];
/* Of the colours of curvature, from the smallest to the largest number; the legend shows the same. */
export const RAMP = ['#2a3f9d', '#63a5d6', '#f4f2ea', '#ef9f5d', '#a8202a'];

const vertexShader = `
in float bend;
out vec3 surfaceNormal, toViewer;
out float shownBend;
void main() {
  vec4 p = modelViewMatrix * vec4(position, 1.0);
  surfaceNormal = normalMatrix * normal;
  toViewer = -p.xyz;
  shownBend = bend;
  gl_Position = projectionMatrix * p;
}`;

const fragmentShader = `
precision highp float;
in vec3 surfaceNormal, toViewer;
in float shownBend;
out vec4 colour;
uniform int mode;
uniform float stripes, bendRange;
uniform vec3 paint, ramp[5];
const float PI = 3.14159265358979;

float stripe(float x) {
  float width = 0.75 * fwidth(x);
  float wave = 2.0 * abs(fract(x) - 0.5);
  float sharp = smoothstep(0.5 - 2.0 * width, 0.5 + 2.0 * width, wave);
  return mix(sharp, 0.5, clamp(2.0 * width - 0.4, 0.0, 1.0));
}

vec3 rampAt(float t) {
  float x = 4.0 * clamp(0.5 + 0.5 * t, 0.0, 1.0);
  int i = min(int(x), 3);
  return mix(ramp[i], ramp[i + 1], x - float(i));
}

void main() {
  vec3 v = normalize(toViewer), n = normalize(surfaceNormal), light = normalize(vec3(0.4, 0.8, 0.6));
  bool isInside = dot(n, v) < 0.0;
  if (isInside) n = -n;
  float diffuse = max(dot(n, light), 0.0);
  if (mode == 0) {
    vec3 base = isInside ? paint.bgr : paint;
    float shine = pow(max(dot(n, normalize(light + v)), 0.0), 60.0);
    colour = vec4(pow(base * (0.3 + 0.7 * diffuse) + 0.35 * shine, vec3(1.0 / 1.6)), 1.0);
  } else if (mode == 1) {
    vec3 r = reflect(-v, n);
    colour = vec4(vec3(stripe(stripes * atan(r.y, r.z) / PI)), 1.0);
  } else if (mode == 2) {
    float angle = acos(clamp(dot(n, light), -1.0, 1.0));
    colour = vec4(mix(vec3(0.12), vec3(1.0), stripe(2.0 * stripes * angle / PI)), 1.0);
  } else {
    colour = vec4(rampAt(shownBend / bendRange) * (0.62 + 0.38 * diffuse), 1.0);
  }
}`;

/* The ramp stays in screen colours, as the legend has them. */
const screenColour = (hex) => new Color().setStyle(hex, 'srgb-linear');

export function makeMaterial() {
  return new ShaderMaterial({
    vertexShader, fragmentShader, side: DoubleSide, glslVersion: GLSL3,
    uniforms: {
      mode: { value: 0 }, stripes: { value: 12 }, bendRange: { value: 1 },
      paint: { value: new Color(0.30, 0.45, 0.62) }, ramp: { value: RAMP.map(screenColour) },
    },
  });
}

/* The number below which 98 of 100 lie, by magnitude: single sharp places do not wash out the rest. */
export function bendRange(bend) {
  const sorted = bend.filter(Number.isFinite).map(Math.abs).sort();
  return sorted[Math.floor(0.98 * (sorted.length - 1))] || 1;
}
