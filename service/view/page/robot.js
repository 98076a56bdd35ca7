// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What is known of one robot, and how it is, in words.
import {kRobotColors} from './colors.js';
import {compose, inverse, move} from './geometry.js';

const kMostHistory = 20000;  // Reports of a robot: half an hour at 10 Hz.
const kMostTrail = 4000;
const kTrailStep_m = 0.05;
export const kSilent_s = 3;  // A robot that stands is reported every 1.5 s.

const kLongDeadReckoning_s = 3;

// What a match report says; and of a simulated robot that nobody answers, that it is where it is.
export const Status = {first: 0, matched: 1, extended: 2, deadReckoned: 3, lost: 4, simulated: 255};

// Index of the last of some things, in the order of their stamps, at or before a stamp; -1 for none.
function indexAt(things, stamp) {
  let low = 0, high = things.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (things[middle].stamp <= stamp) low = middle + 1; else high = middle;
  }
  return low - 1;
}

// There are eight colours: the ninth robot has that of the first.
const isSecondOfColor = (number) => Math.floor((Number(number) - 1) / kRobotColors.length) % 2 === 1;

// What stands before the number in the last part of a name, such as `rover` in `team/rover_1`.
const kindOf = (name) => name.split('/').at(-1).replace(/_?\d*$/, '');

// Robots of several kinds may have one number, and with it one colour: letters before it, no more than it takes, tell them
// apart on the map, and the line and the ring of who shares a colour.
export function tellApart(robots, number) {
  const alike = robots.filter((robot) => robot.number === number).sort((a, b) => a.name < b.name ? -1 : 1);
  if (alike.length < 2) return;
  const labels = (letters) => alike.map(({name}) => kindOf(name).slice(0, letters) + (/\d*$/.exec(name)[0] || (kindOf(name) ? '' : number)));
  const letters = [1, 2, 3].find((count) => new Set(labels(count)).size === alike.length) ?? 3;
  labels(letters).forEach((label, i) => Object.assign(alike[i], {label, isSecond: isSecondOfColor(number) !== (i % 2 === 1)}));
}

export class Robot {
  constructor(name, index) {
    this.name = name;
    this.index = index;
    this.number = /(\d+)$/.exec(name)?.[1] ?? String(index + 1);
    this.label = this.number;
    // The number tells the colour, so that each robot has the same on every page.
    const place = Number(this.number) - 1;
    this.color = kRobotColors[(place + kRobotColors.length) % kRobotColors.length];
    this.isSecond = isSecondOfColor(this.number);
    this.history = [];
    this.trail = [];
    this.path = new Map();  // Of one that scans in space: corrected poses, by their stamps.
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
    const place = this.path.get(stamp) ?? pose;
    this.history.push({stamp, published_ms, ...place, cov: covariance, status, reason, residual_m: meanResidual, overlap, scans, dropped, latency});
    if (this.history.length > kMostHistory) this.history.splice(0, kMostHistory / 10);
    if (status !== Status.deadReckoned) this.lastMatch = stamp;
    this.arrived_ms = told_ms;
    this.published_ms = published_ms;
    this.isFresh = true;
    const end = this.trail.at(-1);
    const isNew = !end || (stamp > end.stamp && Math.hypot(pose.x - end.x, pose.y - end.y) > kTrailStep_m);
    if (isNew) this.trail.push({x: pose.x, y: pose.y, z: pose.z, stamp, published_ms});
    if (this.trail.length > kMostTrail) this.trail = this.trail.filter((_, i) => i % 2 === 0 || i > kMostTrail / 2);
  }
  // All of its way in space, as it is known now.
  takePath(poses) {
    this.path = new Map(poses.map((pose) => [pose.stamp, pose]));
    for (const entry of this.history) Object.assign(entry, this.path.get(entry.stamp));
    const end = poses.at(-1)?.stamp ?? -Infinity;
    this.trail = [...poses, ...this.trail.filter(({stamp}) => stamp > end)];
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
  beginAnew() { this.history = []; this.trail = []; this.loops = []; this.path.clear(); this.lastMatch = null; }

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

const ago = (s) => s < 90 ? `${Math.round(s)} s` : s < 5400 ? `${Math.round(s / 60)} min` : `${Math.round(s / 3600)} h`;

// How a robot is: `text` says it in the list, `caption` on the map. `level` tells how much it needs
// attention: 0 not, 3 most.
export function condition(robot, now_ms) {
  const age_s = robot.arrived_ms ? (now_ms - robot.arrived_ms) / 1000 : Infinity;
  const is = (level, text, caption = text) => ({level, text, caption, age_s});
  const {health, last} = robot;
  if (health === 'unplaced') return is(3, 'lost: searching for its place on the map', 'lost, searching');
  if (health === 'lost') return age_s < Infinity ? is(2, `gone for ${ago(age_s)}; last place shown`, `gone ${ago(age_s)}`) : is(2, 'gone');
  if (!last) return health === 'expected' ? is(1, 'expected, not heard of yet') : is(2, 'no pose yet');
  if (health?.includes('at its end')) return is(0, health);
  if (age_s > kSilent_s) return is(2, `silent for ${ago(age_s)}`, `silent ${ago(age_s)}`);
  if (last.status === Status.deadReckoned) {
    const since_s = robot.lastMatch === null ? 0 : last.stamp - robot.lastMatch;
    return is(since_s > kLongDeadReckoning_s ? 2 : 1, `dead reckoning for ${ago(since_s)}`);
  }
  if (robot.isApart || last.status === Status.lost) return is(2, 'lost: in a map of its own, searching for its place', 'lost, searching');
  if (last.status === Status.simulated) return is(0, 'simulated; no service answers it');
  if (health === 'answered by another service') return is(0, 'matched, by another service');
  return is(0, last.status === Status.extended ? 'matched, exploring' : 'matched');
}
