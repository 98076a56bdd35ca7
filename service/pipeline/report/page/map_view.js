// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The report of a run in the plane: its map with what lies over it, plots, scans to look at, loops.

const kDeadReckoned = 3;  // Number of that status in the column `status`.

// Colour along the path, from its beginning to its end.
function pathColors(steps) {
  const stops = [0, 1, 2, 3].map((i) => theme.bytes(`path-${i}`));
  return Array.from({ length: steps }, (_, step) => {
    const at = step / Math.max(steps - 1, 1) * 3;
    const below = Math.min(Math.floor(at), 2);
    const mixed = stops[below].map((byte, k) => Math.round(byte + (at - below) * (stops[below + 1][k] - byte)));
    return `rgb(${mixed})`;
  });
}

// A picture of cells in the colours of the theme; it takes a moment to be decoded.
class GridPicture {
  constructor(grid, onReady) {
    Object.assign(this, grid, { canvas: null });
    const image = new Image();
    image.onload = () => { this.image = image; this.paint(); onReady(); };
    image.src = grid.picture;
    theme.listeners.push(() => { if (this.image) this.paint(); });
  }
  paint() {
    const { width, height } = this.image;
    this.canvas = make('canvas', { width, height });
    const context = this.canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(this.image, 0, 0);
    const pixels = context.getImageData(0, 0, width, height);
    const colors = ['unknown', 'free', 'wall'].map(theme.bytes);
    for (let i = 0; i < pixels.data.length; i += 4) {
      const color = colors[Math.min(Math.round(pixels.data[i] / 85), 2)];
      [pixels.data[i], pixels.data[i + 1], pixels.data[i + 2]] = color;
    }
    context.putImageData(pixels, 0, 0);
  }
  // @param view a PlaneView.
  draw(context, view) {
    if (!this.canvas) return;
    const size = this.cell_m * view.px_per_m;
    context.imageSmoothingEnabled = size < 1;
    context.drawImage(this.canvas, view.x(this.x_m), view.y(this.y_m + this.canvas.height * this.cell_m),
      this.canvas.width * size, this.canvas.height * size);
  }
}

function drawPolyline(context, xs, ys, view) {
  context.beginPath();
  for (let i = 0; i < xs.length; ++i) context.lineTo(view.x(xs[i]), view.y(ys[i]));
  context.stroke();
}

function drawRobot(context, [x, y, theta], size_px = 12) {
  context.save();
  context.translate(x, y);
  context.rotate(-theta);
  context.beginPath();
  for (const [ahead, left] of [[1.1, 0], [-0.7, 0.75], [-0.3, 0], [-0.7, -0.75]]) context.lineTo(ahead * size_px, -left * size_px);
  context.closePath();
  context.fillStyle = theme.color('robot');
  context.fill();
  context.lineWidth = 1.3;
  context.strokeStyle = '#4a3800';
  context.stroke();
  context.restore();
}

function drawPoints(context, points, [x_m, y_m, theta_rad], view, size_px) {
  const [cos, sin] = [Math.cos(theta_rad), Math.sin(theta_rad)];
  context.fillStyle = theme.color('scan');
  for (let i = 0; i + 1 < points.length; i += 2) {
    const x = view.x(x_m + cos * points[i] - sin * points[i + 1]);
    const y = view.y(y_m + sin * points[i] + cos * points[i + 1]);
    context.fillRect(x - size_px / 2, y - size_px / 2, size_px, size_px);
  }
}

class MapReport {
  constructor() {
    const columns = Object.entries(report.scans.columns).map(([name, text]) => [name, floats(text)]);
    this.scans = Object.fromEntries(columns);
    this.count = this.scans.time_s.length;
    this.hasBefore = Boolean(this.scans.answered_x_m);
    this.odometry = { x: floats(report.odometry.x_m), y: floats(report.odometry.y_m) };
    this.truth = { x: floats(report.truth.x_m), y: floats(report.truth.y_m) };
    this.loops = report.loops || [];
    this.doubtful = report.doubtful.map((scan) => ({ ...scan, points: floats(scan.points_m) }));
    this.deadReckoned = [...this.scans.status.keys()].filter((row) => this.scans.status[row] === kDeadReckoned);
    this.axis = new SharedAxis(this.scans.time_s, 'time since the first scan (s)');
    this.moment = 'after';
    this.shown = { path: true, other: false, odometry: false, truth: true, loops: true, refused: true, ellipses: false };
    this.chosenScan = null;
    this.chosenLoop = null;
  }

