// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The map on its canvas: over a picture of what stays, what moves is drawn in every frame.
import {Background, drawPoints} from './background.js';
import {Camera} from './camera.js';
import {boxOf} from './cloud_picture.js';
import {kThemes} from './colors.js';
import {condition, kSilent_s} from './robot.js';
import {drawCaption, drawEllipse, drawMark, drawMarkText, drawRobot} from './symbols.js';

const kGlide_ms = 60;  // In which a robot's picture comes to where the robot is.
const kFar_m = 1;  // From there it jumps.
const kAroundRobot_m = 3;

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
    if (boxes.length === 0) return null;
    const least = (side) => Math.min(...boxes.map((box) => box[side])), most = (side) => Math.max(...boxes.map((box) => box[side]));
    return {left: least('left'), right: most('right'), bottom: least('bottom'), top: most('top')};
  }

  draw(now_ms) {
    const c = this.context;
    const {layers, shownStamp, theme} = this.state;
    this.theme = kThemes[theme];
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.drawImage(this.background.picture(now_ms), 0, 0);
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const robots = this.model.robotsInMap();
    if (shownStamp === null && layers.scans && this.camera.isFromAbove) for (const robot of robots) this.#drawScan(c, robot, now_ms);
    if (layers.marks) this.#drawMarks(c);
    this.#drawRobots(c, robots, now_ms);
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

  #drawMarks(c) {
    const marks = [...this.model.marks.values()].filter(({removed}) => !removed);
    for (const mark of marks) if (mark.text) drawMarkText(c, this.camera, mark, this.theme);
    for (const mark of marks) drawMark(c, this.camera, mark);
  }

  // Words come last, and the chosen robot lies on top of the others.
  #drawRobots(c, robots, now_ms) {
    const {selected, shownStamp, layers} = this.state;
    const isLive = shownStamp === null;
    const drawn = [];
    for (const robot of robots) {
      const pose = isLive ? robot.last : robot.poseAt(shownStamp);
      if (pose) drawn.push({robot, pose: isLive ? glide(robot, pose, now_ms) : pose, how: isLive ? condition(robot, now_ms) : {level: 0}});
    }
    drawn.sort((a, b) => (a.robot.name === selected) - (b.robot.name === selected));
    if (layers.uncertainty && this.camera.isFromAbove) for (const {robot, pose} of drawn) if (pose.cov) drawEllipse(c, this.camera, robot, pose);
    for (const {robot, pose, how} of drawn) drawRobot(c, this.camera, robot, pose, {theme: this.theme, isSelected: robot.name === selected, isFaded: how.level >= 2});
    for (const {pose, how} of drawn) if (how.level > 0) drawCaption(c, this.camera, pose, how);
  }
}
