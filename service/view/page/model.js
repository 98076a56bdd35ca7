// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What is known of the team: robots, the map's tiles, relevant scans, marks, events.

const kMostHistory = 20000;  // Reports of a robot: half an hour at 10 Hz.
const kMostTrail = 4000;
const kTrailStep_m = 0.05;
const kRecentScans = 4;
export const kSilent_s = 3;  // A robot that stands is reported every 1.5 s.
const kLateAnswer_ms = 300;
const kChunkTiles = 8;  // Tiles of a chunk, along each side: few pictures, each redrawn rarely.

// What a match report says; and of a simulated robot that nobody answers, that it is where it is.
export const Status = {first: 0, matched: 1, extended: 2, deadReckoned: 3, lost: 4, simulated: 255};

// Okabe and Ito's colours, which the colour-blind tell apart; robots are numbered all the same.
const kColors = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442', '#8c8c8c'];

export function compose(a, b) {
  const c = Math.cos(a.theta), s = Math.sin(a.theta);
  return {x: a.x + c * b.x - s * b.y, y: a.y + s * b.x + c * b.y, theta: a.theta + b.theta};
}

export function inverse(a) {
  const c = Math.cos(a.theta), s = Math.sin(a.theta);
  return {x: -c * a.x - s * a.y, y: s * a.x - c * a.y, theta: -a.theta};
}

// A point, or a pose, where a motion takes it.
function move(motion, thing) {
  const {x, y, theta} = compose(motion, {x: thing.x, y: thing.y, theta: thing.theta ?? 0});
  return thing.theta === undefined ? {...thing, x, y} : {...thing, x, y, theta};
}

function movePoints(motion, points) {
  const c = Math.cos(motion.theta), s = Math.sin(motion.theta);
  return points.map((_, i) => i % 2 === 0 ? motion.x + c * points[i] - s * points[i + 1] : motion.y + s * points[i - 1] + c * points[i]);
}

const scanKey = ({origin, robot, number}) => `${origin}/${robot}/${number}`;

// End points of a scan's beams, in the frame of the pose's parent, as x, y, x, y...
export function scanPoints(scan, sensor) {
  const points = [];
  for (let i = 0; i < scan.ranges.length; ++i) {
    const range = scan.ranges[i];
    if (!(range >= scan.rangeMin && range < scan.rangeMax)) continue;
    const bearing = sensor.theta + scan.angleMin + i * scan.angleIncrement;
    points.push(sensor.x + range * Math.cos(bearing), sensor.y + range * Math.sin(bearing));
  }
  return Float32Array.from(points);
}

// Index of the last of some things, in the order of their stamps, at or before a stamp; -1 for none.
function indexAt(things, stamp) {
  let low = 0, high = things.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (things[middle].stamp <= stamp) low = middle + 1; else high = middle;
  }
  return low - 1;
}

class Robot {
  constructor(name, index) {
    this.name = name;
    this.index = index;
    this.label = /(\d+)$/.exec(name)?.[1] ?? String(index + 1);
    // The number tells the colour, so that each robot has the same on every page.
    const place = /^\d+$/.test(this.label) ? Number(this.label) - 1 : index;
    this.color = kColors[(place + kColors.length) % kColors.length];
    this.isSecond = Math.floor(place / kColors.length) % 2 === 1;
    this.history = [];
    this.trail = [];
    this.loops = [];  // Pairs of entries of the history that were recognised as near each other.
    this.relevant = [];  // Its relevant scans, by their stamps.
    this.scans = [];  // Recent ones that wait for their pose.
    this.points = null;  // Of the scan of now, on the map.
    this.health = '';
    this.lastMatch = null;
    this.arrived_ms = 0;
    this.frame = '';  // Of the map that its poses are in.
    this.isApart = false;  // Whether that is another one than the team's.
  }
  get last() { return this.history.at(-1); }
  get sigma_m() { return this.last ? Math.sqrt(Math.max(0, this.last.cov[0] + this.last.cov[4])) : 0; }

