// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What pointer and keyboard do on the map.
import {kMarkKinds} from './colors.js';
import {Swing} from './swing.js';
import {drawAim, drawFrame, drawStretch} from './symbols.js';

const kClick_px = 6;
const kNear_px = 26;
const kKeyPan_px = 60;
const kKeyTurn_rad = Math.PI / 12;
const kKeyZoom = 1.25;
const kWheelZoom = 0.0015;  // Of each unit of a wheel, as a logarithm.
const kTwist_rad = 0.2;  // By which two fingers turn the map, and not just zoom.

const kHints = {
  look: '', measure: 'Drag from here to there', start: 'drag from where the robot is to where it looks',
  victim: 'Click where the victim is', hazard: 'Click where the hazard is', note: 'Click where the note belongs',
};
const isDragged = (tool) => tool === 'measure' || tool === 'start';
const angleOf = ([ax, ay], [bx, by]) => Math.atan2(ay - by, bx - ax);  // Of the way from a to b on a screen.

export class Tools {
  #pointers = new Map();  // Where each is, by its id.
  #pressed = null;  // Where the first was pressed.
  #anchor = null;  // What a drag began on, on the map.
  #drag = null;  // What it does: 'turn', 'frame', 'stretch' or 'pan'.
  #swing = new Swing();
  #twist = 0;

