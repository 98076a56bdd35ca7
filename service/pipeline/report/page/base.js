// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What all parts of the report share: elements, numbers, colours, canvases, and what is looked at.
'use strict';

window.addEventListener('error', (event) => {
  const problem = document.getElementById('problem');
  problem.hidden = false;
  problem.textContent = `A part of this report could not be drawn: ${event.message}`;
});

const report = JSON.parse(document.getElementById('data').textContent);

// ---- Elements. Text is always set as text, so that no name in a log can become HTML.

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value !== false && value !== undefined) element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function section(id, title, lead, ...children) {
  const element = make('section', { id, 'aria-labelledby': `${id}-title` },
    make('h2', { id: `${id}-title` }, title), lead ? make('p', { class: 'lead' }, lead) : null, ...children);
  document.getElementById('content').append(element);
  document.getElementById('sections').append(make('a', { href: `#${id}` }, title));
  return element;
}

// Buttons of which one is pressed at a time.
function choice(label, names, chosen, onChoose) {
  const group = make('div', { class: 'group', role: 'group', 'aria-label': label });
  const show = (value) => {
    for (const button of group.children) button.setAttribute('aria-pressed', button.value === value);
  };
  for (const [value, text] of names) {
    group.append(make('button', { type: 'button', value, onclick: () => { show(value); onChoose(value); } }, text));
  }
  show(chosen);
  group.show = show;
  return group;
}

// A box to be ticked, with a sample of what it shows.
function layer(text, color, on, onChange, area = false) {
  const box = make('input', { type: 'checkbox', onchange: () => onChange(box.checked) });
  box.checked = on;
  return make('label', { class: 'layer' }, box,
    make('span', { class: area ? 'swatch area' : 'swatch', style: `background:${color}` }), text);
}

// ---- Numbers.

function floats(base64) {
  if (!base64) return new Float32Array(0);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Float32Array(bytes.buffer);
}

// With so many digits that count, thousands apart by thin spaces.
function digits(value, significant = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const decimals = Math.max(0, significant - 1 - Math.floor(Math.log10(Math.abs(value))));
  return fixed(value, Math.min(decimals, 9));
}

function fixed(value, decimals) {
  if (!Number.isFinite(value)) return '–';
  const [whole, rest] = Math.abs(value).toFixed(decimals).split('.');
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, '\u2009') : whole;
  const text = rest ? `${grouped}.${rest}` : grouped;
  return value < 0 && Number(text.replace(/\u2009/g, '')) !== 0 ? `−${text}` : text;
}

// Seconds as minutes and seconds, or hours.
function clock(time_s) {
  if (!Number.isFinite(time_s)) return '–';
  const tenths = Math.round(10 * time_s);
  const pad = (number) => String(number).padStart(2, '0');
  const seconds = `${pad(Math.floor(tenths / 10) % 60)}.${tenths % 10}`;
  const minutes = Math.floor(tenths / 600);
  return minutes < 60 ? `${minutes}:${seconds}` : `${Math.floor(minutes / 60)}:${pad(minutes % 60)}:${seconds}`;
}

function degrees(angle_rad) {
  return fixed(angle_rad * 180 / Math.PI, 1);
}

// About `count` round values from low to high, and their distance.
function ticks(low, high, count) {
  const rough = (high - low) / Math.max(count, 1);
  if (!(rough > 0)) return { step: 1, values: [low] };
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) values.push(k * step);
  return { step, values };
}

function tickText(value, step) {
  return fixed(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

// ---- Colours and canvases.

const theme = {
  listeners: [],
  color(name) { return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim(); },
  bytes(name) { return [1, 3, 5].map((at) => parseInt(theme.color(name).slice(at, at + 2), 16)); },
  set(name) {
    document.documentElement.dataset.theme = name;
    const button = document.getElementById('theme');
    button.textContent = name === 'dark' ? 'Light' : 'Dark';
    button.setAttribute('aria-label', `Switch to ${button.textContent.toLowerCase()} colours`);
    for (const listener of theme.listeners) listener();
  },
};

const kMarginFont = '12px system-ui, "DejaVu Sans", sans-serif';

// A canvas that is drawn anew, at most once per frame, whenever something changes; in CSS pixels.
class Stage {
  constructor(canvas, draw) {
    this.canvas = canvas;
    this.draw = draw;
    this.waiting = false;
    new ResizeObserver(() => this.changed()).observe(canvas);
    theme.listeners.push(() => this.changed());
  }
  get width() { return this.canvas.clientWidth; }
  get height() { return this.canvas.clientHeight; }
  changed() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.paint(); });
  }
  paint() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (width === 0 || height === 0) return;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      [this.canvas.width, this.canvas.height] = [width, height];
    }
    const context = this.canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.draw(context, this);
  }
}

// ---- What is looked at: one row of the scans, shown by every plot, the map and the line below it.

const selection = {
  row: -1,
  listeners: [],
  set(row) {
    if (row === selection.row) return;
    selection.row = row;
    for (const listener of selection.listeners) listener(row);
  },
};
