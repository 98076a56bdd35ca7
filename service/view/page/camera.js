// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// From where the map is looked at: which point of it is where on the screen.

const kFit_px = 60;
const kLeast_px = 60;  // What is filled however little is left between what lies over the map.
const kMost_px_per_m = 400;
const kLeast_px_per_m = 0.2;
const kGlide_ms = 70;  // After which two thirds of a way are gone.
const kCoast_ms = 250;  // As long, where the map was pushed.
const kArrived = 1e-3;  // Of a screen, or of a scale.
const kRightOf = {above: [1, 0], south: [1, 0], east: [0, 1], north: [-1, 0], west: [0, -1]};
export const kSides = Object.keys(kRightOf);

const within = (low, value, high) => Math.min(high, Math.max(low, value));
const isMotionUnwanted = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

export class Camera {
  #goal = null;

  constructor() {
    Object.assign(this, {x: 0, y: 0, scale: 40, width: 1, height: 1});
    this.look('above');
  }

  // From above, or from a side: then what is up on the screen is up.
  look(from) {
    this.from = from;
    [this.rightX, this.rightY] = kRightOf[from];
    this.turn = 0;  // By which the map is turned on the screen, counterclockwise, rad.
    this.#goal = null;
  }

  get isFromAbove() { return this.from === 'above'; }
  get key() { return [this.from, this.x, this.y, this.scale, this.turn, this.width, this.height].join(); }

  // Right and up on the plane that is looked at, m.
  project(x, y, z = 0) { return this.isFromAbove ? [x, y] : [this.rightX * x + this.rightY * y, z]; }

  // The screen's point of (x, y) of the plane is (x0 + c x - s y, y0 - s x - c y).
  get affine() {
    const c = this.scale * Math.cos(this.turn), s = this.scale * Math.sin(this.turn);
    return {c, s, x0: this.width / 2 - c * this.x + s * this.y, y0: this.height / 2 + s * this.x + c * this.y};
  }

  planeToScreen(x, y) {
    const {c, s, x0, y0} = this.affine;
    return [x0 + c * x - s * y, y0 - s * x - c * y];
  }

  toScreen(x, y, z = 0) { return this.planeToScreen(...this.project(x, y, z)); }

  toMap(px, py) {
    const c = Math.cos(this.turn), s = Math.sin(this.turn);
    const right = (px - this.width / 2) / this.scale, up = (this.height / 2 - py) / this.scale;
    return [this.x + c * right + s * up, this.y - s * right + c * up];
  }

  // Corners of the screen, on the plane.
  get corners() { return [[0, 0], [this.width, 0], [this.width, this.height], [0, this.height]].map(([px, py]) => this.toMap(px, py)); }

  pan(dx, dy) {
    this.#goal = null;
    [this.x, this.y] = this.toMap(this.width / 2 - dx, this.height / 2 - dy);
  }