  // `actions`: select(name), place(name, pose), mark(kind, x, y), editMark(id), lookFrom(side), changed(),
  // enlarge(from, to) what is between two points of the screen, moved() and zoomed() when the operator has done that with the map, pointed(place) at somewhere on it.
  constructor(view, model, state, actions) {
    Object.assign(this, {view, model, state, actions});
    const {canvas} = view;
    const listen = (type, act, options) => canvas.addEventListener(type, (event) => act.call(this, event), options);
    listen('pointerdown', this.#down);
    listen('pointermove', this.#move);
    listen('pointerup', this.#up);
    listen('pointercancel', this.#cancel);
    listen('pointerleave', () => this.actions.pointed(null));
    listen('wheel', this.#wheel, {passive: false});
    listen('dblclick', this.#doubleClick);
    listen('contextmenu', (event) => event.preventDefault());
    listen('keydown', this.press);
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
    if (tool !== 'look') this.actions.moved();  // The map must not move under the hand.
    for (const button of document.querySelectorAll('[data-tool]')) button.setAttribute('aria-pressed', String(button.dataset.tool === tool));
    this.view.canvas.style.cursor = tool === 'look' ? 'grab' : 'crosshair';
    this.hint(tool === 'start' ? `${this.state.selected || 'robot'}: ${kHints.start}` : kHints[tool]);
    this.#giveUp();
    if (this.view.canvas.matches(':focus-visible')) this.#aim();
    this.actions.changed();
  }

  hint(text) {
    const hint = document.getElementById('hint');
    hint.textContent = text;
    hint.hidden = !text;
  }

  #at(event) { return [event.offsetX, event.offsetY]; }
  get #middle() { return [this.view.camera.width / 2, this.view.camera.height / 2]; }

  #down(event) {
    const at = this.#at(event);
    this.view.canvas.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, at);
    this.#twist = 0;
    this.#swing.begin();
    if (this.#pointers.size > 1) return this.#giveUp();
    this.view.camera.stop();
    this.#pressed = at;
    this.#anchor = this.view.camera.toMap(...at);
    this.#drag = this.#meantBy(event);
  }

  #meantBy({button, ctrlKey, shiftKey}) {
    if (button === 2 || ctrlKey) return 'turn';
    if (isDragged(this.state.tool)) return 'stretch';
    return shiftKey && this.state.tool === 'look' ? 'frame' : 'pan';
  }

  // Leaves what was begun: the hand may still move the map.
  #giveUp() {
    this.#drag = 'pan';
    this.#anchor = null;
    this.view.overlay = null;
  }

  #move(event) {
    const at = this.#at(event), before = this.#pointers.get(event.pointerId);
    this.actions.pointed(this.view.camera.isFromAbove ? this.view.camera.toMap(...at) : null);
    if (!before) return;
    this.#pointers.set(event.pointerId, at);
    if (this.#pointers.size === 2) this.#pinch(event.pointerId, before, at);
    else if (this.#drag === 'turn') this.#turn(this.#middle, before, at);
    else if (this.#drag === 'frame') this.#frame(at);
    else if (this.#drag === 'stretch') this.#stretch(this.view.camera.toMap(...at));
    else this.#pan(before, at, event.timeStamp);
    this.actions.changed();
  }

  #pan(before, at, now_ms) {
    this.#swing.note(at, now_ms);
    this.view.camera.pan(at[0] - before[0], at[1] - before[1]);
    if (this.#distance(at, this.#pressed) > kClick_px) this.actions.moved();
  }

  #distance([ax, ay], [bx, by]) { return Math.hypot(ax - bx, ay - by); }

  #turn(around, before, at) {
    this.view.camera.rotate(angleOf(around, at) - angleOf(around, before), around);
    this.actions.moved();
  }

  // One of two fingers moves: the other one stays where it is on the map.
  #pinch(id, before, at) {
    const [, other] = [...this.#pointers].find(([key]) => key !== id);
    this.view.camera.zoom(this.#distance(at, other) / Math.max(1, this.#distance(before, other)), other);
    this.#twist += Math.sin(angleOf(other, at) - angleOf(other, before));
    if (Math.abs(this.#twist) > kTwist_rad) this.#turn(other, before, at);
    this.#pressed = [Infinity, Infinity];  // That is no click.
    this.actions.zoomed();
  }

  // Draws what a drag, from where it began to a place on the map, means so far.
  #stretch(to) {
    const from = this.#anchor;
    const isMeasure = this.state.tool === 'measure';
    const length_m = this.#distance(from, to), degrees = Math.atan2(to[1] - from[1], to[0] - from[0]) * 180 / Math.PI;
    const text = isMeasure ? `${length_m.toFixed(2)} m` : `${degrees.toFixed(0)}°`;
    this.view.overlay = (c, camera, theme) => {
      drawStretch(c, camera.planeToScreen(...from), camera.planeToScreen(...to), {text, isArrow: !isMeasure, theme});
    };
  }

  #up(event) {
    if (!this.#pointers.delete(event.pointerId) || this.#pointers.size > 0) return;
    const at = this.#at(event);
    const isClick = this.#distance(at, this.#pressed) < kClick_px;
    if (isClick && this.#drag !== 'turn') this.#click(at);
    else if (this.#drag === 'frame') this.#enlarge(at);
    else if (this.#drag === 'pan') this.view.camera.coast(this.#swing.speed(event.timeStamp));
    else if (this.#drag === 'stretch' && this.state.tool === 'start') this.#finish(this.view.camera.toMap(...at));
    this.actions.changed();
  }

  #click(at) {
    if (this.#isMarking) this.#finish(this.view.camera.toMap(...at));
    else this.#pick(...at);
  }

  #frame(to) {
    if (this.#distance(to, this.#pressed) > kClick_px) this.actions.moved();  // It must not grow under the hand.
    this.view.overlay = (c, camera, theme) => drawFrame(c, this.#pressed, to, theme);
  }

  #enlarge(to) {
    this.view.overlay = null;
    this.actions.enlarge(this.#pressed, to);
  }

  get #isMarking() { return this.state.tool in kMarkKinds; }

  // Does what the tool is for.
  #finish([x, y]) {
    const {tool, selected} = this.state;
    const [fromX, fromY] = this.#anchor ?? [x, y];
    if (this.#isMarking) this.actions.mark(tool, x, y);
    else if (tool === 'start') this.actions.place(selected, {x: fromX, y: fromY, theta: Math.atan2(y - fromY, x - fromX)});
    this.choose('look');
  }

  #cancel(event) {
    this.#pointers.delete(event.pointerId);
    this.#giveUp();
    this.actions.changed();
  }

  #pick(px, py) {
    this.#anchor = null;
    const off = ({x, y, z}) => this.#distance(this.view.camera.toScreen(x, y, z), [px, py]);
    const mark = [...this.model.marks.values()].find((m) => !m.removed && off(m) < kNear_px / 1.5);
    if (mark) return this.actions.editMark(mark.id);
    const robots = this.model.robotsInMap().filter(({last}) => last && off(last) < kNear_px);
    robots.sort((a, b) => off(a.last) - off(b.last));
    this.actions.select(robots[0]?.name ?? null);
    this.view.overlay = null;
  }

  #wheel(event) {
    event.preventDefault();
    this.view.camera.zoomSmoothly(Math.exp(-event.deltaY * kWheelZoom), this.#at(event));
    this.actions.zoomed();
  }

  #doubleClick(event) {
    if (this.state.tool !== 'look') return;
    this.view.camera.zoomSmoothly(event.shiftKey ? 0.5 : 2, this.#at(event));
    this.actions.zoomed();
  }

  // A key that moves the map, or does in its middle what the tool is for.
  press(event) {
    const camera = this.view.camera;
    const pans = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const turns = {ArrowLeft: kKeyTurn_rad, ArrowRight: -kKeyTurn_rad};
    const zooms = {'+': kKeyZoom, '=': kKeyZoom, '-': 1 / kKeyZoom};
    if (event.key === 'Enter') return this.#enter(event);
    if (event.shiftKey && event.key in turns) camera.rotate(turns[event.key]);
    else if (event.key in pans) camera.pan(...pans[event.key].map((step) => step * kKeyPan_px));
    else if (event.key in zooms) camera.zoomSmoothly(zooms[event.key]);
    else return;
    event.preventDefault();
    if (event.key in zooms) this.actions.zoomed(); else this.actions.moved();
    this.#aim();
  }

  // Without a pointer, the middle of the map is where things are done.
  #enter(event) {
    event.preventDefault();
    const {tool} = this.state;
    const middle = this.view.camera.toMap(...this.#middle);
    if (tool === 'look') this.#pick(...this.#middle);
    else if (isDragged(tool) && !this.#anchor) this.#anchor = middle;
    else if (tool === 'measure') this.#anchor = null;  // The length stays to be read.
    else this.#finish(middle);
    this.actions.changed();
  }

  // Shows where the keyboard would do what the tool is for.
  #aim() {
    const {tool} = this.state;
    if (tool === 'look') return;
    if (isDragged(tool) && this.#anchor) return this.#stretch(this.view.camera.toMap(...this.#middle));
    this.view.overlay = (c, camera, theme) => drawAim(c, this.#middle, theme);
  }
}
