// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Moving over a picture by pointer, wheel, two fingers and keys.

// @param target has pan(dx_px, dy_px), zoom(factor, x_px, y_px) and reset(); it may have
//   click(x_px, y_px), hover(x_px, y_px) and step(count), for the arrow keys with Alt or by themselves.
function attachPanZoom(canvas, target) {
  const pointers = new Map();
  let moved_px = 0;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    if (pointers.size === 1) moved_px = 0;
  });
  canvas.addEventListener('pointermove', (event) => {
    const to = at(event);
    const from = pointers.get(event.pointerId);
    if (!from) {
      if (target.hover) target.hover(to.x, to.y);
      return;
    }
    moved_px += Math.hypot(to.x - from.x, to.y - from.y);
    if (pointers.size === 1) {
      target.pan(to.x - from.x, to.y - from.y, event);
    } else {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const before = Math.hypot(from.x - other.x, from.y - other.y);
      const after = Math.hypot(to.x - other.x, to.y - other.y);
      if (before > 0 && after > 0) target.zoom(after / before, (to.x + other.x) / 2, (to.y + other.y) / 2);
    }
    pointers.set(event.pointerId, to);
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    const { x, y } = at(event);
    if (event.type === 'pointerup' && moved_px < 4 && target.click) target.click(x, y);
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('dblclick', () => target.reset());

  // The page scrolls on with the wheel unless the picture has been clicked or is zoomed with Ctrl.
  canvas.addEventListener('wheel', (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    const { x, y } = at(event);
    target.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), x, y);
  }, { passive: false });

  canvas.tabIndex = 0;
  canvas.addEventListener('keydown', (event) => {
    const [x, y] = [canvas.clientWidth / 2, canvas.clientHeight / 2];
    const stepping = target.step && !event.altKey;
    const actions = {
      '+': () => target.zoom(1.25, x, y), '=': () => target.zoom(1.25, x, y),
      '-': () => target.zoom(0.8, x, y), '0': () => target.reset(),
      ArrowLeft: () => (stepping ? target.step(event.shiftKey ? -20 : -1) : target.pan(40, 0, event)),
      ArrowRight: () => (stepping ? target.step(event.shiftKey ? 20 : 1) : target.pan(-40, 0, event)),
      ArrowUp: () => target.pan(0, 40, event), ArrowDown: () => target.pan(0, -40, event),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    actions[event.key]();
  });
}

// Buttons for those who have neither wheel nor keys.
function zoomButtons(canvas, target) {
  const zoom = (factor) => target.zoom(factor, canvas.clientWidth / 2, canvas.clientHeight / 2);
  const button = (text, label, act) =>
    make('button', { type: 'button', 'aria-label': label, title: label, onclick: act }, text);
  return make('div', { class: 'corner' }, button('+', 'Zoom in', () => zoom(1.5)),
    button('−', 'Zoom out', () => zoom(1 / 1.5)), button('⤢', 'Show all', () => target.reset()));
}

// A part of the plane, seen from above: x to the right, y up.
class PlaneView {
  constructor(stage, bounds) {
    Object.assign(this, { stage, bounds });
    this.fitted = true;  // To the bounds, until somebody moves it.
    Object.assign(this, { x_m: 0, y_m: 0, px_per_m: 1 });
  }
  fit() {
    const { low, high } = this.bounds;
    const margin_px = 24;
    this.px_per_m = Math.max(1e-3, Math.min((this.stage.width - 2 * margin_px) / Math.max(high[0] - low[0], 0.5),
      (this.stage.height - 2 * margin_px) / Math.max(high[1] - low[1], 0.5)));
    [this.x_m, this.y_m] = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  }
  x(x_m) { return this.stage.width / 2 + (x_m - this.x_m) * this.px_per_m; }
  y(y_m) { return this.stage.height / 2 - (y_m - this.y_m) * this.px_per_m; }
  toMap(x_px, y_px) {
    return [this.x_m + (x_px - this.stage.width / 2) / this.px_per_m,
      this.y_m - (y_px - this.stage.height / 2) / this.px_per_m];
  }
  reset() { this.fitted = true; this.stage.changed(); }
  pan(dx_px, dy_px) {
    this.fitted = false;
    this.x_m -= dx_px / this.px_per_m;
    this.y_m += dy_px / this.px_per_m;
    this.stage.changed();
  }
  zoom(factor, x_px, y_px) {
    this.fitted = false;
    const [x_m, y_m] = this.toMap(x_px, y_px);
    this.px_per_m = Math.min(Math.max(this.px_per_m * factor, 0.02), 5000);
    const [now_x_m, now_y_m] = this.toMap(x_px, y_px);
    this.x_m += x_m - now_x_m;
    this.y_m += y_m - now_y_m;
    this.stage.changed();
  }
  show(low, high) {
    this.fitted = false;
    const bounds = this.bounds;
    this.bounds = { low, high };
    this.fit();
    this.bounds = bounds;
    this.stage.changed();
  }
}

function drawScale(context, stage, px_per_m) {
  const { step } = ticks(0, 120 / px_per_m, 1);
  const length_px = step * px_per_m;
  const text = step >= 1000 ? `${step / 1000} km` : step >= 1 ? `${step} m` : `${Math.round(step * 100)} cm`;
  const [x, y] = [16, stage.height - 16];
  context.font = kMarginFont;
  context.fillStyle = theme.color('card');
  context.globalAlpha = 0.8;
  context.fillRect(x - 8, y - 16, length_px + context.measureText(text).width + 24, 26);
  context.globalAlpha = 1;
  context.fillStyle = context.strokeStyle = theme.color('ink');
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x, y - 5); context.lineTo(x, y); context.lineTo(x + length_px, y); context.lineTo(x + length_px, y - 5);
  context.stroke();
  context.textAlign = 'left';
  context.fillText(text, x + length_px + 8, y + 2);
}
