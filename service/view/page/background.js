// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What stays on the map for a while, as one picture: cells, models, relevant scans, trails, loops.
import {pictureOf} from './cloud_picture.js';
import {kThemes} from './colors.js';

const kPeriod_ms = 400;
const kGridSteps_m = [0.5, 1, 2, 5, 10, 20, 50, 100];
const kLeastGridStep_px = 42;
const kLeastTrailStep_px = 2;

const within = (low, value, high) => Math.min(high, Math.max(low, value));

// Points x, y, x, y... of the map as squares.
export function drawPoints(c, camera, points, size) {
  const {c: along, s: across, x0, y0} = camera.affine;
  for (let i = 0; i < points.length; i += 2) {
    const x = points[i], y = points[i + 1];
    c.fillRect(x0 + along * x - across * y - size / 2, y0 - across * x - along * y - size / 2, size, size);
  }
}

export class Background {
  constructor(model, state, camera) {
    this.model = model;
    this.state = state;
    this.camera = camera;
    this.canvas = document.createElement('canvas');
  }

  resize(ratio) {
    this.ratio = ratio;
    this.canvas.width = Math.round(this.camera.width * ratio);
    this.canvas.height = Math.round(this.camera.height * ratio);
    this.shownView = null;
  }

  // At once for whoever moves the map; now and then for what comes from the robots.
  picture(now_ms) {
    const {theme, layers, shownStamp, shownEvent, selected} = this.state;
    const view = [this.camera.key, theme, JSON.stringify(layers), shownStamp, shownEvent?.at_ms, selected].join();
    const content = [this.model.mapVersion, ...[...this.model.robots.values()].map(({trail}) => trail.length)].join();
    const isDue = content !== this.shownContent && now_ms - this.drawn_ms > kPeriod_ms;
    if (view !== this.shownView || isDue) {
      Object.assign(this, {shownView: view, shownContent: content, drawn_ms: now_ms});
      this.#draw();
    }
    return this.canvas;
  }

  #draw() {
    const {layers, shownStamp, shownEvent} = this.state;
    const {isFromAbove} = this.camera;
    const c = this.canvas.getContext('2d', {alpha: false});
    this.theme = kThemes[this.state.theme];
    this.until = shownStamp ?? Infinity;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.fillStyle = this.theme.ground;
    c.fillRect(0, 0, this.camera.width, this.camera.height);
    const robots = this.model.robotsInMap();
    if (isFromAbove && shownStamp === null && layers.occupancy) this.#drawMaps(c);
    if (layers.occupancy) this.#drawClouds(c);
    if (layers.grid) this.#drawGrid(c);
    if (isFromAbove && (shownStamp !== null || layers.relevant)) this.#drawRelevant(c);
    if (layers.trails) for (const robot of robots) this.#drawTrail(c, robot);
    if (layers.loops) for (const {loops} of robots) this.#drawLoops(c, loops);
    if (shownEvent?.moves) this.#drawMoves(c, shownEvent.moves);
  }

  #drawMaps(c) {
    c.imageSmoothingEnabled = this.camera.scale < 20;
    for (const map of this.model.mapsInMap()) {
      for (const chunk of map.chunks.values()) this.#drawChunk(c, chunk);
    }
  }

  #drawChunk(c, chunk) {
    const {turn, scale, width, height} = this.camera;
    const side = chunk.size_m * scale;
    const [middleX, middleY] = this.camera.toScreen(chunk.x + chunk.size_m / 2, chunk.y + chunk.size_m / 2);
    const reach = side * Math.SQRT1_2;
    if (middleX + reach < 0 || middleX - reach > width || middleY + reach < 0 || middleY - reach > height) return;
    c.save();
    c.translate(middleX, middleY);
    c.rotate(-turn);
    const overlap = turn === 0 ? 0 : 0.5;  // Else seams would be seen between chunks.
    c.drawImage(chunk.picture(this.theme.palette), -side / 2, -side / 2, side + overlap, side + overlap);
    c.restore();
  }

  #drawClouds(c) {
    for (const points of this.model.clouds.values()) {
      c.drawImage(pictureOf(points, this.camera), 0, 0, this.camera.width, this.camera.height);
    }
  }

  #drawGrid(c) {
    const step = kGridSteps_m.find((m) => m * this.camera.scale > kLeastGridStep_px) ?? 200;
    const {corners} = this.camera;
    const xs = corners.map(([x]) => x), ys = corners.map(([, y]) => y);
    c.fillStyle = this.theme.dot;
    for (let x = Math.ceil(Math.min(...xs) / step) * step; x < Math.max(...xs); x += step) {
      for (let y = Math.ceil(Math.min(...ys) / step) * step; y < Math.max(...ys); y += step) {
        const [px, py] = this.camera.planeToScreen(x, y);
        c.fillRect(px - 0.75, py - 0.75, 1.5, 1.5);
      }
    }
  }

  #drawRelevant(c) {
    c.fillStyle = this.theme.point;
    c.globalAlpha = 0.75;
    const size = within(1.2, 0.03 * this.camera.scale, 3);
    for (const {stamp, points, frame} of this.model.relevant.values()) {
      if (stamp <= this.until && !this.model.isApart(frame)) drawPoints(c, this.camera, points, size);
    }
    c.globalAlpha = 1;
  }

  #drawTrail(c, robot) {
    const begin = robot.trail[0]?.stamp ?? Infinity;
    const before = robot.relevant.filter(({stamp}) => stamp < begin);
    let last = null;
    c.beginPath();
    for (const {x, y, z, stamp} of [...before, ...robot.trail]) {
      if (stamp > this.until) break;
      const [px, py] = this.camera.toScreen(x, y, z);
      if (last && Math.abs(px - last[0]) + Math.abs(py - last[1]) < kLeastTrailStep_px) continue;
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

  #drawLoops(c, loops) {
    c.strokeStyle = this.theme.moved;
    c.lineWidth = 1.5;
    c.beginPath();
    for (const [from, to] of loops) {
      if (to.stamp > this.until) continue;
      c.moveTo(...this.camera.toScreen(from.x, from.y, from.z));
      c.lineTo(...this.camera.toScreen(to.x, to.y, to.z));
    }
    c.stroke();
  }

  // Where scans were taken before a correction of the map, and where it has put them.
  #drawMoves(c, moves) {
    c.strokeStyle = this.theme.moved;
    c.fillStyle = this.theme.moved;
    c.lineWidth = 1.5;
    const size = within(1.2, 0.15 * this.camera.scale, 3.5);
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
}