  // `told_ms`: when that was published, on this computer's clock; `published_ms`: on the service's.
  takeReport(report, {told_ms, published_ms}) {
    const {stamp, pose, covariance, status, reason, meanResidual, overlap, scans, dropped, latency} = report;
    if (this.last && (stamp < this.last.stamp - 1 || report.frame !== this.frame)) this.beginAnew();
    this.frame = report.frame;
    this.history.push({stamp, published_ms, ...pose, cov: covariance, status, reason, residual_m: meanResidual, overlap, scans, dropped, latency});
    if (this.history.length > kMostHistory) this.history.splice(0, kMostHistory / 10);
    if (status !== Status.deadReckoned) this.lastMatch = stamp;
    this.arrived_ms = told_ms;
    this.published_ms = published_ms;
    this.isFresh = true;
    const end = this.trail.at(-1);
    if (!end || Math.hypot(pose.x - end.x, pose.y - end.y) > kTrailStep_m) this.trail.push({x: pose.x, y: pose.y, z: pose.z, stamp, published_ms});
    if (this.trail.length > kMostTrail) this.trail = this.trail.filter((_, i) => i % 2 === 0 || i > kMostTrail / 2);
  }
  // Where it was told to be before the map was corrected goes with the scan that was taken next to it.
  follow(scans, published_ms) {
    const motions = scans.map(({before, pose}) => ({x: before.x, y: before.y, motion: compose(pose, inverse(before))}));
    const moved = (thing) => {
      if (thing.published_ms >= published_ms) return thing;
      let nearest = null, least = Infinity;
      for (const motion of motions) {
        const distance = (motion.x - thing.x) ** 2 + (motion.y - thing.y) ** 2;
        if (distance < least) { least = distance; nearest = motion; }
      }
      return move(nearest.motion, thing);
    };
    this.trail = this.trail.map(moved);
    this.history = this.history.map(moved);
    this.frame = scans.at(-1).frame ?? this.frame;
  }
  beginAnew() { this.history = []; this.trail = []; this.loops = []; this.lastMatch = null; }

  // What is known of it until a stamp, from its relevant scans of before this page was opened on.
  pathUntil(stamp) {
    const begin = this.history[0]?.stamp ?? Infinity;
    const before = this.relevant.slice(0, indexAt(this.relevant, Math.min(stamp, begin)) + 1).filter(({frame}) => frame === this.frame);
    return [...before, ...this.history.slice(0, indexAt(this.history, stamp) + 1)];
  }
  poseAt(stamp) {
    return this.history[indexAt(this.history, stamp)] ?? this.relevant[indexAt(this.relevant, stamp)] ?? null;
  }
  takeRelevant(scan) {
    this.relevant.splice(indexAt(this.relevant, scan.stamp) + 1, 0, scan);
  }
}

// Cells of some tiles as one picture.
class Chunk {
  constructor(cells) {
    this.side = cells;
    this.states = new Uint8Array(cells * cells);
    this.canvas = null;
    this.known = null;  // Cells between which something is known: left, bottom, right, top.
  }
  put(tile, firstX, firstY) {
    let at = 0;
    for (const run of tile.runs) {
      const state = run >> 6;
      for (let left = (run & 63) + 1; left > 0; --left, ++at) {
        const x = firstX + at % tile.width;
        const y = firstY + Math.floor(at / tile.width);
        // A picture's first row is the highest.
        this.states[(this.side - 1 - y) * this.side + x] = state;
        if (state > 0) this.#extend(x, y);
      }
    }
    this.canvas = null;
  }
  #extend(x, y) {
    this.known ??= {left: x, bottom: y, right: x + 1, top: y + 1};
    const {left, bottom, right, top} = this.known;
    if (x < left) this.known.left = x; else if (x >= right) this.known.right = x + 1;
    if (y < bottom) this.known.bottom = y; else if (y >= top) this.known.top = y + 1;
  }
  // `palette`: for unknown, free, occupied, each [r, g, b, a].
  picture(palette) {
    if (this.canvas && this.palette === palette) return this.canvas;
    this.palette = palette;
    this.canvas = document.createElement('canvas');
    this.canvas.width = this.canvas.height = this.side;
    const context = this.canvas.getContext('2d');
    const image = context.createImageData(this.side, this.side);
    const colors = new Uint32Array(image.data.buffer);
    const packed = palette.map(([r, g, b, a]) => ((a << 24) | (b << 16) | (g << 8) | r) >>> 0);
    for (let i = 0; i < this.states.length; ++i) colors[i] = packed[this.states[i]];
    context.putImageData(image, 0, 0);
    return this.canvas;
  }
}

