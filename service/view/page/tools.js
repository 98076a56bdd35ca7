// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What pointer and keyboard do on the map.
import {kMarkKinds} from './map_view.js';

const kClick_px = 6;
const kNear_px = 26;
const kKeyPan_px = 60;

const kHints = {
  look: '', measure: 'Drag from here to there',
  start: 'Drag from where the robot is to where it looks', victim: 'Click where the victim is', hazard: 'Click where the hazard is', note: 'Click where the note belongs',
};

export class Tools {
  // `actions`: select(name), place(name, pose), mark(kind, x, y), editMark(id), changed(), stopFollowing().
  constructor(view, model, state, actions) {
    this.view = view;
    this.model = model;
    this.state = state;
    this.actions = actions;
    this.pointers = new Map();
    const canvas = view.canvas;
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', (event) => this.#up(event));
    canvas.addEventListener('pointercancel', (event) => this.#cancel(event));
    canvas.addEventListener('wheel', (event) => this.#wheel(event), {passive: false});
    canvas.addEventListener('keydown', (event) => this.#key(event));
    for (const button of document.querySelectorAll('[data-tool]')) button.addEventListener('click', () => this.choose(button.dataset.tool));
  }

  choose(tool) {
    if (tool === 'start' && !this.model.robots.has(this.state.selected)) {
      const only = this.model.robots.size === 1 ? [...this.model.robots.keys()][0] : null;
      if (only === null) return this.hint('Choose the robot first: on the map or in the list');
      this.actions.select(only);
    }
    if (tool !== 'look' && tool !== 'measure') this.actions.lookFrom('above');  // Places are of the map.
    this.state.tool = tool;
    if (tool !== 'look') this.actions.stopFollowing();  // The map must not move under the hand.
    for (const button of document.querySelectorAll('[data-tool]')) button.setAttribute('aria-pressed', String(button.dataset.tool === tool));
    this.view.canvas.style.cursor = tool === 'look' ? 'grab' : 'crosshair';
    this.hint(tool === 'start' ? `${this.state.selected || 'robot'}: ${kHints.start.toLowerCase()}` : kHints[tool]);
    this.view.overlay = null;
    this.actions.changed();
  }

  hint(text) {
    const hint = document.getElementById('hint');
    hint.textContent = text;
    hint.hidden = !text;
  }

  #at(event) { return [event.offsetX, event.offsetY]; }

  #down(event) {
    this.view.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, this.#at(event));
    if (this.pointers.size === 1) this.from = this.#at(event);
  }

  #move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const at = this.#at(event);
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size === 2) this.#pinch(event.pointerId, before, at);
    else if (this.state.tool === 'measure' || this.state.tool === 'start') this.#stretch(at);
    else {
      this.view.camera.pan(at[0] - before[0], at[1] - before[1]);
      if (Math.hypot(at[0] - this.from[0], at[1] - this.from[1]) > kClick_px) this.actions.stopFollowing();
    }
    this.actions.changed();
  }

  #pinch(id, before, at) {
    const [, other] = [...this.pointers].find(([key]) => key !== id);
    const length = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
    this.view.camera.zoom(length(at) / Math.max(1, length(before)), other[0], other[1]);
  }

  // Draws what a drag means so far.
  #stretch(at) {
    const from = this.view.camera.toMap(...this.from), to = this.view.camera.toMap(...at);
    const isMeasure = this.state.tool === 'measure';
    const length_m = Math.hypot(to[0] - from[0], to[1] - from[1]);
    const degrees = Math.atan2(to[1] - from[1], to[0] - from[0]) * 180 / Math.PI;
    const text = isMeasure ? `${length_m.toFixed(2)} m` : `${degrees.toFixed(0)}°`;
    this.view.overlay = (c, camera, theme) => {
      const [ax, ay] = camera.planeToScreen(...from), [bx, by] = camera.planeToScreen(...to);
      c.lineWidth = 6; c.strokeStyle = theme.paper;
      c.beginPath(); c.moveTo(ax, ay); c.lineTo(bx, by); c.stroke();
      c.lineWidth = 3; c.strokeStyle = isMeasure ? '#d55e00' : '#ffc800';
      c.stroke();
      if (!isMeasure) {
        c.beginPath(); c.arc(ax, ay, 8, 0, 2 * Math.PI); c.fillStyle = '#ffc800'; c.fill(); c.stroke();
        const angle = Math.atan2(by - ay, bx - ax);
        c.beginPath(); c.moveTo(bx, by);
        c.lineTo(bx - 15 * Math.cos(angle - 0.45), by - 15 * Math.sin(angle - 0.45));
        c.lineTo(bx - 15 * Math.cos(angle + 0.45), by - 15 * Math.sin(angle + 0.45));
        c.fill();
      }
      c.font = '700 15px system-ui, "DejaVu Sans", sans-serif'; c.textAlign = 'center'; c.textBaseline = 'bottom';
      c.lineWidth = 4; c.strokeStyle = theme.paper; c.strokeText(text, (ax + bx) / 2, (ay + by) / 2 - 8);
      c.fillStyle = theme.ink; c.fillText(text, (ax + bx) / 2, (ay + by) / 2 - 8);
    };
  }

  #up(event) {
    if (!this.pointers.delete(event.pointerId) || this.pointers.size > 0) return;
    const at = this.#at(event), [x, y] = this.view.camera.toMap(...at);
    const isClick = Math.hypot(at[0] - this.from[0], at[1] - this.from[1]) < kClick_px;
    const {tool} = this.state;
    if (tool === 'start' && !isClick) {
      const [fx, fy] = this.view.camera.toMap(...this.from);
      this.actions.place(this.state.selected, {x: fx, y: fy, theta: Math.atan2(y - fy, x - fx)});
      this.choose('look');
    } else if (tool in kMarkKinds && isClick) {
      this.actions.mark(tool, x, y);
      this.choose('look');
    } else if (isClick) {
      this.#pick(...at);
    }
    this.actions.changed();
  }

  #cancel(event) {
    this.pointers.delete(event.pointerId);
    this.view.overlay = null;
  }

  #pick(px, py) {
    const near = ({x, y, z}) => { const [sx, sy] = this.view.camera.toScreen(x, y, z); return Math.hypot(sx - px, sy - py); };
    const mark = [...this.model.marks.values()].find((m) => !m.removed && near(m) < kNear_px / 1.5);
    if (mark) return this.actions.editMark(mark.id);
    const robots = this.model.robotsInMap().filter(({last}) => last && near(last) < kNear_px);
    robots.sort((a, b) => near(a.last) - near(b.last));
    this.actions.select(robots[0]?.name ?? null);
    this.view.overlay = null;
  }

  #wheel(event) {
    event.preventDefault();
    this.view.camera.zoom(Math.exp(-event.deltaY * 0.0015), ...this.#at(event));
    this.actions.changed();
  }

  #key(event) {
    const camera = this.view.camera;
    const pans = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    if (event.key in pans) {
      const [dx, dy] = pans[event.key];
      camera.pan(dx * kKeyPan_px, dy * kKeyPan_px);
      this.actions.stopFollowing();
    } else if (event.key === '+' || event.key === '=') camera.zoom(1.25);
    else if (event.key === '-') camera.zoom(0.8);
    else return;
    event.preventDefault();
    this.actions.changed();
  }
}