  // ---- Numbers of a row.

  pose(row, moment = this.moment) {
    const { x_m, y_m, theta_rad, answered_x_m, answered_y_m, answered_theta_rad } = this.scans;
    return moment === 'before' && this.hasBefore
      ? [answered_x_m[row], answered_y_m[row], answered_theta_rad[row]] : [x_m[row], y_m[row], theta_rad[row]];
  }
  // The longer half axis of the 95 % ellipse.
  radius_m(row) {
    const { axis_ax_m: ax, axis_ay_m: ay, axis_bx_m: bx, axis_by_m: by } = this.scans;
    return Math.max(Math.hypot(ax[row], ay[row]), Math.hypot(bx[row], by[row]));
  }
  column(of) { return Float32Array.from({ length: this.count }, (_, row) => of(row)); }

  // ---- The map.

  bounds() {
    const low = [Infinity, Infinity];
    const high = [-Infinity, -Infinity];
    const include = (x, y) => {
      [low[0], low[1], high[0], high[1]] = [Math.min(low[0], x), Math.min(low[1], y), Math.max(high[0], x), Math.max(high[1], y)];
    };
    for (let row = 0; row < this.count; ++row) include(this.scans.x_m[row], this.scans.y_m[row]);
    if (this.after && this.after.canvas) {
      const { x_m, y_m, cell_m, canvas } = this.after;
      include(x_m, y_m);
      include(x_m + canvas.width * cell_m, y_m + canvas.height * cell_m);
    }
    return Number.isFinite(low[0]) ? { low, high } : { low: [-1, -1], high: [1, 1] };
  }
  showMap() {
    this.canvas = make('canvas', { class: 'big', role: 'img', 'aria-describedby': 'map-keys',
      'aria-label': 'Map of the run with the path; arrow keys move it, plus and minus zoom, 0 shows all' });
    this.stage = new Stage(this.canvas, (context) => this.drawMap(context));
    this.view = new PlaneView(this.stage, this.bounds());
    const ready = () => { this.view.bounds = this.bounds(); this.stage.changed(); this.drawCards(); };
    this.after = report.map ? new GridPicture(report.map, ready) : null;
    this.before = report.before ? new GridPicture(report.before, ready) : null;
    this.view.click = (x, y) => this.select(this.view.toMap(x, y));
    this.view.hover = (x, y) => this.tell(this.view.toMap(x, y));
    attachPanZoom(this.canvas, this.view);
    this.readout = make('p', { class: 'readout', 'aria-live': 'polite' });
    this.moments = this.hasBefore ? choice('Moment', [['after', 'Corrected'], ['before', 'As answered']], 'after',
      (moment) => { this.moment = moment; this.stage.changed(); this.tell(); }) : null;
    selection.listeners.push(() => { this.stage.changed(); this.tell(); });
    theme.listeners.push(() => this.drawCards());
    section('map', 'Map', 'The occupancy map, with what is ticked drawn over it. Click near the path to '
      + 'see that moment in all plots. ' + (this.hasBefore ? '“As answered” is what the robot was told while it '
      + 'drove, “corrected” what is known once loops were closed; the view stays, so that one sees what moved.' : ''),
    make('div', { class: 'bar' }, this.moments, ...this.layers()),
    make('div', { class: 'stage' }, this.canvas, zoomButtons(this.canvas, this.view)), this.readout,
    make('p', { class: 'lead', id: 'map-keys' }, 'Drag to move; click the map, then zoom with the wheel, or pinch; '
      + 'keys: arrows, +, −, 0.'));
    this.tell();
  }
  layers() {
    const add = (name, text, color, there, area) => (there ? layer(text, `var(--${color})`, this.shown[name], (on) => {
      this.shown[name] = on;
      this.stage.changed();
    }, area) : null);
    const accepted = this.loops.filter((loop) => loop.accepted).length;
    const line = make('span', { class: 'layer' });
    line.append(make('input', { type: 'checkbox', checked: true, onchange: (event) => {
      this.shown.path = event.target.checked;
      this.stage.changed();
    }, 'aria-label': 'path' }), make('span', { class: 'swatch', style: 'width:3.5rem;background:linear-gradient(90deg,'
      + 'var(--path-0),var(--path-1),var(--path-2),var(--path-3))' }), `path, 0:00 to ${clock(this.scans.time_s[this.count - 1])}`);
    const cells = ['wall', 'free', 'unknown'].map((state) => make('span', { class: 'layer' },
      make('span', { class: 'swatch area', style: `background:var(--${state});border:1px solid var(--line)` }), state));
    return [...cells, line, add('other', 'path of the other moment', 'answered', this.hasBefore),
      add('odometry', 'odometry alone', 'odometry', this.odometry.x.length > 0),
      add('truth', 'truth', 'truth', this.truth.x.length > 0),
      add('ellipses', '95 % ellipses, true size', 'ellipse', this.count > 0, true),
      add('loops', `loops (${fixed(accepted, 0)})`, 'loop', accepted > 0),
      add('refused', `loops not believed (${fixed(this.loops.length - accepted, 0)})`, 'refused', this.loops.length > accepted),
      this.deadReckoned.length ? make('span', { class: 'layer' }, make('span', { class: 'swatch area',
        style: 'background:var(--refused);border-radius:50%' }), `dead-reckoned (${fixed(this.deadReckoned.length, 0)})`) : null];
  }
  drawMap(context) {
    const { view, stage, shown } = this;
    if (view.fitted) view.fit();
    context.fillStyle = theme.color('unknown');
    context.fillRect(0, 0, stage.width, stage.height);
    const grid = this.moment === 'before' && this.before ? this.before : this.after;
    if (grid) grid.draw(context, view);
    context.lineJoin = context.lineCap = 'round';
    if (shown.odometry) this.stroke(context, this.odometry.x, this.odometry.y, 'odometry', 1.4, [6, 4]);
    if (shown.truth) this.stroke(context, this.truth.x, this.truth.y, 'truth', 4);
    if (shown.loops || shown.refused) this.drawLoops(context);
    if (shown.ellipses) this.drawEllipses(context);
    if (shown.other && this.hasBefore) this.drawOtherPath(context);
    if (shown.path) this.drawPath(context);
    this.drawChosen(context);
    drawScale(context, stage, view.px_per_m);
  }
  stroke(context, xs, ys, color, width, dash = []) {
    context.strokeStyle = theme.color(color);
    context.lineWidth = width;
    context.setLineDash(dash);
    drawPolyline(context, xs, ys, this.view);
    context.setLineDash([]);
  }
  drawOtherPath(context) {
    const other = this.moment === 'after' ? 'before' : 'after';
    this.stroke(context, this.column((row) => this.pose(row, other)[0]), this.column((row) => this.pose(row, other)[1]),
      'answered', 1.4, [2, 3]);
  }
  drawPath(context) {
    const colors = pathColors(64);
    context.lineWidth = 2.6;
    for (let step = 0; step < colors.length; ++step) {
      const first = Math.floor(step * this.count / colors.length);
      const end = Math.min(Math.floor((step + 1) * this.count / colors.length) + 1, this.count);
      context.strokeStyle = colors[step];
      context.beginPath();
      for (let row = first; row < end; ++row) {
        const [x_m, y_m] = this.pose(row);
        context.lineTo(this.view.x(x_m), this.view.y(y_m));
      }
      context.stroke();
    }
    context.fillStyle = theme.color('refused');
    for (const row of this.deadReckoned) {
      const [x_m, y_m] = this.pose(row);
      context.beginPath();
      context.arc(this.view.x(x_m), this.view.y(y_m), 3.2, 0, 2 * Math.PI);
      context.fill();
    }
    if (this.count > 0) {
      const [x_m, y_m, theta] = this.pose(0);
      drawRobot(context, [this.view.x(x_m), this.view.y(y_m), theta]);
    }
  }
  // From where the place was first seen to where it was seen again, by the poses that are shown.
  lineOf(loop) {
    if (this.moment === 'after') return loop.line_m;
    return [loop.from_s, loop.to_s].flatMap((time_s) => this.pose(this.axis.nearest(time_s)).slice(0, 2));
  }
  drawLoops(context) {
    for (const accepted of [true, false]) {
      if (!(accepted ? this.shown.loops : this.shown.refused)) continue;
      context.strokeStyle = theme.color(accepted ? 'loop' : 'refused');
      context.lineWidth = accepted ? 1 : 1.5;
      context.globalAlpha = accepted ? 0.35 : 0.9;
      context.beginPath();
      for (const line of this.loops.filter((loop) => loop.accepted === accepted).map((loop) => this.lineOf(loop))) {
        context.moveTo(this.view.x(line[0]), this.view.y(line[1]));
        context.lineTo(this.view.x(line[2]), this.view.y(line[3]));
      }
      context.stroke();
    }
    context.globalAlpha = 1;
  }
  // As many as can be told apart.
  drawEllipses(context) {
    let last = null;
    for (let row = 0; row < this.count; ++row) {
      const [x, y] = [this.view.x(this.pose(row)[0]), this.view.y(this.pose(row)[1])];
      if (last && Math.hypot(x - last[0], y - last[1]) < 45) continue;
      last = [x, y];
      this.drawEllipse(context, row, x, y);
    }
  }
  drawEllipse(context, row, x, y) {
    const { axis_ax_m: ax, axis_ay_m: ay, axis_bx_m: bx, axis_by_m: by } = this.scans;
    const scale = this.view.px_per_m;
    context.beginPath();
    for (let k = 0; k <= 40; ++k) {
      const [cos, sin] = [Math.cos(k * Math.PI / 20), Math.sin(k * Math.PI / 20)];
      context.lineTo(x + scale * (cos * ax[row] + sin * bx[row]), y - scale * (cos * ay[row] + sin * by[row]));
    }
    context.strokeStyle = context.fillStyle = theme.color('ellipse');
    context.lineWidth = 1.2;
    context.stroke();
    context.globalAlpha = 0.15;
    context.fill();
    context.globalAlpha = 1;
  }
  drawChosen(context) {
    if (this.chosenLoop) {
      const [x0, y0, x1, y1] = this.lineOf(this.chosenLoop);
      context.strokeStyle = theme.color(this.chosenLoop.accepted ? 'loop' : 'refused');
      context.lineWidth = 4;
      drawPolyline(context, [x0, x1], [y0, y1], this.view);
    }
    if (this.chosenScan) {
      drawPoints(context, this.chosenScan.points, this.poseOf(this.chosenScan), this.view, Math.max(4, 0.03 * this.view.px_per_m));
    }
    const row = selection.row;
    if (row < 0) return;
    const [x_m, y_m, theta] = this.pose(row);
    const [x, y] = [this.view.x(x_m), this.view.y(y_m)];
    this.drawEllipse(context, row, x, y);
    drawRobot(context, [x, y, theta], 15);
  }
  // The row nearest to a point of the map, by the pose that is shown.
  select([x_m, y_m]) {
    let [nearest, best] = [-1, Infinity];
    for (let row = 0; row < this.count; ++row) {
      const pose = this.pose(row);
      const distance = Math.hypot(pose[0] - x_m, pose[1] - y_m);
      if (distance < best) [nearest, best] = [row, distance];
    }
    if (best * this.view.px_per_m < 40) selection.set(nearest);
  }
  tell(pointer) {
    const row = selection.row;
    const bold = (text) => make('b', {}, text);
    const parts = [];
    if (row >= 0) {
      const [x, y, theta] = this.pose(row);
      const { number, time_s, status, residual_mm, ms, sigma_deg } = this.scans;
      parts.push('Scan ', bold(fixed(number[row], 0)), ' at ', bold(clock(time_s[row])), ', ',
        bold(report.scans.statuses[status[row]]), ': x ', bold(`${fixed(x, 2)} m`), ', y ', bold(`${fixed(y, 2)} m`),
        ', heading ', bold(`${degrees(theta)}°`), '; 95 % within ', bold(`${digits(this.radius_m(row))} m`), ', heading ± ',
        bold(`${digits(sigma_deg[row])}°`), ' (1 σ); residual ', bold(`${digits(residual_mm[row])} mm`), '; answered in ',
        bold(`${digits(ms[row])} ms`), '. ');
    } else {
      parts.push('No scan is chosen: click near the path, or move over a plot. ');
    }
    if (pointer) parts.push(`Pointer at x ${fixed(pointer[0], 2)} m, y ${fixed(pointer[1], 2)} m.`);
    this.readout.replaceChildren(...parts);
  }