class GridMap {
  constructor() { this.clear(); }
  clear() { this.chunks = new Map(); this.tiles = new Set(); this.generation = null; }
  take(tile) {
    if (this.generation !== null && tile.generation < this.generation) return;
    if (tile.generation !== this.generation) this.clear();
    this.generation = tile.generation;
    this.frame = tile.frame;
    const side_m = tile.resolution * tile.width;
    const column = Math.round(tile.x / side_m), row = Math.round(tile.y / side_m);
    const chunkColumn = Math.floor(column / kChunkTiles), chunkRow = Math.floor(row / kChunkTiles);
    const key = `${chunkColumn},${chunkRow}`;
    this.tiles.add(`${column},${row}`);
    let chunk = this.chunks.get(key);
    if (!chunk) {
      chunk = new Chunk(kChunkTiles * tile.width);
      chunk.size_m = kChunkTiles * side_m;
      chunk.x = tile.x - (column - chunkColumn * kChunkTiles) * side_m;
      chunk.y = tile.y - (row - chunkRow * kChunkTiles) * side_m;
      this.chunks.set(key, chunk);
    }
    chunk.put(tile, (column - chunkColumn * kChunkTiles) * tile.width, (row - chunkRow * kChunkTiles) * tile.width);
  }
  // Of what is known, in metres; null where nothing is.
  get bounds() {
    let bounds = null;
    for (const {known, x, y, size_m, side} of this.chunks.values()) {
      if (!known) continue;
      const cell_m = size_m / side;
      const box = {left: x + known.left * cell_m, bottom: y + known.bottom * cell_m, right: x + known.right * cell_m, top: y + known.top * cell_m};
      bounds = bounds ? {left: Math.min(bounds.left, box.left), bottom: Math.min(bounds.bottom, box.bottom), right: Math.max(bounds.right, box.right), top: Math.max(bounds.top, box.top)} : box;
    }
    return bounds;
  }
}

export class Model {
  constructor() {
    this.robots = new Map();
    this.maps = new Map();  // By topic.
    this.clouds = new Map();  // Points of models in space, by topic.
    this.sensors = new Map();  // Poses on the robot, by frame.
    this.relevant = new Map();  // By origin, robot and number.
    this.marks = new Map();
    this.epoch = null;  // The last correction of the maps.
    this.events = [];
    this.service = {};
    this.mapVersion = 0;
    this.reported_ms = 0;
    this.now = null;  // Stamp of the newest report.
    this.latencies_ms = [];
  }

  // After the service has come back: its map begins anew; what was seen of the robots stays.
  beginSession() {
    this.maps.clear();
    this.clouds.clear();
    this.sensors.clear();
    this.relevant.clear();
    this.epoch = null;
    for (const robot of this.robots.values()) robot.relevant = [];
    this.marks.clear();
    ++this.mapVersion;
  }

  robot(name) {
    if (!this.robots.has(name)) {
      this.robots.set(name, new Robot(name, this.robots.size));
      this.tell(`${name || 'robot'} is here`);
    }
    return this.robots.get(name);
  }

  // `more`: what can be shown of it.
  tell(text, stamp = this.now, more = {}) {
    this.events.unshift({text, stamp, at_ms: Date.now(), ...more});
    this.events.length = Math.min(this.events.length, 200);
  }

  take(channel, message, times) {
    const robotName = channel.topic.split('/').slice(1, -1).join('/');
    switch (channel.schemaName) {
      case 'qwsm_msgs/msg/RegistrationReport':
      case 'qwsm_msgs/msg/MatchReport': return this.#takeReport(message, times);
      case 'nav_msgs/msg/Odometry': return this.#takeTruth(this.robot(robotName), message, times);
      case 'sensor_msgs/msg/LaserScan': return this.#takeScan(this.robot(robotName), message);
      case 'sensor_msgs/msg/PointCloud2':
        this.clouds.set(channel.topic, message.points);
        ++this.mapVersion;
        return;
      case 'qwsm_msgs/msg/MapTile': return this.#takeTile(channel.topic, message);
      case 'qwsm_msgs/msg/RelevantScan': return this.#takeRelevant(message);
      case 'qwsm_msgs/msg/MapEpoch': return this.#takeEpoch(message, times);
      case 'qwsm_msgs/msg/Mark': return this.#takeMark(message);
      case 'tf2_msgs/msg/TFMessage': return message.forEach((t) => this.sensors.set(t.child, t));
      case 'diagnostic_msgs/msg/DiagnosticArray': return this.#takeHealth(message);
    }
  }

