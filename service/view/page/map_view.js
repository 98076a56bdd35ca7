// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The map on its canvas: what stays is drawn once into a picture behind, what moves in every frame.
import {condition, kSilent_s} from './model.js';

const kFit_px = 60;
const kMost_px_per_m = 400;
const kLeast_px_per_m = 0.2;
const kEllipse_sigmas = 2.45;  // Holds 95 % of a Gaussian of two dimensions.
const kBackgroundPeriod_ms = 400;
const kGlide_ms = 60;  // In which a robot's picture comes to where the robot is.

export const kThemes = {
  light: {ground: '#dfe5ec', unknownDot: '#b9c4d0', palette: [[0, 0, 0, 0], [255, 255, 255, 255], [0, 40, 120, 255]], ink: '#16202c', paper: '#ffffff', point: '#00284f', moved: '#a3195b'},
  dark: {ground: '#10151c', unknownDot: '#2a3541', palette: [[0, 0, 0, 0], [36, 46, 58, 255], [196, 222, 247, 255]], ink: '#eef4fa', paper: '#10151c', point: '#cfe6ff', moved: '#ff9ecb'},
};

export const kMarkKinds = {
  victim: {word: 'Victim', color: '#f00a0a', shape: 'disc'},
  hazard: {word: 'Hazard', color: '#ff641e', shape: 'diamond'},
  note: {word: 'Note', color: '#0a0af0', shape: 'square'},
};

// White or black, whichever is read better on a colour.
export function inkOn(color) {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));
  return 0.299 * r + 0.587 * g + 0.114 * b > 140 ? '#000' : '#fff';
}

// Colours of heights, from blue by green to yellow: also the colour-blind see which is higher.
const kHeights = Uint32Array.from({length: 256}, (_, i) => {
  const stops = [[62, 74, 137], [38, 130, 142], [53, 183, 121], [253, 231, 37]];
  const at = i / 256 * 3, stop = Math.floor(at);
  const [r, g, b] = stops[stop].map((low, k) => Math.round(low + (at - stop) * (stops[stop + 1][k] - low)));
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
});

// Between which heights most points lie: of every hundredth, without the lowest and highest.
function heightRange(points) {
  const sample = [];
  for (let i = 2; i < points.length; i += 3 * Math.max(1, Math.floor(points.length / 3000))) sample.push(points[i]);
  sample.sort((a, b) => a - b);
  const low = sample[Math.floor(sample.length * 0.02)] ?? 0, high = sample[Math.floor(sample.length * 0.98)] ?? 1;
  return {low, high: Math.max(high, low + 0.1)};
}

function boxOf(points, camera) {
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

// A robot moves on the screen instead of jumping ten times a second.
function glide(robot, pose, now_ms) {
  const {shown} = robot;
  const passed_ms = now_ms - (robot.shown_ms ?? 0);
  robot.shown_ms = now_ms;
  const share = Math.min(1, passed_ms / kGlide_ms);
  const isFar = !shown || Math.hypot(pose.x - shown.x, pose.y - shown.y) > 1;
  if (isFar || share === 1) robot.shown = {x: pose.x, y: pose.y, theta: pose.theta};
  else {
    const turn = Math.atan2(Math.sin(pose.theta - shown.theta), Math.cos(pose.theta - shown.theta));
    robot.shown = {x: shown.x + share * (pose.x - shown.x), y: shown.y + share * (pose.y - shown.y), theta: shown.theta + share * turn};
  }
  return {...pose, ...robot.shown};
}

export class Camera {
  constructor() { this.x = 0; this.y = 0; this.scale = 40; this.width = 1; this.height = 1; this.look('above'); }
  // From above, or from a side: then what is up on the screen is up.
  look(from) {
    this.from = from;
    [this.rightX, this.rightY] = {above: [1, 0], south: [1, 0], east: [0, 1], north: [-1, 0], west: [0, -1]}[from];
  }
  // Right and up on the plane that is looked at, m.
  project(x, y, z) { return this.from === 'above' ? [x, y] : [this.rightX * x + this.rightY * y, z]; }
  toScreen(x, y, z = 0) {
    const [right, up] = this.project(x, y, z);
    return this.planeToScreen(right, up);
  }
  planeToScreen(x, y) { return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale]; }
  toMap(px, py) { return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale]; }
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toMap(px, py);
    this.scale = Math.min(kMost_px_per_m, Math.max(kLeast_px_per_m, this.scale * factor));
    const [nx, ny] = this.toMap(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }
  pan(dx, dy) { this.x -= dx / this.scale; this.y += dy / this.scale; }
  fit({left, right, bottom, top}, margins) {
    const width = this.width - margins.left - margins.right - 2 * kFit_px, height = this.height - margins.top - margins.bottom - 2 * kFit_px;
    this.scale = Math.min(kMost_px_per_m / 4, Math.max(kLeast_px_per_m, Math.min(width / Math.max(right - left, 1), height / Math.max(top - bottom, 1))));
    this.x = (left + right) / 2 + (margins.right - margins.left) / 2 / this.scale;
    this.y = (bottom + top) / 2 - (margins.bottom - margins.top) / 2 / this.scale;
  }
  get key() { return `${this.from},${this.x},${this.y},${this.scale},${this.width},${this.height}`; }
}