  // ---- Plots.

  showPlots() {
    const answered = [...Array(this.hasBefore ? this.count : 0).keys()];
    const shift = (row) => Math.hypot(this.pose(row, 'after')[0] - this.pose(row, 'before')[0],
      this.pose(row, 'after')[1] - this.pose(row, 'before')[1]);
    const plots = [
      { title: 'Residual', unit: 'mm', meaning: 'Mean distance of a scan’s points to the nearest points of the map. '
        + 'It stays near the laser’s noise where all is well. Red ticks: dead-reckoned scans.',
      series: [{ values: this.scans.residual_mm, color: 'series' }], marks: this.deadReckoned },
      { title: 'Uncertainty of the position', unit: 'm', meaning: 'Longer half axis of the ellipse in which the position '
        + `lies with 95 % probability, drift since the start included${this.hasBefore ? ', after correction' : ''}.`,
      series: [{ values: this.column((row) => this.radius_m(row)), color: 'series' }], marks: this.deadReckoned },
      { title: 'Uncertainty of the heading', unit: '°', meaning: 'Standard deviation, drift since the start included.',
        series: [{ values: this.scans.sigma_deg, color: 'series' }], marks: this.deadReckoned },
      answered.length ? { title: 'Correction', unit: 'm', meaning: 'How far closing the loops has moved the pose from where it '
        + 'was answered.', series: [{ values: Float32Array.from(answered, shift), color: 'series' }] } : null,
      { title: 'Time per scan', unit: 'ms', meaning: 'Processor time of the answer: what it takes where nothing else runs.',
        series: [{ values: this.scans.ms, color: 'series-2' }] },
    ].filter((plot) => plot).map((options) => new Plot(this.axis, options));
    const stride = report.scans.stride;
    section('plots', 'Plots', 'All plots share one time axis: drag to move along it, click one and use the wheel, '
      + 'or + and −, to zoom; 0 or a double click shows all. Left and right arrows go from scan to scan (with Shift by 20), '
      + 'and the map follows.' + (stride > 1 ? ` Of every ${stride} scans the one with the largest residual is shown.` : ''),
    ...plots.map((plot) => plot.element));
  }

