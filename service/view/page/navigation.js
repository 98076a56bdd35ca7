// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Where the map is looked at, and what moves that.
import {addressOf, fromAddress} from './address.js';
import {kSides} from './camera.js';

const kNear_px_per_m = 50;
const kZoomStep = 1.5;
const kScales_m = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500];
const kLeastScale_px = 60;
const $ = (id) => document.getElementById(id);

// What lies over the map, on each side: the list of robots beside it or, on a tablet held upright, below.
function margins() {
  const list = $('panel').getBoundingClientRect(), time = $('time').getBoundingClientRect();
  const isBeside = list.left > innerWidth / 3;
  return {left: $('tools').getBoundingClientRect().right, right: isBeside ? innerWidth - list.left : 0,
    top: 0, bottom: innerHeight - (isBeside ? time.top : list.top)};
}

export class Navigation {
  #showsAll = true;  // Until the operator moves the map, all of it is shown as it grows.
  #pointed = null;
  #restsAt = '';  // What of the map was looked at a moment ago.

  // `changed()` is called when the map has to be drawn.
  constructor(view, model, state, changed) {
    Object.assign(this, {view, model, state, changed, camera: view.camera});
    $('zoom-in').onclick = () => this.#zoomBy(kZoomStep);
    $('zoom-out').onclick = () => this.#zoomBy(1 / kZoomStep);
    $('fit').onclick = () => this.showAll();
    $('side').onclick = () => this.nextSide();
    $('upright').onclick = () => this.turnUpright();
    addEventListener('hashchange', ({newURL}) => this.#goToAddress(new URL(newURL).hash));
    this.#goToAddress(location.hash);
  }

  showAll() {
    this.#showsAll = true;
    this.state.followed = null;
    const whole = this.#whole();
    if (whole) this.camera.glideTo(whole);
    this.changed();
  }

  #whole() {
    const bounds = this.view.bounds();
    return bounds && this.camera.fitting(bounds, margins());
  }

  // Goes along with a map that grows: in steps, as to glide would be to draw all of it in each frame.
  update() {
    if (this.#showsAll && !this.camera.isGliding) Object.assign(this.camera, this.#whole());
    $('side').hidden = this.model.clouds.size === 0;
    this.#writeAddress();
  }

  #goToAddress(hash) {
    const place = fromAddress(hash);
    if (!place) return;
    this.moved();
    this.lookFrom('above');
    this.#showsAll = false;
    this.camera.glideTo(place);
  }

  // Once the map is at rest: browsers let nobody change the address all the time.
  #writeAddress() {
    const {key, isFromAbove} = this.camera;
    const isAtRest = key === this.#restsAt;
    this.#restsAt = key;
    const hash = this.#showsAll || !isFromAbove ? '' : addressOf(this.camera);
    if (isAtRest && hash !== location.hash) history.replaceState(null, '', hash || location.pathname + location.search);
  }

  // For those without a wheel: in the middle of what nothing lies over.
  #zoomBy(factor) {
    const {left, right, top, bottom} = margins();
    this.camera.zoomSmoothly(factor, [(left + this.camera.width - right) / 2, (top + this.camera.height - bottom) / 2]);
    this.zoomed();
  }

  // Shows what is between two points of the screen as large as may be.
  enlarge(from, to) {
    this.moved();
    this.camera.glideTo(this.camera.enlarging(from, to, margins()));
  }

  // The operator zooms; who is followed stays in the middle.
  zoomed() {
    this.#showsAll = false;
    this.changed();
  }

  // The operator moves the map, or it must not move under the hand.
  moved() {
    this.camera.stop();
    this.state.followed = null;
    this.zoomed();
  }

  goTo({x, y, z}) {
    this.moved();
    const [right, up] = this.camera.project(x, y, z);
    this.camera.glideTo({x: right, y: up, scale: Math.max(this.camera.scale, kNear_px_per_m)});
  }

  follow(name) {
    const isFollowed = this.state.followed === name;
    this.goTo(this.model.robots.get(name).last);
    this.state.followed = isFollowed ? null : name;
  }

  // Models in space are looked at from above or from a side.
  lookFrom(side) {
    if (this.camera.from === side) return;
    this.camera.look(side);
    $('side').querySelector('span').textContent = side[0].toUpperCase() + side.slice(1);
    this.showAll();
  }

  nextSide() {
    if (this.model.clouds.size > 0) this.lookFrom(kSides[(kSides.indexOf(this.camera.from) + 1) % kSides.length]);
  }

  turnUpright() {
    this.camera.glideTo({turn: 0});
    this.changed();
  }

  // Called in each frame. @return whether the map has moved.
  step(passed_ms) {
    const isGliding = this.camera.step(passed_ms);
    const followed = this.model.robots.get(this.state.followed)?.last;
    if (followed) [this.camera.x, this.camera.y] = this.camera.project(followed.x, followed.y, followed.z);
    return isGliding;
  }

  // The scale, and how the map is turned.
  drawScale() {
    const {scale, turn} = this.camera;
    const length_m = kScales_m.find((m) => m * scale > kLeastScale_px) ?? kScales_m.at(-1);
    $('scale-bar').style.width = `${length_m * scale}px`;
    $('scale-text').textContent = `${length_m} m`;
    $('upright').hidden = turn === 0;
    $('upright').querySelector('svg').style.transform = `rotate(${-turn}rad)`;
  }

  // Tells the place on the map at which the pointer is; null: at none.
  point(place) {
    this.#pointed = place;
    $('place-text').textContent = place ? this.#placeText : '';
  }

  get #placeText() { return `${this.#pointed.map((metres) => metres.toFixed(2)).join(', ')} m`; }

  // A clipboard is there only where the page is trusted. @return what to say of it.
  async copyPlace() {
    if (!this.#pointed) return '';
    const isCopied = await navigator.clipboard?.writeText(this.#placeText).then(() => true, () => false);
    return this.#placeText + (isCopied ? ' is copied' : '');
  }
}
