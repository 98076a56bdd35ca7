// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What stands on the map for a robot and for a mark. `c` is the canvas' context; places are of the screen.
import {inkOn, kMarkKinds} from './colors.js';

const kFont = 'system-ui, "DejaVu Sans", sans-serif';
const kEllipse_sigmas = 2.45;  // Holds 95 % of a Gaussian of two dimensions.
const kWidestEllipse_px = 20000;
const kCaptionColors = ['', '#8a4b00', '#b3261e', '#b3261e'];  // By how much attention is needed.

const kWordsFont = `600 12px ${kFont}`;
const kCaption_px = 19;
const kMostLetters = 32;

const within = (low, value, high) => Math.min(high, Math.max(low, value));
export const robotRadius = (camera) => within(11, 0.3 * camera.scale, 26);
export const markRadius = (camera) => within(11, 0.35 * camera.scale, 20);

function drawCentred(c, text, px, py, font, color) {
  c.font = font;
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  c.fillStyle = color;
  c.fillText(text, px, py);
}

function traceDrop(c, camera, px, py, radius, theta) {
  c.beginPath();
  if (!camera.isFromAbove) return c.arc(px, py, radius, 0, 2 * Math.PI);
  const ahead = theta + camera.turn;
  c.moveTo(px + 1.75 * radius * Math.cos(ahead), py - 1.75 * radius * Math.sin(ahead));
  c.arc(px, py, radius, 0.62 - ahead, -0.62 - ahead);
  c.closePath();
}

// A drop that points where the robot looks, with its number.
export function drawRobot(c, camera, robot, pose, {theme, isSelected, isFaded}) {
  const [px, py] = camera.toScreen(pose.x, pose.y, pose.z);
  const radius = robotRadius(camera);
  traceDrop(c, camera, px, py, radius, pose.theta);
  c.globalAlpha = isFaded ? 0.55 : 1;
  c.lineWidth = isSelected ? 6 : 3.5;
  c.strokeStyle = theme.ink;
  c.stroke();
  c.lineWidth = isSelected ? 3 : 1.5;
  c.strokeStyle = theme.paper;
  c.stroke();
  c.fillStyle = robot.color;
  c.fill();
  c.globalAlpha = 1;
  const ink = inkOn(robot.color);
  drawCentred(c, robot.label, px, py + 0.5, `700 ${Math.round(1.05 * radius * Math.min(1, 2 / robot.label.length))}px ${kFont}`, ink);
  if (!robot.isSecond) return;
  c.beginPath();
  c.arc(px, py, 0.8 * radius, 0, 2 * Math.PI);
  c.lineWidth = 1.5;
  c.strokeStyle = ink;
  c.stroke();
}

// A robot that needs attention says so on the map, too: by a sign, and in words where there is room.
export function drawAttention(c, camera, pose, level) {
  const [px, py] = camera.toScreen(pose.x, pose.y, pose.z);
  const off = 0.75 * robotRadius(camera);
  c.beginPath();
  c.arc(px + off, py - off, 7, 0, 2 * Math.PI);
  c.fillStyle = kCaptionColors[level];
  c.fill();
  c.lineWidth = 1.5;
  c.strokeStyle = '#fff';
  c.stroke();
  drawCentred(c, '!', px + off, py - off + 0.5, `800 11px ${kFont}`, '#fff');
}

// @return room for that, as Labels.place() does.
export function captionRoom(c, camera, pose, caption, labels) {
  c.font = kWordsFont;
  const width = c.measureText(caption).width + 14;
  return labels.place(...camera.toScreen(pose.x, pose.y, pose.z), 1.2 * robotRadius(camera), width, kCaption_px);
}

export function drawCaption(c, {x, y, wide, high}, {level, caption}) {
  c.fillStyle = kCaptionColors[level];
  c.beginPath();
  c.roundRect(x - wide, y - high, 2 * wide, 2 * high, high);
  c.fill();
  drawCentred(c, caption, x, y + 1, kWordsFont, '#fff');
}

// Where a robot is with 95 %.
export function drawEllipse(c, camera, robot, {x, y, cov}) {
  const [xx, xy, , , yy] = cov;
  const middle = (xx + yy) / 2, spread = Math.hypot((xx - yy) / 2, xy);
  const axis_px = (variance) => Math.max(1, kEllipse_sigmas * Math.sqrt(Math.max(0, variance)) * camera.scale);
  const major = axis_px(middle + spread), minor = axis_px(middle - spread);
  if (major > kWidestEllipse_px) return;
  c.beginPath();
  c.ellipse(...camera.toScreen(x, y), major, minor, -0.5 * Math.atan2(2 * xy, xx - yy) - camera.turn, 0, 2 * Math.PI);
  c.fillStyle = robot.color + '33';
  c.fill();
  c.strokeStyle = robot.color;
  c.lineWidth = 1.5;
  c.setLineDash([5, 3]);
  c.stroke();
  c.setLineDash([]);
}

