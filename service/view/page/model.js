// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What is known of the team: robots, the map's tiles, relevant scans, marks, events.
import {compose, inverse, movePoints, scanPoints} from './geometry.js';
import {GridMap} from './grid_map.js';
import {Robot, Status, tellApart} from './robot.js';

const kRecentScans = 4;
const kLateAnswer_ms = 300;
const kNoticeable_m = 0.01;  // Of a scan that is moved.

// Of one mark, what is newer; services decide alike.
function supersedes(mark, known) {
  for (const what of ['stamp', 'revision', 'number']) if (mark[what] !== known[what]) return mark[what] > known[what];
  return false;
}

const scanKey = ({origin, robot, number}) => `${origin}/${robot}/${number}`;

export class Model {
  constructor() {
    this.robots = new Map();
    this.sources = new Map();  // Channels of topics, by the topic.
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
    this.sources.clear();
    this.maps.clear();
    this.clouds.clear();
    this.sensors.clear();
    this.#forgetRelevant();
    this.epoch = null;
    this.marks.clear();
    ++this.mapVersion;
  }

  #forgetRelevant() {
    this.relevant.clear();
    for (const robot of this.robots.values()) robot.relevant = [];
  }

  // A topic that was gone and is there again, as of another service that was started anew, tells of another map: none of what
  // it said before lies on that. Until it is there again the last that was known is shown.
  #noteSource({id, topic, schemaName}) {
    const known = this.sources.get(topic);
    this.sources.set(topic, id);
    if (known === undefined || known === id) return;
    switch (schemaName) {
      case 'qwsm_msgs/msg/MapTile': this.maps.delete(topic); break;
      case 'qwsm_msgs/msg/RelevantScan': this.#forgetRelevant(); break;
      case 'qwsm_msgs/msg/MapEpoch': this.epoch = null; break;
    }
  }

  robot(name) {
    if (!this.robots.has(name)) {
      this.robots.set(name, new Robot(name, this.robots.size));
      tellApart([...this.robots.values()], this.robots.get(name).number);
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
    this.#noteSource(channel);
    const robotName = channel.topic.split('/').slice(1, -1).join('/');
    switch (channel.schemaName) {
      case 'qwsm_msgs/msg/RegistrationReport':
      case 'qwsm_msgs/msg/MatchReport': return this.#takeReport(message, times);
      case 'nav_msgs/msg/Odometry': return this.#takeTruth(this.robot(robotName), message, times);
      case 'nav_msgs/msg/Path':
        this.robot(robotName).takePath(message.poses);
        ++this.mapVersion;
        return;
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
    robot.points = scanPoints(scan, compose(robot.poseAt(scan.stamp) ?? robot.last, this.#placeOnRobot(scan.frame)));
    robot.scans = robot.scans.filter(({stamp}) => stamp > scan.stamp);
  }

  // Where a sensor sits, over any number of steps, as the service reckons: what stands still on a robot hangs on its base.
  #placeOnRobot(frame) {
    let place = {x: 0, y: 0, theta: 0};
    const passed = new Set();
    for (let link; !passed.has(frame) && (link = this.sensors.get(frame)); frame = link.frame) {
      passed.add(frame);
      place = compose(link, place);
    }
    return place;
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
    this.#tellEpoch(epoch, told_ms);
    ++this.mapVersion;
  }

  #tellEpoch(epoch, told_ms) {
    const joined = epoch.scans.filter((scan) => scan.frame !== scan.frameBefore);
    const joints = new Set(joined.map((scan) => `${scan.frameBefore} was found in ${scan.frame}: they are one map now`));
    for (const joint of joints) this.tell(joint, epoch.stamp || this.now);
    const moved = epoch.scans.filter((scan) => scan.frame === scan.frameBefore);
    if (joints.size > 0 && moved.every(({before, pose}) => before.x === pose.x && before.y === pose.y)) return;
    const moves_m = moved.map(({before, pose}) => Math.hypot(pose.x - before.x, pose.y - before.y));
    const most_m = Math.max(0, ...moves_m);
    const most = most_m < 1 ? `${(100 * most_m).toFixed(0)} cm` : `${most_m.toFixed(1)} m`;
    this.tell(`the map was corrected: ${moves_m.filter((m) => m > kNoticeable_m).length} of ${moves_m.length} scans moved, by ${most} at most`,
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

  mapsInMap() { return [...this.maps.values()].filter(({frame}) => !this.isApart(frame)); }

  #takeMark(mark) {
    const known = this.marks.get(mark.id);
    if (known && !supersedes(mark, known)) return;
    if (known?.number && known.number !== mark.number && !mark.removed) {
      this.tell(`mark ${known.number} is called ${mark.number} now: there was another ${known.number}`);
    }
    this.marks.set(mark.id, mark);
    ++this.mapVersion;
  }

  #takeHealth({status}) {
    for (const {name, message, values} of status) {
      const what = name.replace(/^qwsm: /, '');
      if (what === 'service') this.service = {...this.service, name: message, ...values};
      else if (what === 'journal') this.#takeJournal(message, values);
      else if (what === 'refused samples') this.#takeRefusals(values);
      else this.#takeRobotHealth(what, message, values);
    }
  }

  // The message is the journal's file as long as nothing is wrong.
  #takeJournal(message, {stored, waiting}) {
    const trouble = message.includes('/') || message.includes('.db') ? '' : ` (${message})`;
    this.service.journal = `${stored} stored, ${waiting} waiting${trouble}`;
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
