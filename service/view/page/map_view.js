// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The map on its canvas: over a picture of what stays, what moves is drawn in every frame.
import {Background, drawPoints} from './background.js';
import {Camera} from './camera.js';
import {boxOf} from './cloud_picture.js';
import {kThemes} from './colors.js';
import {union} from './grid_map.js';
import {Labels} from './labels.js';
import {condition, kSilent_s} from './robot.js';
import {captionRoom, drawAttention, drawCaption, drawEllipse, drawMark, drawMarkText, drawRobot, markRadius, robotRadius} from './symbols.js';

const kGlide_ms = 60;  // In which a robot's picture comes to where the robot is.
const kFar_m = 1;  // From there it jumps.
const kAroundRobot_m = 3;
const kUnremarkable = {level: 0};

// A robot moves on the screen instead of jumping ten times a second.
function glide(robot, pose, now_ms) {
  const {shown} = robot;
  const share = Math.min(1, (now_ms - (robot.shown_ms ?? 0)) / kGlide_ms);
  robot.shown_ms = now_ms;
  if (!shown || share === 1 || Math.hypot(pose.x - shown.x, pose.y - shown.y) > kFar_m) {
    robot.shown = {x: pose.x, y: pose.y, theta: pose.theta};
  } else {
    const turn = Math.atan2(Math.sin(pose.theta - shown.theta), Math.cos(pose.theta - shown.theta));
    shown.x += share * (pose.x - shown.x);
    shown.y += share * (pose.y - shown.y);
    shown.theta += share * turn;
  }
  return {...pose, ...robot.shown};
}

export class MapView {
  // `state`: {layers, selected, theme, shownStamp, shownEvent}.
  constructor(canvas, model, state) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d', {alpha: false});
    this.model = model;
    this.state = state;
    this.camera = new Camera();
    this.background = new Background(model, state, this.camera);
    this.overlay = null;  // Drawn by a tool, on top.
    this.frames = 0;
  }

  resize() {
    this.ratio = window.devicePixelRatio || 1;
    this.camera.width = this.canvas.clientWidth;
    this.camera.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.camera.width * this.ratio);
    this.canvas.height = Math.round(this.camera.height * this.ratio);
    this.background.resize(this.ratio);
  }

  // Of all there is to be seen, on the plane that is looked at; null where there is nothing.
  bounds() {
    const boxes = this.camera.isFromAbove ? this.model.mapsInMap().map(({bounds}) => bounds).filter(Boolean) : [];
    for (const points of this.model.clouds.values()) boxes.push(boxOf(points, this.camera));
    for (const {last} of this.model.robotsInMap()) {
      if (!last) continue;
      const [right, up] = this.camera.project(last.x, last.y, last.z);
      boxes.push({left: right - kAroundRobot_m, right: right + kAroundRobot_m, bottom: up - kAroundRobot_m, top: up + kAroundRobot_m});
    }
    return boxes.length > 0 ? boxes.reduce(union) : null;
  }

  draw(now_ms) {
    const c = this.context;
    const {layers, shownStamp, theme} = this.state;
    this.theme = kThemes[theme];
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.drawImage(this.background.picture(now_ms), 0, 0);
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const drawn = this.#posed(now_ms);
    if (shownStamp === null && layers.scans && this.camera.isFromAbove) for (const {robot} of drawn) this.#drawScan(c, robot, now_ms);
    const marks = layers.marks ? [...this.model.marks.values()].filter(({removed}) => !removed) : [];
    const captions = this.#captions(c, marks, drawn);
    this.#drawMarks(c, marks, captions);
    this.#drawRobots(c, drawn);
    for (const {how, room} of captions) drawCaption(c, room, how);
    this.overlay?.(c, this.camera, this.theme);
    ++this.frames;
    this.#noteLatencies();
  }

  // From publication to the screen, on this computer's clock.
  #noteLatencies() {
    const now_ms = performance.timeOrigin + performance.now();
    for (const robot of this.model.robots.values()) {
      if (!robot.isFresh) continue;
      robot.isFresh = false;
      this.model.latencies_ms.push(now_ms - robot.published_ms);
    }
    if (this.model.latencies_ms.length > 10000) this.model.latencies_ms.splice(0, 5000);
  }

  #drawScan(c, robot, now_ms) {
    if (!robot.points || now_ms - robot.arrived_ms > 1000 * kSilent_s) return;
    c.fillStyle = robot.color;
    drawPoints(c, this.camera, robot.points, Math.max(2, Math.min(4, this.camera.scale * 0.05)));
  }

  #drawRobots(c, drawn) {
    if (this.state.layers.uncertainty && this.camera.isFromAbove) {
      for (const {robot, pose} of drawn) if (pose.cov) drawEllipse(c, this.camera, robot, pose);
    }
    for (const {robot, pose, how} of drawn) {
      drawRobot(c, this.camera, robot, pose, {theme: this.theme, isSelected: robot.name === this.state.selected, isFaded: how.level >= 2});
      if (how.level > 0) drawAttention(c, this.camera, pose, how.level);
    }
  }

  // Where words are on robots that need attention: off marks, robots and each other.
  #captions(c, marks, drawn) {
    const labels = new Labels();
    for (const mark of marks) labels.block(...this.camera.toScreen(mark.x, mark.y), markRadius(this.camera));
    for (const {pose} of drawn) labels.block(...this.camera.toScreen(pose.x, pose.y, pose.z), robotRadius(this.camera));
    const needy = drawn.filter(({how}) => how.level > 0).sort((a, b) => b.how.level - a.how.level);
    return needy.map(({pose, how}) => ({how, room: captionRoom(c, this.camera, pose, how.caption, labels)})).filter(({room}) => room);
  }

  // Their words may be driven over.
  #drawMarks(c, marks, captions) {
    const labels = new Labels();
    for (const {room} of captions) labels.keepOff(room);
    for (const mark of marks) labels.block(...this.camera.toScreen(mark.x, mark.y), markRadius(this.camera));
    for (const mark of marks) if (mark.text) drawMarkText(c, this.camera, mark, this.theme, labels);
    for (const mark of marks) drawMark(c, this.camera, mark);
  }

  // Robots with the poses that they are drawn at, the chosen one on top of the others.
  #posed(now_ms) {
    const {selected, shownStamp} = this.state;
    const posed = [];
    for (const robot of this.model.robotsInMap()) {
      const pose = shownStamp === null ? robot.last : robot.poseAt(shownStamp);
      if (!pose) continue;
      posed.push(shownStamp === null
        ? {robot, pose: glide(robot, pose, now_ms), how: condition(robot, now_ms)}
        : {robot, pose, how: kUnremarkable});
    }
    return posed.sort((a, b) => (a.robot.name === selected) - (b.robot.name === selected));
  }
}