  // What a point of the screen shows stays there.
  #keep([px, py], change) {
    const [x, y] = this.toMap(px, py);
    change();
    const [nextX, nextY] = this.toMap(px, py);
    this.x += x - nextX;
    this.y += y - nextY;
  }

  get #middle() { return [this.width / 2, this.height / 2]; }

  zoom(factor, at = this.#middle) {
    this.#goal = null;
    this.#keep(at, () => { this.scale = within(kLeast_px_per_m, this.scale * factor, kMost_px_per_m); });
  }

  rotate(angle, at = this.#middle) {
    if (!this.isFromAbove) return;
    this.#goal = null;
    this.#keep(at, () => { this.turn = Math.atan2(Math.sin(this.turn + angle), Math.cos(this.turn + angle)); });
  }

  // As zoom(), but the eye can follow.
  zoomSmoothly(factor, at = this.#middle) {
    const scale = (this.#goal?.at ? this.#goal.scale : this.scale) * factor;
    this.#goal = {at, scale: within(kLeast_px_per_m, scale, kMost_px_per_m), turn: this.turn};
  }

  glideTo({x = this.x, y = this.y, scale = this.scale, turn = this.turn}) {
    this.#goal = {x, y, scale: within(kLeast_px_per_m, scale, kMost_px_per_m), turn};
  }

  // Goes on as fast as it was pushed, in px/ms, and comes to rest.
  coast([speedX, speedY]) {
    if (isMotionUnwanted()) return;
    const [x, y] = this.toMap(this.width / 2 - kCoast_ms * speedX, this.height / 2 - kCoast_ms * speedY);
    this.#goal = {x, y, scale: this.scale, turn: this.turn, pace_ms: kCoast_ms};
  }

  stop() { this.#goal = null; }
  get isGliding() { return this.#goal !== null; }

  // Goes on to where it was sent. @return whether it has moved.
  step(passed_ms) {
    if (!this.#goal) return false;
    const {x, y, scale, turn, at, pace_ms = kGlide_ms} = this.#goal;
    const share = isMotionUnwanted() ? 1 : 1 - Math.exp(-passed_ms / pace_ms);
    const enlarge = () => { this.scale *= (scale / this.scale) ** share; };
    if (at) {
      this.#keep(at, enlarge);
    } else {
      enlarge();
      this.x += share * (x - this.x);
      this.y += share * (y - this.y);
      this.turn += share * (turn - this.turn);
    }
    if (this.#isNear(this.#goal)) this.#arrive(this.#goal);
    return true;
  }

  #isNear({x = this.x, y = this.y, scale, turn}) {
    const off_px = this.scale * Math.hypot(x - this.x, y - this.y);
    return off_px < kArrived * this.width && Math.abs(Math.log(scale / this.scale)) < kArrived && Math.abs(turn - this.turn) < kArrived;
  }

  #arrive({x = this.x, y = this.y, scale, turn, at}) {
    if (at) this.#keep(at, () => { this.scale = scale; });
    else Object.assign(this, {x, y, scale, turn});
    this.#goal = null;
  }

  // Of a length of the screen between margins what is filled: on a small one more of it.
  #within(margins_px, length_px) {
    const left_px = Math.max(length_px - margins_px, kLeast_px);
    return left_px - 2 * Math.min(kFit_px, left_px / 6);
  }

  // Where it has to go for a box of the plane to be seen between margins. @return for glideTo().
  fitting({left, right, bottom, top}, margins) {
    const c = Math.cos(this.turn), s = Math.sin(this.turn);
    const width_m = Math.max(right - left, 1), height_m = Math.max(top - bottom, 1);
    const wide_px = this.#within(margins.left + margins.right, this.width), high_px = this.#within(margins.top + margins.bottom, this.height);
    const scale = Math.min(wide_px / (Math.abs(c) * width_m + Math.abs(s) * height_m), high_px / (Math.abs(s) * width_m + Math.abs(c) * height_m));
    return this.#between(margins, [(left + right) / 2, (bottom + top) / 2], within(kLeast_px_per_m, scale, kMost_px_per_m / 4));
  }

  // Where it has to go for what is between two points of the screen to fill it between margins. @return for glideTo().
  enlarging([ax, ay], [bx, by], margins) {
    const wide_px = this.width - margins.left - margins.right, high_px = this.height - margins.top - margins.bottom;
    const factor = Math.min(wide_px / Math.max(1, Math.abs(bx - ax)), high_px / Math.max(1, Math.abs(by - ay)));
    const scale = within(kLeast_px_per_m, this.scale * factor, kMost_px_per_m);
    return this.#between(margins, this.toMap((ax + bx) / 2, (ay + by) / 2), scale);
  }

  // A place in the middle between margins, which is off the screen's.
  #between({left, right, top, bottom}, [x, y], scale) {
    const c = Math.cos(this.turn), s = Math.sin(this.turn);
    const off_right = (right - left) / 2 / scale, off_up = (top - bottom) / 2 / scale;
    return {x: x + c * off_right + s * off_up, y: y - s * off_right + c * off_up, scale};
  }
}
