// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The report of a registration in space: the merged cloud from any side, plots, scans, loops.

// Directions that a picture has to the right and upwards, by the angles it is looked at from.
const kSides = { above: [0, Math.PI / 2], side: [0, 0], front: [Math.PI / 2, 0] };

// @param pose translation, and rotation row by row; @param points in steps of `step_m`.
function transformed(pose, points, step_m) {
  const result = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const row = 3 + 3 * k;
      result[i + k] = pose[k] + step_m * (pose[row] * points[i] + pose[row + 1] * points[i + 1] + pose[row + 2] * points[i + 2]);
    }
  }
  return result;
}

function sixteenBits(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Int16Array(bytes.buffer);
}

// The model as an image: where more points lie behind each other, the colour is fuller.
class CloudPicture {
  constructor(scans) { this.scans = scans; }
  // @param view { right, up, center_m, px_per_m }; @param chosen number of a scan to be drawn red.
  draw(context, stage, view, moment, chosen) {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(stage.width * ratio), Math.round(stage.height * ratio)];
    const counts = new Float32Array(width * height);
    const red = new Uint8Array(width * height);
    const scale = view.px_per_m * ratio;
    this.scans.forEach((scan, number) => {
      const points = scan[moment];
      for (let i = 0; i < points.length; i += 3) {
        const [x, y, z] = [points[i] - view.center_m[0], points[i + 1] - view.center_m[1], points[i + 2] - view.center_m[2]];
        const px = Math.round(width / 2 + scale * (x * view.right[0] + y * view.right[1] + z * view.right[2]));
        const py = Math.round(height / 2 - scale * (x * view.up[0] + y * view.up[1] + z * view.up[2]));
        if (px < 0 || py < 0 || px >= width || py >= height) continue;
        ++counts[py * width + px];
        if (number === chosen) red[py * width + px] = 1;
      }
    });
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.putImageData(this.shade(counts, red, width, height), 0, 0);
    context.restore();
  }
  shade(counts, red, width, height) {
    const image = new ImageData(width, height);
    const [paper, ink, mark] = ['card', 'wall', 'scan'].map(theme.bytes);
    const full = Math.log1p(12);
    for (let i = 0; i < counts.length; ++i) {
      const share = counts[i] ? 0.3 + 0.7 * Math.min(Math.log1p(counts[i]) / full, 1) : 0;
      for (let k = 0; k < 3; ++k) {
        image.data[4 * i + k] = red[i] ? mark[k] : paper[k] + share * (ink[k] - paper[k]);
      }
      image.data[4 * i + 3] = 255;
    }
    return image;
  }
}

class CloudReport {
  constructor() {
    const { step_m, all } = report.scans;
    this.scans = all.map((scan) => {
      const points = sixteenBits(scan.cloud);
      return { ...scan, cloud: null, afterPose: scan.after, beforePose: scan.before,
        before: transformed(scan.before, points, step_m), after: transformed(scan.after, points, step_m) };
    });
    this.picture = new CloudPicture(this.scans);
    Object.assign(this, { moment: 'after', chosen: -1, turning: false, fitted: true, yaw: 0, pitch: Math.PI / 2 });
    this.bounds = this.boundsOfModel();
    this.center_m = [0, 1, 2].map((k) => (this.bounds.low[k] + this.bounds.high[k]) / 2);
    this.px_per_m = 10;
    this.shown = { path: true, loops: true };
  }

  // All of the points but the few that lie far off, and the whole path.
  boundsOfModel() {
    const [low, high] = [[], []];
    for (let k = 0; k < 3; ++k) {
      const values = this.scans.flatMap((scan) => Array.from({ length: scan.after.length / 3 }, (_, i) => scan.after[3 * i + k]));
      values.sort((a, b) => a - b);
      const stray = Math.floor(0.002 * values.length);
      const path = this.scans.map((scan) => scan.afterPose[k]);
      low.push(Math.min(values[stray] ?? 0, ...path));
      high.push(Math.max(values[values.length - 1 - stray] ?? 1, ...path));
    }
    return { low, high };
  }

  // ---- Looking.

