// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Plots over one axis, which they share: who zooms one, zooms all.

const kLeft_px = 62;
const kRight_px = 12;
const kTop_px = 10;
const kBottom_px = 34;

class SharedAxis {
  constructor(values, label) {
    Object.assign(this, { values, label, plots: [] });
    this.low = this.first = values.length ? values[0] : 0;
    this.high = this.last = Math.max(values.length ? values[values.length - 1] : 1, this.first + 1e-3);
  }
  set(low, high) {
    const width = Math.min(Math.max(high - low, (this.last - this.first) * 1e-5), this.last - this.first);
    const start = Math.min(Math.max(low, this.first), this.last - width);
    [this.low, this.high] = [start, start + width];
    for (const plot of this.plots) plot.stage.changed();
  }
  // Number of the first value that is not below.
  index(value) {
    let [low, high] = [0, this.values.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.values[middle] < value) low = middle + 1; else high = middle;
    }
    return low;
  }
  nearest(value) {
    const above = Math.min(this.index(value), this.values.length - 1);
    const below = Math.max(above - 1, 0);
    return value - this.values[below] < this.values[above] - value ? below : above;
  }
}

// @param series [{ values, color, name }], NaN is a gap; `marks` rows to be marked in red.
class Plot {
  constructor(axis, { title, unit, meaning, series, marks = [], digits: shown = 3 }) {
    Object.assign(this, { axis, title, unit, series, marks, shown });
    this.canvas = make('canvas', { role: 'img', 'aria-label': `${title}, ${unit}, over ${axis.label}` });
    this.stage = new Stage(this.canvas, (context) => this.draw(context));
    axis.plots.push(this);
    selection.listeners.push(() => this.stage.changed());
    attachPanZoom(this.canvas, this);
    this.element = make('div', { class: 'plot' }, make('h3', {}, `${title} (${unit})`), make('p', {}, meaning),
      make('div', { class: 'stage' }, this.canvas));
  }
  get width() { return this.stage.width - kLeft_px - kRight_px; }
  value(x_px) { return this.axis.low + (x_px - kLeft_px) / this.width * (this.axis.high - this.axis.low); }
  x(value) { return kLeft_px + (value - this.axis.low) / (this.axis.high - this.axis.low) * this.width; }
  pan(dx_px) {
    const shift = -dx_px / this.width * (this.axis.high - this.axis.low);
    this.axis.set(this.axis.low + shift, this.axis.high + shift);
  }
  zoom(factor, x_px) {
    const fixedValue = this.value(x_px);
    this.axis.set(fixedValue - (fixedValue - this.axis.low) / factor, fixedValue + (this.axis.high - fixedValue) / factor);
  }
  reset() { this.axis.set(this.axis.first, this.axis.last); }
  hover(x_px) { if (this.axis.values.length) selection.set(this.axis.nearest(this.value(x_px))); }
  click(x_px) { this.hover(x_px); }
  step(count) {
    selection.set(Math.min(Math.max(selection.row + count, 0), this.axis.values.length - 1));
    const now = this.axis.values[selection.row];
    if (now < this.axis.low || now > this.axis.high) {
      const half = (this.axis.high - this.axis.low) / 2;
      this.axis.set(now - half, now + half);
    }
  }