function traceMark(c, shape, px, py, r) {
  c.beginPath();
  if (shape === 'disc') return c.arc(px, py, r, 0, 2 * Math.PI);
  if (shape === 'square') return c.roundRect(px - 0.85 * r, py - 0.85 * r, 1.7 * r, 1.7 * r, 4);
  c.moveTo(px, py - 1.25 * r);
  c.lineTo(px + 1.25 * r, py);
  c.lineTo(px, py + 1.25 * r);
  c.lineTo(px - 1.25 * r, py);
  c.closePath();
}

export function drawMark(c, camera, mark) {
  const kind = kMarkKinds[mark.kind] ?? kMarkKinds.note;
  const [px, py] = camera.toScreen(mark.x, mark.y);
  const r = markRadius(camera);
  traceMark(c, kind.shape, px, py, r);
  c.fillStyle = kind.color;
  c.fill();
  c.lineWidth = 2;
  c.strokeStyle = '#fff';
  c.stroke();
  drawCentred(c, mark.number || '', px, py + 1, `700 ${Math.round(r)}px ${kFont}`, inkOn(kind.color));
}

// What is said of a mark on the map: all of a long remark, which is in the list, would lie across half of it.
export function wordsOf({text}) {
  const letters = [...text];
  return letters.length <= kMostLetters ? text : `${letters.slice(0, kMostLetters - 1).join('').trimEnd()}…`;
}

export function drawMarkText(c, camera, mark, theme, labels) {
  const words = wordsOf(mark);
  c.font = kWordsFont;
  const room = labels.place(...camera.toScreen(mark.x, mark.y), markRadius(camera), c.measureText(words).width, kCaption_px - 4);
  if (room) drawOutlined(c, words, room.x, room.y, kWordsFont, theme);
}

// Text that can be read on anything.
export function drawOutlined(c, text, px, py, font, theme) {
  c.font = font;
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  c.lineWidth = 3.5;
  c.lineJoin = 'round';
  c.strokeStyle = theme.paper;
  c.strokeText(text, px, py);
  c.fillStyle = theme.ink;
  c.fillText(text, px, py);
}

// From one point of the screen to another: a length, or with an arrow where a robot looks.
export function drawStretch(c, [ax, ay], [bx, by], {text, isArrow, theme}) {
  const color = isArrow ? '#ffc800' : '#d55e00';
  c.beginPath();
  c.moveTo(ax, ay);
  c.lineTo(bx, by);
  c.lineWidth = 6;
  c.strokeStyle = theme.paper;
  c.stroke();
  c.lineWidth = 3;
  c.strokeStyle = color;
  c.stroke();
  c.fillStyle = color;
  for (const [px, py, r] of isArrow ? [[ax, ay, 8]] : [[ax, ay, 4], [bx, by, 4]]) {
    c.beginPath();
    c.arc(px, py, r, 0, 2 * Math.PI);
    c.fill();
  }
  if (isArrow) drawArrowHead(c, [bx, by], Math.atan2(by - ay, bx - ax));
  drawOutlined(c, text, (ax + bx) / 2, (ay + by) / 2 - 16, `700 15px ${kFont}`, theme);
}

function drawArrowHead(c, [px, py], angle) {
  c.beginPath();
  c.moveTo(px, py);
  for (const side of [-0.45, 0.45]) c.lineTo(px - 15 * Math.cos(angle + side), py - 15 * Math.sin(angle + side));
  c.fill();
}

// Where the keyboard would put something.
export function drawAim(c, [px, py], theme) {
  for (const [width, color] of [[5, theme.paper], [2, theme.ink]]) {
    c.beginPath();
    c.arc(px, py, 10, 0, 2 * Math.PI);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      c.moveTo(px + 5 * dx, py + 5 * dy);
      c.lineTo(px + 18 * dx, py + 18 * dy);
    }
    c.lineWidth = width;
    c.strokeStyle = color;
    c.stroke();
  }
}

// Around what is going to be enlarged.
export function drawFrame(c, [ax, ay], [bx, by], theme) {
  c.strokeStyle = theme.paper;
  c.lineWidth = 4;
  c.strokeRect(ax, ay, bx - ax, by - ay);
  c.strokeStyle = theme.ink;
  c.lineWidth = 1.5;
  c.setLineDash([6, 4]);
  c.strokeRect(ax, ay, bx - ax, by - ay);
  c.setLineDash([]);
}