  axes() {
    const { yaw, pitch } = this;
    const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    return { right: [cy, sy, 0], up: [-sy * sp, cy * sp, cp] };
  }
  fit() {
    const { right, up } = this.axes();
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => [0, 1, 2].map((k) => (bits >> k & 1 ? this.bounds.high[k] : this.bounds.low[k])));
    const extent = (axis) => {
      const along = corners.map((corner) => corner.reduce((sum, value, k) => sum + value * axis[k], 0));
      return Math.max(...along) - Math.min(...along);
    };
    this.center_m = [0, 1, 2].map((k) => (this.bounds.low[k] + this.bounds.high[k]) / 2);
    this.px_per_m = Math.min((this.stage.width - 40) / Math.max(extent(right), 1), (this.stage.height - 40) / Math.max(extent(up), 1));
  }
  look(side) {
    this.turning = side === 'turn';
    if (!this.turning) [this.yaw, this.pitch] = kSides[side]; else [this.yaw, this.pitch] = [-0.6, 0.6];
    this.reset();
  }
  reset() { this.fitted = true; this.stage.changed(); }
  pan(dx_px, dy_px, event) {
    if (this.turning && !event.shiftKey) {
      this.yaw -= dx_px * 0.008;
      this.pitch = Math.min(Math.max(this.pitch + dy_px * 0.008, -Math.PI / 2), Math.PI / 2);
    } else {
      this.fitted = false;
      const { right, up } = this.axes();
      for (let k = 0; k < 3; ++k) this.center_m[k] += (-dx_px * right[k] + dy_px * up[k]) / this.px_per_m;
    }
    this.stage.changed();
  }
  zoom(factor, x_px, y_px) {
    this.fitted = false;
    const [dx, dy] = [x_px - this.stage.width / 2, y_px - this.stage.height / 2];
    const { right, up } = this.axes();
    const shift = (1 - 1 / factor) / this.px_per_m;
    for (let k = 0; k < 3; ++k) this.center_m[k] += shift * (dx * right[k] - dy * up[k]);
    this.px_per_m *= factor;
    this.stage.changed();
  }
  project(point, view, stage) {
    const offset = [0, 1, 2].map((k) => point[k] - view.center_m[k]);
    const along = (axis) => offset.reduce((sum, value, k) => sum + value * axis[k], 0);
    return [stage.width / 2 + view.px_per_m * along(view.right), stage.height / 2 - view.px_per_m * along(view.up)];
  }
  poses() { return this.scans.map((scan) => (this.moment === 'after' ? scan.afterPose : scan.beforePose)); }
  choose(number) { this.chosen = number; selection.set(number); this.stage.changed(); }

  showModel() {
    this.canvas = make('canvas', { class: 'big', role: 'img', 'aria-label': 'The merged cloud; arrow keys move or turn it, plus and minus zoom, 0 shows all' });
    this.stage = new Stage(this.canvas, (context) => this.draw(context));
    attachPanZoom(this.canvas, this);
    this.readout = make('p', { class: 'readout', 'aria-live': 'polite' });
    selection.listeners.push((row) => { this.chosen = row; this.stage.changed(); this.tell(); });
    const box = (name, text, color) => layer(text, `var(--${color})`, true, (on) => { this.shown[name] = on; this.stage.changed(); });
    const loops = this.scans.reduce((sum, scan) => sum + scan.loops_to.length, 0);
    const share = report.scans.share < 1 ? ` ${fixed(100 * report.scans.share, 1)} % of the points are shown, evenly taken from all scans; model.ply has more.` : '';
    section('model', 'Model', 'The scans put together; the colour is fuller where more points lie behind each other. “Before” is where '
      + `odometry has them, “after” where registration has put them.${share} x is red, y green, z blue.`,
    make('div', { class: 'bar' },
      choice('Moment', [['after', 'After'], ['before', 'Before']], 'after', (moment) => { this.moment = moment; this.stage.changed(); this.tell(); }),
      choice('Side', [['above', 'From above'], ['side', 'From the side'], ['front', 'From the front'], ['turn', 'Turn']], 'above', (side) => this.look(side)),
      box('path', 'path', 'path-3'), loops ? box('loops', `loops closed (${loops})`, 'loop') : null),
    make('div', { class: 'stage' }, this.canvas, zoomButtons(this.canvas, this)), this.readout,
    make('p', { class: 'lead' }, 'Drag to move, or with “Turn” to turn (Shift moves); click the picture, then zoom with the wheel, or pinch; keys: arrows, +, −, 0.'));
    this.tell();
  }
  draw(context) {
    if (this.fitted) this.fit();
    const view = { ...this.axes(), center_m: this.center_m, px_per_m: this.px_per_m };
    this.picture.draw(context, this.stage, view, this.moment, this.chosen);
    const stops = this.poses().map((pose) => this.project(pose, view, this.stage));
    context.lineJoin = 'round';
    if (this.shown.loops) this.drawLoops(context, stops);
    if (this.shown.path) this.drawPath(context, stops);
    this.drawAxes(context, view);
    drawScale(context, this.stage, this.px_per_m);
  }
  drawPath(context, stops) {
    context.strokeStyle = context.fillStyle = theme.color('path-3');
    context.lineWidth = 1.8;
    context.beginPath();
    for (const [x, y] of stops) context.lineTo(x, y);
    context.stroke();
    stops.forEach(([x, y], number) => {
      context.beginPath();
      context.fillStyle = theme.color(number === this.chosen ? 'scan' : this.scans[number].matched || number === 0 ? 'path-3' : 'refused');
      context.arc(x, y, number === this.chosen ? 7 : 3.5, 0, 2 * Math.PI);
      context.fill();
    });
  }
  drawLoops(context, stops) {
    context.strokeStyle = theme.color('loop');
    context.lineWidth = 2;
    context.beginPath();
    this.scans.forEach((scan, number) => {
      for (const other of scan.loops_to) { context.moveTo(...stops[number]); context.lineTo(...stops[other]); }
    });
    context.stroke();
  }
  drawAxes(context, view) {
    const [x, y, length] = [this.stage.width - 60, this.stage.height - 50, 32];
    context.font = kMarginFont;
    context.lineWidth = 2;
    [['x', '#d0302c'], ['y', '#2c9a3e'], ['z', '#3b76d6']].forEach(([name, color], k) => {
      const end = [x + length * view.right[k], y - length * view.up[k]];
      if (Math.hypot(end[0] - x, end[1] - y) < 4) return;
      context.strokeStyle = context.fillStyle = color;
      context.beginPath(); context.moveTo(x, y); context.lineTo(...end); context.stroke();
      context.textAlign = 'center';
      context.fillText(name, x + 1.3 * (end[0] - x), y + 1.3 * (end[1] - y) + 4);
    });
  }
  tell() {
    const scan = this.scans[this.chosen];
    if (!scan) { this.readout.textContent = 'No scan is chosen: choose one in a plot, a card or the table; its points turn red.'; return; }
    const pose = this.moment === 'after' ? scan.afterPose : scan.beforePose;
    const bold = (text) => make('b', {}, text);
    this.readout.replaceChildren('Scan ', bold(`${this.chosen}: ${scan.name}`), ', ', bold(scan.status),
      ': x ', bold(`${fixed(pose[0], 2)} m`), ', y ', bold(`${fixed(pose[1], 2)} m`), ', z ', bold(`${fixed(pose[2], 2)} m`),
      '; overlap ', bold(`${fixed(100 * scan.overlap, 0)} %`), ', residual ', bold(`${digits(scan.rms_mm)} mm`), ' of ',
      bold(fixed(scan.pairs, 0)), ' pairs; registered in ', bold(`${digits(scan.time_s)} s`), '.');
  }

  // ---- Plots, scans and loops.

  showPlots() {
    const column = (of) => Float32Array.from(this.scans, of);
    const axis = new SharedAxis(column((_, i) => i), 'scan');
    const marks = [...this.scans.keys()].filter((number) => number > 0 && !this.scans[number].matched);
    const matched = (of) => column((scan) => (scan.matched ? of(scan) : NaN));
    const plots = [
      { title: 'Overlap', unit: '%', meaning: 'Share of a scan that the scans before it have seen, too. Red ticks: scans that could not be registered.',
        series: [{ values: matched((scan) => 100 * scan.overlap), color: 'series' }], marks },
      { title: 'Contradiction', unit: '%', meaning: 'Share of the overlap in which one scan sees free space where the other has a surface.',
        series: [{ values: matched((scan) => 100 * scan.contradiction), color: 'series' }], marks },
      { title: 'Residual', unit: 'mm', meaning: 'Root mean square distance of paired points when the scan was registered.',
        series: [{ values: matched((scan) => scan.rms_mm), color: 'series' }], marks },
      { title: 'Correction', unit: 'm', meaning: 'Distance between where odometry has the scan and where it is in the end.',
        series: [{ values: column(({ beforePose: b, afterPose: a }) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])), color: 'series' }] },
      { title: 'Time per scan', unit: 's', meaning: 'Wall time of the registration, without reading, on a machine that may have had other work.',
        series: [{ values: column((scan) => scan.time_s), color: 'series-2' }] },
    ].map((options) => new Plot(axis, options));
    section('plots', 'Plots', 'All plots share one axis, the number of the scan: drag to move along it, click one and use the wheel, or + and −, '
      + 'to zoom; 0 or a double click shows all. Left and right arrows go from scan to scan.', ...plots.map((plot) => plot.element));
  }
  // Those that could not be registered first, then those that overlap least.
  showWorst() {
    const kMost = 8;
    const numbers = [...this.scans.keys()].slice(1).sort((a, b) =>
      this.scans[a].matched - this.scans[b].matched || this.scans[a].overlap - this.scans[b].overlap).slice(0, kMost);
    if (numbers.length === 0) return;
    const cards = numbers.map((number) => {
      const scan = this.scans[number];
      const canvas = make('canvas', { 'aria-hidden': true });
      new Stage(canvas, (context, stage) => this.drawCard(context, stage, number));
      return make('button', { type: 'button', onclick: () => this.showScan(number) }, canvas, make('div', { class: 'text' },
        make('b', {}, `Scan ${number}`), ` ${scan.name}`, make('br'), make('span', { class: scan.matched ? '' : 'bad' }, scan.status),
        make('br'), `overlap ${fixed(100 * scan.overlap, 0)} %, residual ${digits(scan.rms_mm)} mm, contradiction ${fixed(100 * scan.contradiction, 1)} %`));
    });
    section('worst', 'Worst scans', 'Those that could not be registered, then those that overlap least with the scans before; from above, '
      + 'the scan in red, in the model as it is in the end. A click shows the scan in the large picture.', make('div', { class: 'cards' }, ...cards));
  }
  drawCard(context, stage, number) {
    const [low, high] = [this.bounds.low, this.bounds.high];
    const view = { right: [1, 0, 0], up: [0, 1, 0], center_m: [0, 1, 2].map((k) => (low[k] + high[k]) / 2),
      px_per_m: Math.min(stage.width / (high[0] - low[0] + 1), stage.height / (high[1] - low[1] + 1)) };
    this.picture.draw(context, stage, view, 'after', number);
  }
  showScan(number) {
    this.choose(number);
    document.getElementById('model').scrollIntoView();
    this.canvas.focus({ preventScroll: true });
  }
  showScans() {
    const number = (name, of, text) => ({ name, of, text, number: true });
    const columns = [
      number('Scan', ({ index }) => index, ({ index }) => String(index)),
      { name: 'Name', of: (scan) => scan.name, text: (scan) => scan.name },
      { name: 'Status', of: (scan) => scan.status, text: (scan) => scan.status, style: (scan) => (scan.matched || scan.index === 0 ? 'yes' : 'no') },
      number('Points', (scan) => scan.points, (scan) => fixed(scan.points, 0)),
      number('Overlap (%)', (scan) => scan.overlap, (scan) => fixed(100 * scan.overlap, 0)),
      number('Contradiction (%)', (scan) => scan.contradiction, (scan) => fixed(100 * scan.contradiction, 1)),
      number('Residual (mm)', (scan) => scan.rms_mm, (scan) => digits(scan.rms_mm)),
      { name: 'Loops closed to', of: (scan) => scan.loops_to.length, text: (scan) => scan.loops_to.join(', ') },
      number('Time (s)', (scan) => scan.time_s, (scan) => digits(scan.time_s)),
    ];
    section('scans', 'Scans and loops', 'All scans, in their order; a loop is closed to a scan of an earlier part of the model. The first scan defines the frame of the map.',
      sortedTable('All scans', columns, this.scans.map((scan, index) => ({ ...scan, index })), ({ index }) => this.showScan(index)));
  }
}

function showCloudReport() {
  const view = new CloudReport();
  view.showModel();
  view.showPlots();
  view.showWorst();
  view.showScans();
}