  // ---- Scans to look at.

  // Corrected or as answered, as the map is.
  poseOf(scan) {
    if (this.moment === 'after') return scan.pose;
    return this.pose(this.rowOf(scan.number));
  }
  rowOf(number) {
    const { number: numbers } = this.scans;
    let row = Math.min(Math.floor(number / report.scans.stride), this.count - 1);
    while (row > 0 && numbers[row] > number) --row;
    return row;
  }
  showDoubtful() {
    if (this.doubtful.length === 0) return;
    this.cards = this.doubtful.map((scan) => {
      const canvas = make('canvas', { 'aria-hidden': true });
      const bad = scan.status === report.scans.statuses[kDeadReckoned];
      const button = make('button', { type: 'button', onclick: () => this.showScan(scan) }, canvas,
        make('div', { class: 'text' }, make('b', {}, `Scan ${fixed(scan.number, 0)}`), ` at ${clock(scan.time_s)}`,
          make('br'), make('span', { class: bad ? 'bad' : '' }, scan.status),
          scan.reason ? `: ${scan.reason}` : '', make('br'),
          `residual ${digits(scan.residual_mm)} mm, ${fixed(100 * scan.overlap, 0)} % agree with the map, ${fixed(scan.pairs, 0)} pairs`));
      return { scan, button, stage: new Stage(canvas, (context, stage) => this.drawCard(context, stage, scan)) };
    });
    section('worst', 'Worst scans', 'Those that could not be matched, then those whose points stay farthest from the '
      + 'map; of scans close after each other only the worst. Red: the points as measured, at the pose that was found, over '
      + 'the map in the end. A click shows the scan in the large map.',
    make('div', { class: 'cards' }, ...this.cards.map((card) => card.button)));
  }
  drawCards() { for (const { stage } of this.cards || []) stage.changed(); }
  reach_m(scan) {
    const ranges = Array.from({ length: scan.points.length / 2 }, (_, i) => Math.hypot(scan.points[2 * i], scan.points[2 * i + 1]));
    ranges.sort((a, b) => a - b);
    return Math.max(ranges[Math.floor(0.9 * ranges.length)] || 2, 1.5);
  }
  drawCard(context, stage, scan) {
    const reach_m = this.reach_m(scan);
    const view = new PlaneView(stage, {});
    [view.x_m, view.y_m, view.px_per_m] = [scan.pose[0], scan.pose[1], Math.min(stage.width, stage.height) / 2 / reach_m];
    context.fillStyle = theme.color('unknown');
    context.fillRect(0, 0, stage.width, stage.height);
    if (this.after) this.after.draw(context, view);
    drawPoints(context, scan.points, scan.pose, view, 2);
    drawRobot(context, [view.x(scan.pose[0]), view.y(scan.pose[1]), scan.pose[2]], 8);
  }
  showScan(scan) {
    [this.chosenScan, this.chosenLoop] = [scan, null];
    const [x_m, y_m] = this.poseOf(scan);
    const reach_m = this.reach_m(scan);
    this.view.show([x_m - reach_m, y_m - reach_m], [x_m + reach_m, y_m + reach_m]);
    selection.set(this.rowOf(scan.number));
    document.getElementById('map').scrollIntoView();
    this.canvas.focus({ preventScroll: true });
  }