  // From zero to the largest value in view.
  range(first, end) {
    let high = 0;
    for (const { values } of this.series) {
      for (let i = first; i < end; ++i) if (values[i] > high) high = values[i];
    }
    return high > 0 ? high * 1.06 : 1;
  }
  draw(context) {
    const first = Math.max(this.axis.index(this.axis.low) - 1, 0);
    const end = Math.min(this.axis.index(this.axis.high) + 1, this.axis.values.length);
    const high = this.range(first, end);
    const base = this.stage.height - kBottom_px;
    const y = (value) => base - value / high * (base - kTop_px);
    this.drawAxes(context, high, y, base);
    context.save();
    context.beginPath();
    context.rect(kLeft_px, 0, this.width, this.stage.height);
    context.clip();
    for (const series of this.series) this.drawSeries(context, series, first, end, y);
    this.drawMarks(context, y, base);
    this.drawCursor(context, y, base);
    context.restore();
    this.drawLegend(context);
  }
  drawAxes(context, high, y, base) {
    context.font = kMarginFont;
    context.lineWidth = 1;
    context.strokeStyle = theme.color('line');
    context.fillStyle = theme.color('soft');
    const across = ticks(this.axis.low, this.axis.high, this.width / 110);
    context.textAlign = 'center';
    context.beginPath();
    for (const value of across.values) {
      const x = Math.round(this.x(value)) + 0.5;
      context.moveTo(x, kTop_px); context.lineTo(x, base);
      context.fillText(tickText(value, across.step), x, base + 15);
    }
    const up = ticks(0, high, 4);
    context.textAlign = 'right';
    for (const value of up.values) {
      const at = Math.round(y(value)) + 0.5;
      context.moveTo(kLeft_px, at); context.lineTo(kLeft_px + this.width, at);
      context.fillText(tickText(value, up.step), kLeft_px - 7, at + 4);
    }
    context.stroke();
    context.textAlign = 'center';
    context.fillText(this.axis.label, kLeft_px + this.width / 2, base + 29);
    context.save();
    context.translate(13, (kTop_px + base) / 2);
    context.rotate(-Math.PI / 2);
    context.fillText(this.unit, 0, 0);
    context.restore();
  }
  // Of the values within a pixel the lowest and highest are drawn, so that no peak is lost.
  drawSeries(context, { values, color }, first, end, y) {
    context.strokeStyle = theme.color(color);
    context.lineWidth = 1.3;
    context.beginPath();
    let [pixel, low, high, open] = [NaN, 0, 0, false];
    const flush = () => {
      if (Number.isNaN(pixel)) return;
      if (open) context.lineTo(pixel, y(low)); else context.moveTo(pixel, y(low));
      context.lineTo(pixel, y(high) - (high === low ? 0.01 : 0));
      open = true;
      pixel = NaN;
    };
    for (let i = first; i < end; ++i) {
      const value = values[i];
      if (Number.isNaN(value)) { flush(); open = false; continue; }
      const x = Math.round(2 * this.x(this.axis.values[i])) / 2;
      if (x !== pixel) { flush(); [pixel, low, high] = [x, value, value]; }
      [low, high] = [Math.min(low, value), Math.max(high, value)];
    }
    flush();
    context.stroke();
  }
  drawMarks(context, y, base) {
    context.fillStyle = theme.color('refused');
    for (const row of this.marks) {
      const x = this.x(this.axis.values[row]);
      if (x >= kLeft_px - 2) context.fillRect(x - 1, base - 5, 2, 5);
    }
  }
  drawCursor(context, y, base) {
    if (selection.row < 0) return;
    const x = this.x(this.axis.values[selection.row]);
    context.strokeStyle = theme.color('soft');
    context.setLineDash([3, 3]);
    context.beginPath();
    context.moveTo(x, kTop_px); context.lineTo(x, base);
    context.stroke();
    context.setLineDash([]);
    for (const { values, color } of this.series) {
      const value = values[selection.row];
      if (Number.isNaN(value)) continue;
      context.fillStyle = theme.color(color);
      context.beginPath();
      context.arc(x, y(value), 3.5, 0, 2 * Math.PI);
      context.fill();
    }
  }
  drawLegend(context) {
    context.font = kMarginFont;
    context.textAlign = 'right';
    let right = kLeft_px + this.width - 6;
    for (const { values, color, name } of [...this.series].reverse()) {
      const value = selection.row >= 0 ? ` ${digits(values[selection.row], this.shown)}` : '';
      const text = `${name || ''}${value}`;
      if (!text) continue;
      const width = context.measureText(text).width;
      context.fillStyle = theme.color('card');
      context.fillRect(right - width - 4, kTop_px + 1, width + 8, 17);
      context.fillStyle = theme.color(color);
      context.fillText(text, right, kTop_px + 14);
      right -= width + 16;
    }
  }
}