export class MapView {
  constructor(canvas, model, state) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d', {alpha: false});
    this.behind = document.createElement('canvas');
    this.model = model;
    this.state = state;  // {layers, selected, theme, shownStamp}
    this.camera = new Camera();
    this.overlay = null;  // Drawn by a tool, on top.
    this.frames = 0;
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.ratio = ratio;
    this.camera.width = this.canvas.clientWidth;
    this.camera.height = this.canvas.clientHeight;
    for (const canvas of [this.canvas, this.behind]) {
      canvas.width = Math.round(this.camera.width * ratio);
      canvas.height = Math.round(this.camera.height * ratio);
    }
    this.backgroundKey = null;
  }

  get theme() { return kThemes[this.state.theme]; }

  bounds() {
    const boxes = this.#maps().map((map) => map.bounds).filter(Boolean);
    if (this.camera.from !== 'above') boxes.length = 0;
    for (const points of this.model.clouds.values()) boxes.push(boxOf(points, this.camera));
    for (const {last} of this.model.robotsInMap()) {
      if (!last) continue;
      const [right, up] = this.camera.project(last.x, last.y, last.z ?? 0);
      boxes.push({left: right - 3, right: right + 3, bottom: up - 3, top: up + 3});
    }
    if (boxes.length === 0) return null;
    return {left: Math.min(...boxes.map((b) => b.left)), right: Math.max(...boxes.map((b) => b.right)), bottom: Math.min(...boxes.map((b) => b.bottom)), top: Math.max(...boxes.map((b) => b.top))};
  }

  #maps() { return [...this.model.maps.values()].filter(({frame}) => !this.model.isApart(frame)); }

  draw(now_ms) {
    this.#drawBehind(now_ms);
    const c = this.context;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.drawImage(this.behind, 0, 0);
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const isLive = this.state.shownStamp === null;
    const robots = this.model.robotsInMap();
    if (isLive && this.state.layers.scans && this.camera.from === 'above') for (const robot of robots) this.#drawScan(c, robot, now_ms);
    if (this.state.layers.marks) this.#drawMarks(c);
    for (const robot of robots) {
      const pose = isLive ? robot.last : robot.poseAt(this.state.shownStamp);
      if (pose) this.#drawRobot(c, robot, isLive ? glide(robot, pose, now_ms) : pose, isLive ? condition(robot, now_ms) : {level: 0, text: ''});
    }
    this.overlay?.(c, this.camera, this.theme);
    ++this.frames;
    this.#noteLatencies();
  }

  // From publication to the screen, on this computer's clock.
  #noteLatencies() {
    const now_ms = performance.timeOrigin + performance.now();
    for (const robot of this.model.robots.values()) {
      if (!robot.isFresh) continue;
      robot.isFresh = false;
      this.model.latencies_ms.push(now_ms - robot.published_ms);
    }
    if (this.model.latencies_ms.length > 10000) this.model.latencies_ms.splice(0, 5000);
  }

  #drawBehind(now_ms) {
    const {layers, shownStamp} = this.state;
    const view = [this.camera.key, this.state.theme, JSON.stringify(layers), shownStamp, this.state.shownEvent?.at_ms].join();
    const content = [this.model.mapVersion, [...this.model.robots.values()].map((r) => r.trail.length)].join();
    const isDue = content !== this.contentKey && now_ms - this.behindAt > kBackgroundPeriod_ms;
    if (view === this.backgroundKey && !isDue) return;
    this.backgroundKey = view;
    this.contentKey = content;
    this.behindAt = now_ms;
    const c = this.behind.getContext('2d', {alpha: false});
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.fillStyle = this.theme.ground;
    c.fillRect(0, 0, this.camera.width, this.camera.height);
    const isFromAbove = this.camera.from === 'above';
    if (isFromAbove && shownStamp === null && layers.occupancy) this.#drawMaps(c);
    if (layers.occupancy) for (const points of this.model.clouds.values()) this.#drawCloud(c, points);
    if (layers.grid) this.#drawGrid(c);
    if (isFromAbove && (shownStamp !== null || layers.relevant)) this.#drawRelevant(c);
    if (layers.trails) for (const robot of this.model.robotsInMap()) this.#drawTrail(c, robot);
    if (layers.loops) for (const {loops} of this.model.robotsInMap()) this.#drawLoops(c, loops);
    if (this.state.shownEvent?.moves) this.#drawMoves(c, this.state.shownEvent.moves);
  }

  #drawMaps(c) {
    c.imageSmoothingEnabled = this.camera.scale < 20;
    for (const map of this.#maps()) {
      for (const chunk of map.chunks.values()) {
        const [left, top] = this.camera.toScreen(chunk.x, chunk.y + chunk.size_m);
        const side = chunk.size_m * this.camera.scale;
        if (left > this.camera.width || top > this.camera.height || left + side < 0 || top + side < 0) continue;
        c.drawImage(chunk.picture(this.theme.palette), left, top, side, side);
      }
    }
  }

  // A cloud, coloured by height: dark blue is low, yellow is high. From above the highest point is seen,
  // from a side any: walls are thin.
  #drawCloud(c, points) {
    const {x, y, scale, width, height, from, rightX, rightY} = this.camera;
    const isFromAbove = from === 'above';
    const image = new ImageData(Math.max(1, Math.round(width)), Math.max(1, Math.round(height)));
    const pixels = new Uint32Array(image.data.buffer);
    const heights = new Float32Array(pixels.length).fill(-Infinity);
    const range = heightRange(points);
    for (let i = 0; i < points.length; i += 3) {
      const right = isFromAbove ? points[i] : rightX * points[i] + rightY * points[i + 1], up = isFromAbove ? points[i + 1] : points[i + 2];
      const px = Math.round(width / 2 + (right - x) * scale), py = Math.round(height / 2 - (up - y) * scale);
      if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
      const at = py * image.width + px;
      if (points[i + 2] <= heights[at]) continue;
      heights[at] = points[i + 2];
      pixels[at] = kHeights[Math.max(0, Math.min(255, Math.floor(256 * (points[i + 2] - range.low) / (range.high - range.low))))];
    }
    const layer = document.createElement('canvas');
    layer.width = image.width;
    layer.height = image.height;
    layer.getContext('2d').putImageData(image, 0, 0);
    c.drawImage(layer, 0, 0, width, height);
  }

  #drawLoops(c, loops) {
    c.strokeStyle = this.theme.moved;
    c.lineWidth = 1.5;
    for (const [from, to] of loops) {
      if (to.stamp > (this.state.shownStamp ?? Infinity)) continue;
      c.beginPath();
      c.moveTo(...this.camera.toScreen(from.x, from.y, from.z));
      c.lineTo(...this.camera.toScreen(to.x, to.y, to.z));
      c.stroke();
    }
  }

  // Where scans were taken before a correction of the map, and where it has put them.
  #drawMoves(c, moves) {
    c.strokeStyle = this.theme.moved;
    c.fillStyle = this.theme.moved;
    c.lineWidth = 1.5;
    const size = Math.max(1.2, Math.min(3.5, 0.15 * this.camera.scale));
    for (const {before, pose} of moves) {
      const [bx, by] = this.camera.toScreen(before.x, before.y), [ax, ay] = this.camera.toScreen(pose.x, pose.y);
      c.beginPath();
      c.arc(bx, by, size, 0, 2 * Math.PI);
      c.moveTo(bx, by);
      c.lineTo(ax, ay);
      c.stroke();
      c.beginPath();
      c.arc(ax, ay, 0.7 * size, 0, 2 * Math.PI);
      c.fill();
    }
  }

  #drawGrid(c) {
    const step = [0.5, 1, 2, 5, 10, 20, 50, 100].find((m) => m * this.camera.scale > 42) ?? 200;
    const [left, top] = this.camera.toMap(0, 0), [right, bottom] = this.camera.toMap(this.camera.width, this.camera.height);
    c.fillStyle = this.theme.unknownDot;
    for (let x = Math.ceil(left / step) * step; x < right; x += step) {
      for (let y = Math.ceil(bottom / step) * step; y < top; y += step) {
        const [px, py] = this.camera.planeToScreen(x, y);
        c.fillRect(px - 0.75, py - 0.75, 1.5, 1.5);
      }
    }
  }

  #drawRelevant(c) {
    const until = this.state.shownStamp ?? Infinity;
    const size = Math.max(1.2, Math.min(3, this.camera.scale * 0.03));
    c.fillStyle = this.theme.point;
    c.globalAlpha = 0.75;
    for (const {stamp, points, frame} of this.model.relevant.values()) {
      if (stamp <= until && !this.model.isApart(frame)) this.#drawPoints(c, points, size);
    }
    c.globalAlpha = 1;
  }

  #drawPoints(c, points, size) {
    const {x, y, scale, width, height} = this.camera;
    for (let i = 0; i < points.length; i += 2) {
      c.fillRect(width / 2 + (points[i] - x) * scale - size / 2, height / 2 - (points[i + 1] - y) * scale - size / 2, size, size);
    }
  }

  #drawTrail(c, robot) {
    const until = this.state.shownStamp ?? Infinity;
    c.beginPath();
    let last = null;
    const begin = robot.trail[0]?.stamp ?? Infinity;
    const before = robot.relevant.filter(({stamp}) => stamp < begin);
    for (const {x, y, z, stamp} of [...before, ...robot.trail]) {
      if (stamp > until) break;
      const [px, py] = this.camera.toScreen(x, y, z);
      if (last && Math.abs(px - last[0]) + Math.abs(py - last[1]) < 2) continue;
      if (last) c.lineTo(px, py); else c.moveTo(px, py);
      last = [px, py];
    }
    c.strokeStyle = robot.color;
    c.lineWidth = this.state.selected === robot.name ? 3.5 : 2;
    c.lineJoin = 'round';
    c.globalAlpha = 0.85;
    c.setLineDash(robot.isSecond ? [9, 5] : []);  // Who shares a colour does not share the line.
    c.stroke();
    c.setLineDash([]);
    c.globalAlpha = 1;
  }

  #drawScan(c, robot, now_ms) {
    if (!robot.points || now_ms - robot.arrived_ms > 1000 * kSilent_s) return;
    c.fillStyle = robot.color;
    this.#drawPoints(c, robot.points, Math.max(2, Math.min(4, this.camera.scale * 0.05)));
  }

  #drawRobot(c, robot, pose, {level, text}) {
    const [px, py] = this.camera.toScreen(pose.x, pose.y, pose.z);
    if (this.state.layers.uncertainty && pose.cov && this.camera.from === 'above') this.#drawEllipse(c, robot, pose.cov, px, py);
    const radius = Math.max(11, Math.min(26, 0.3 * this.camera.scale));
    const isSelected = this.state.selected === robot.name;
    c.save();
    c.translate(px, py);
    c.beginPath();
    if (this.camera.from === 'above') {
      c.rotate(-pose.theta);
      c.moveTo(radius * 1.75, 0);
      c.arc(0, 0, radius, 0.62, -0.62);
    } else c.arc(0, 0, radius, 0, 2 * Math.PI);
    c.closePath();
    c.lineWidth = isSelected ? 6 : 3.5;
    c.strokeStyle = this.theme.ink;
    c.globalAlpha = level >= 2 ? 0.55 : 1;
    c.stroke();
    c.lineWidth = isSelected ? 3 : 1.5;
    c.strokeStyle = this.theme.paper;
    c.stroke();
    c.fillStyle = robot.color;
    c.fill();
    c.restore();
    c.font = `700 ${Math.round(radius * 1.05)}px system-ui, "DejaVu Sans", sans-serif`;
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    c.fillStyle = inkOn(robot.color);
    c.fillText(robot.label, px, py + 0.5);
    if (robot.isSecond) {
      c.beginPath();
      c.arc(px, py, radius * 0.8, 0, 2 * Math.PI);
      c.lineWidth = 1.5;
      c.strokeStyle = inkOn(robot.color);
      c.stroke();
    }
    if (level > 0) this.#drawCaption(c, px, py + radius + 15, text, level);
  }

  // A robot that needs attention says so on the map, too, in words.
  #drawCaption(c, px, py, text, level) {
    c.font = '600 12px system-ui, "DejaVu Sans", sans-serif';
    const width = c.measureText(text).width + 14;
    c.fillStyle = level >= 2 ? '#b3261e' : '#8a4b00';
    c.beginPath();
    c.roundRect(px - width / 2, py - 9, width, 19, 9);
    c.fill();
    c.fillStyle = '#fff';
    c.fillText(text, px, py + 1);
  }

  #drawEllipse(c, robot, cov, px, py) {
    const [xx, xy, , , yy] = cov;
    const middle = (xx + yy) / 2, spread = Math.hypot((xx - yy) / 2, xy);
    const major = Math.sqrt(Math.max(0, middle + spread)), minor = Math.sqrt(Math.max(0, middle - spread));
    if (major * this.camera.scale * kEllipse_sigmas > 20000) return;
    c.beginPath();
    c.ellipse(px, py, Math.max(1, kEllipse_sigmas * major * this.camera.scale), Math.max(1, kEllipse_sigmas * minor * this.camera.scale), -0.5 * Math.atan2(2 * xy, xx - yy), 0, 2 * Math.PI);
    c.fillStyle = robot.color + '33';
    c.fill();
    c.strokeStyle = robot.color;
    c.lineWidth = 1.5;
    c.setLineDash([5, 3]);
    c.stroke();
    c.setLineDash([]);
  }

  #drawMarks(c) {
    for (const mark of this.model.marks.values()) {
      if (mark.removed) continue;
      const kind = kMarkKinds[mark.kind] ?? kMarkKinds.note;
      const [px, py] = this.camera.toScreen(mark.x, mark.y);
      const r = Math.max(11, Math.min(20, 0.35 * this.camera.scale));
      c.beginPath();
      if (kind.shape === 'disc') c.arc(px, py, r, 0, 2 * Math.PI);
      else if (kind.shape === 'square') c.roundRect(px - r * 0.85, py - r * 0.85, 1.7 * r, 1.7 * r, 4);
      else { c.moveTo(px, py - 1.25 * r); c.lineTo(px + 1.25 * r, py); c.lineTo(px, py + 1.25 * r); c.lineTo(px - 1.25 * r, py); c.closePath(); }
      c.fillStyle = kind.color;
      c.fill();
      c.lineWidth = 2;
      c.strokeStyle = '#fff';
      c.stroke();
      c.fillStyle = inkOn(kind.color);
      c.font = `700 ${Math.round(r)}px system-ui, "DejaVu Sans", sans-serif`;
      c.textAlign = 'center';
      c.textBaseline = 'middle';
      c.fillText(mark.number || '', px, py + 1);
      if (mark.text) {
        c.font = '600 12px system-ui, "DejaVu Sans", sans-serif';
        c.lineWidth = 3;
        c.strokeStyle = this.theme.paper;
        c.strokeText(mark.text, px, py + r + 13);
        c.fillStyle = this.theme.ink;
        c.fillText(mark.text, px, py + r + 13);
      }
    }
  }
}