  #takeReport(report, times) {
    const robot = this.robot(report.robot);
    if (robot.last?.status === Status.simulated) robot.beginAnew();  // The simulator's frame is another one.
    const before = robot.last?.status;
    this.reported_ms = Date.now();
    robot.takeReport(report, times);
    if (this.now === null || report.stamp > this.now || report.stamp < this.now - 60) this.now = report.stamp;
    const isLost = report.status === Status.deadReckoned;
    if (before !== undefined && isLost !== (before === Status.deadReckoned)) {
      this.tell(`${report.robot || 'robot'} ${isLost ? `dead reckons: ${report.reason}` : 'is matched again'}`, report.stamp);
    }
    if (report.loops?.length > 0) this.tell(`${report.robot || 'robot'} closed a loop`, report.stamp);
    for (const scan of report.loops ?? []) {
      const other = robot.history.find(({scans}) => scans === scan + 1);
      if (other) robot.loops.push([other, robot.last]);
    }
    this.#placeScan(robot);
  }

  // Whether nothing but a simulator tells where a robot is.
  needsTruth(topic) {
    const last = this.robots.get(topic.split('/').slice(1, -1).join('/'))?.last;
    return !last || last.status === Status.simulated;
  }

  #takeTruth(robot, {stamp, pose}, times) {
    if (robot.last && robot.last.status !== Status.simulated) return;
    this.reported_ms = Date.now();
    if (this.now === null || stamp > this.now) this.now = stamp;
    robot.takeReport({stamp, pose, covariance: new Float64Array(9), status: Status.simulated, reason: 'as simulated', overlap: 1}, times);
    this.#placeScan(robot);
  }

  #takeScan(robot, scan) {
    robot.scans.push({...scan, arrived_ms: Date.now()});
    if (robot.scans.length > kRecentScans) robot.scans.shift();
    this.#placeScan(robot);
  }

  // A scan is drawn where its own answer says, not where the robot is when it arrives.
  #placeScan(robot) {
    const scan = robot.last && robot.scans.find(({stamp}) => Math.abs(stamp - robot.last.stamp) < 1e-6);
    if (scan) this.#putScan(robot, scan);
  }

  #putScan(robot, scan) {
    const sensor = this.sensors.get(scan.frame) ?? {x: 0, y: 0, theta: 0};
    robot.points = scanPoints(scan, compose(robot.poseAt(scan.stamp) ?? robot.last, sensor));
    robot.scans = robot.scans.filter(({stamp}) => stamp > scan.stamp);
  }

  // The answer of a robot that stands says nothing new, and does not come: the last one holds.
  placeLateScans() {
    for (const robot of this.robots.values()) {
      const scan = robot.scans.at(-1);
      if (robot.last && scan && Date.now() - scan.arrived_ms > kLateAnswer_ms) this.#putScan(robot, scan);
    }
  }

  #takeTile(topic, tile) {
    if (!this.maps.has(topic)) this.maps.set(topic, new GridMap());
    this.maps.get(topic).take(tile);
    ++this.mapVersion;
  }

  #takeRelevant(scan) {
    const key = scanKey(scan);
    if (this.relevant.has(key)) return;
    // What is told of it may be older than a correction.
    const {pose, frame} = this.epoch?.places.get(key) ?? scan;
    const points = scanPoints(scan, compose(pose, scan.laser));
    const kept = {stamp: scan.stamp, ...pose, frame, cov: scan.covariance, points};
    this.relevant.set(key, kept);
    this.robot(scan.robot).takeRelevant(kept);
    ++this.mapVersion;
  }

  // A correction of the map: what lies on it goes along.
  #takeEpoch(epoch, {published_ms, told_ms}) {
    const known = this.epoch;
    const isNews = !known || epoch.number > known.number || (epoch.number === known.number && epoch.origin > known.origin);
    if (!isNews) return;
    const places = new Map(epoch.scans.map((scan) => [scanKey(scan), scan]));
    this.epoch = {number: epoch.number, origin: epoch.origin, places};
    for (const [key, {pose, frame}] of places) {
      const kept = this.relevant.get(key);
      if (kept) Object.assign(kept, pose, {frame, points: movePoints(compose(pose, inverse(kept)), kept.points)});
    }
    for (const robot of this.robots.values()) {
      const scans = epoch.scans.filter((scan) => scan.robot === robot.name);
      if (scans.length > 0) robot.follow(scans, published_ms);
    }
    const joints = new Set(epoch.scans.filter((scan) => scan.frame !== scan.frameBefore).map((scan) => `${scan.frameBefore} was found in ${scan.frame}: they are one map now`));
    for (const joint of joints) this.tell(joint, epoch.stamp || this.now);
    const moved = epoch.scans.filter((scan) => scan.frame === scan.frameBefore);
    ++this.mapVersion;
    if (joints.size > 0 && moved.every(({before, pose}) => before.x === pose.x && before.y === pose.y)) return;
    const moves_m = moved.map(({before, pose}) => Math.hypot(pose.x - before.x, pose.y - before.y));
    const most_m = Math.max(0, ...moves_m);
    this.tell(`the map was corrected: ${moves_m.filter((m) => m > 0.01).length} of ${moves_m.length} scans moved, by ${most_m < 1 ? `${(100 * most_m).toFixed(0)} cm` : `${most_m.toFixed(1)} m`} at most`,
      epoch.stamp || this.now, {at_ms: told_ms, moves: moved.map(({before, pose}) => ({before, pose}))});
  }

  // Maps of robots of which nobody knows where they are say nothing of the team's, and are not drawn
  // in it. Where each robot has a map of its own, there is none that all share.
  isApart(frame) { return frame?.startsWith('map_') && this.hasTeamMap; }
  get hasTeamMap() {
    return [...this.robots.values()].some(({frame}) => frame === 'map') || [...this.relevant.values()].some(({frame}) => frame === 'map');
  }
  // Says of each robot whether it is in the team's map. @return those that are.
  robotsInMap() {
    for (const robot of this.robots.values()) robot.isApart = this.isApart(robot.frame);
    return [...this.robots.values()].filter(({isApart}) => !isApart);
  }

  #takeMark(mark) {
    const known = this.marks.get(mark.id);
    const isNews = !known || mark.stamp > known.stamp || (mark.stamp === known.stamp && mark.revision > known.revision);
    if (!isNews) return;
    this.marks.set(mark.id, mark);
    ++this.mapVersion;
  }

  #takeHealth({status}) {
    for (const {name, message, values} of status) {
      const what = name.replace(/^qwsm: /, '');
      if (what === 'service') this.service = {...this.service, name: message, ...values};
      else if (what === 'journal') this.service.journal = `${values.stored} stored, ${values.waiting} waiting${message.includes('/') || message.includes('.db') ? '' : ` (${message})`}`;
      else if (what === 'refused samples') this.#takeRefusals(values);
      else this.#takeRobotHealth(what, message, values);
    }
  }

  #takeRefusals(values) {
    const count = Object.values(values).reduce((sum, n) => sum + Number(n), 0);
    if (count > (this.service.refused ?? 0)) {
      for (const [why, n] of Object.entries(values)) {
        if (n !== this.refusals?.[why]) this.tell(`refused: ${why} (${n})`);
      }
    }
    this.refusals = values;
    this.service.refused = count;
  }

  #takeRobotHealth(shown, state, values) {
    // A robot without a namespace is shown as `robot`.
    const name = !this.robots.has(shown) && shown === 'robot' ? '' : shown;
    const robot = this.robot(name);
    if (robot.health && robot.health !== state) this.tell(`${shown}: ${state}`);
    robot.health = state;
    robot.counts = values;
  }

  // First and last stamp of what can be looked back at; null where there is nothing.
  get span() {
    let first = Infinity, last = -Infinity;
    for (const robot of this.robots.values()) {
      if (!robot.last) continue;
      first = Math.min(first, robot.history[0].stamp);
      last = Math.max(last, robot.last.stamp);
    }
    for (const {stamp} of this.relevant.values()) { first = Math.min(first, stamp); last = Math.max(last, stamp); }
    return first < last ? {first, last} : null;
  }
}