  // ---- Loops.

  showLoops() {
    if (!report.loops) return;
    const show = (loop) => {
      [this.chosenLoop, this.chosenScan, this.moment] = [loop, null, 'after'];
      if (this.moments) this.moments.show('after');
      const [x0, y0, x1, y1] = loop.line_m;
      this.view.show([Math.min(x0, x1) - 4, Math.min(y0, y1) - 4], [Math.max(x0, x1) + 4, Math.max(y0, y1) + 4]);
      document.getElementById('map').scrollIntoView();
    };
    const columns = [
      { name: 'Seen first at', of: (loop) => loop.from_s, text: (loop) => clock(loop.from_s), number: true },
      { name: 'Seen again at', of: (loop) => loop.to_s, text: (loop) => clock(loop.to_s), number: true },
      { name: 'Points that agree (%)', of: (loop) => loop.overlap, text: (loop) => fixed(100 * loop.overlap, 0), number: true },
      { name: 'Reduced χ²', of: (loop) => loop.reduced_chi2, text: (loop) => digits(loop.reduced_chi2), number: true },
      { name: 'Verdict', of: (loop) => loop.verdict, text: (loop) => loop.verdict, style: (loop) => (loop.accepted ? 'yes' : 'no') },
    ];
    const accepted = this.loops.filter((loop) => loop.accepted).length;
    section('loops', 'Loops', `Places that were recognised in a later pass: ${fixed(accepted, 0)} of ${fixed(this.loops.length, 0)} `
      + 'are believed, and path and map are corrected by them. A reduced χ² near 1 says that the points fit as well as their '
      + 'noise allows. Unconfirmed: too few loops near by agree. Contradicted: the rest of the graph disagrees. Refused: the '
      + 'map would contradict the scans more than without.',
    this.loops.length ? sortedTable('All loops', columns, this.loops, show) : null);
  }
}

function showMapReport() {
  const view = new MapReport();
  view.showMap();
  view.showPlots();
  view.showDoubtful();
  view.showLoops();
}
