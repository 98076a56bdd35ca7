// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Pictures of models in space, coloured by height: dark blue is low, yellow is high.
import {kHeights} from './colors.js';

// Between which heights most points lie: of every hundredth, without the lowest and highest.
function heightRange(points) {
  const sample = [];
  for (let i = 2; i < points.length; i += 3 * Math.max(1, Math.floor(points.length / 3000))) sample.push(points[i]);
  sample.sort((a, b) => a - b);
  const low = sample[Math.floor(sample.length * 0.02)] ?? 0, high = sample[Math.floor(sample.length * 0.98)] ?? 1;
  return {low, high: Math.max(high, low + 0.1)};
}

export function boxOf(points, camera) {
  const box = {left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity};
  for (let i = 0; i < points.length; i += 3) {
    const [right, up] = camera.project(points[i], points[i + 1], points[i + 2]);
    box.left = Math.min(box.left, right);
    box.right = Math.max(box.right, right);
    box.bottom = Math.min(box.bottom, up);
    box.top = Math.max(box.top, up);
  }
  return box;
}

// From above the highest point of a pixel is seen, from a side any: walls are thin.
export function pictureOf(points, camera) {
  const {c, s, x0, y0} = camera.affine;
  const {isFromAbove, rightX, rightY} = camera;
  const image = new ImageData(Math.max(1, Math.round(camera.width)), Math.max(1, Math.round(camera.height)));
  const pixels = new Uint32Array(image.data.buffer);
  const heights = new Float32Array(pixels.length).fill(-Infinity);
  const {low, high} = heightRange(points);
  const perMetre = 256 / (high - low);
  for (let i = 0; i < points.length; i += 3) {
    const x = points[i], y = points[i + 1], z = points[i + 2];
    const right = isFromAbove ? x : rightX * x + rightY * y, up = isFromAbove ? y : z;
    const px = Math.round(x0 + c * right - s * up), py = Math.round(y0 - s * right - c * up);
    if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
    const at = py * image.width + px;
    if (z <= heights[at]) continue;
    heights[at] = z;
    pixels[at] = kHeights[Math.max(0, Math.min(255, Math.floor(perMetre * (z - low))))];
  }
  const picture = document.createElement('canvas');
  picture.width = image.width;
  picture.height = image.height;
  picture.getContext('2d').putImageData(image, 0, 0);
  return picture;
}