const ago = (s) => s < 90 ? `${Math.round(s)} s` : s < 5400 ? `${Math.round(s / 60)} min` : `${Math.round(s / 3600)} h`;

// How a robot is, in words, and how much it needs attention: 0 not, 3 most.
export function condition(robot, now_ms) {
  const age_s = robot.arrived_ms ? (now_ms - robot.arrived_ms) / 1000 : Infinity;
  if (robot.health === 'unplaced') return {level: 3, text: 'lost: searching for its place on the map', age_s};
  if (robot.health === 'lost') return {level: 2, text: age_s < Infinity ? `gone for ${ago(age_s)}; this is where it was last` : 'gone', age_s};
  if (!robot.last) return {level: robot.health === 'expected' ? 1 : 2, text: robot.health === 'expected' ? 'expected, not heard of yet' : 'no pose yet', age_s};
  if (robot.health?.includes('at its end')) return {level: 0, text: robot.health, age_s};
  if (age_s > kSilent_s) return {level: 2, text: `silent for ${ago(age_s)}`, age_s};
  if (robot.last.status === Status.deadReckoned) {
    const since_s = robot.lastMatch === null ? 0 : robot.last.stamp - robot.lastMatch;
    return {level: since_s > 3 ? 2 : 1, text: `dead reckoning for ${ago(since_s)}`, age_s};
  }
  if (robot.isApart || robot.last.status === Status.lost) return {level: 2, text: 'lost: in a map of its own, searching for its place', age_s};
  if (robot.last.status === Status.simulated) return {level: 0, text: 'simulated; no service answers it', age_s};
  if (robot.health === 'answered by another service') return {level: 0, text: 'matched, by another service', age_s};
  return {level: 0, text: robot.last.status === Status.extended ? 'matched, exploring' : 'matched', age_s};
}
