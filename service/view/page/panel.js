// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The list of robots, the chosen one's figures, marks, and what the service tells.
import {drawChart} from './chart.js';
import {inkOn, kMarkKinds} from './colors.js';
import {condition, Status} from './robot.js';

const kChart_s = 120;
const kChartPoints = 240;
const $ = (id) => document.getElementById(id);

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

const metres = (m) => m < 0.995 ? `${(100 * m).toFixed(1)} cm` : `${m.toFixed(2)} m`;
const age = (s) => s === Infinity ? '' : s < 2 ? 'now' : s < 90 ? `${Math.floor(s)} s ago` : `${Math.floor(s / 60)} min ago`;

export class Panel {
  // `actions`: select(name), showRobot(name), follow(name), place(name), showMark(id), showEvent(event).
  constructor(model, state, actions) {
    this.model = model;
    this.state = state;
    this.actions = actions;
    this.rows = new Map();
    this.order = [];  // Names of the robots, who needs attention first.
    $('panel-fold').onclick = () => {
      const folded = $('panel').classList.toggle('folded');
      $('panel-fold').setAttribute('aria-expanded', String(!folded));
      $('panel-fold').textContent = folded ? '+' : '–';
    };
  }

  update(now_ms) {
    const robots = [...this.model.robots.values()].map((robot) => ({robot, how: condition(robot, now_ms)}));
    robots.sort((a, b) => b.how.level - a.how.level || a.robot.name.localeCompare(b.robot.name, undefined, {numeric: true}));
    this.order = robots.map(({robot}) => robot.name);
    $('nobody').hidden = robots.length > 0;
    setText($('robot-count'), robots.length ? `${robots.length}, who needs attention first` : '');
    robots.forEach(({robot, how}, place) => this.#updateRow(robot, how, place));
    this.#updateDetail();
    this.#updateMarks();
    this.#updateService();
  }

  #updateRow(robot, how, place) {
    let row = this.rows.get(robot.name);
    if (!row) {
      row = this.#makeRow(robot);
      this.rows.set(robot.name, row);
    }
    row.button.dataset.level = how.level;
    row.button.setAttribute('aria-pressed', String(this.state.selected === robot.name));
    setText(row.age, age(how.age_s));
    const quality = robot.last && how.level === 0 && robot.last.status !== Status.simulated ? ` · ±${metres(robot.sigma_m)} · ${Math.round(100 * robot.last.overlap)} % agree` : '';
    setText(row.state, (how.level > 0 ? '▲ ' : '') + how.text + quality);
    const list = $('robots');
    if (list.children[place] !== row.item) list.insertBefore(row.item, list.children[place] ?? null);
  }

  #makeRow(robot) {
    const badge = element('span', {className: 'badge', textContent: robot.label});
    badge.style.background = robot.color;
    badge.style.color = inkOn(robot.color);
    const ageNode = element('span', {className: 'age'});
    const stateNode = element('span', {className: 'state'});
    const button = element('button', {className: 'robot', type: 'button'}, badge,
      element('span', {className: 'name', textContent: robot.name || 'robot'}), ageNode, stateNode);
    button.onclick = () => this.actions.select(robot.name);
    button.ondblclick = () => this.actions.showRobot(robot.name);
    return {item: element('li', {}, button), button, age: ageNode, state: stateNode};
  }

  #updateDetail() {
    const robot = this.model.robots.get(this.state.selected);
    $('detail').hidden = !robot?.last;
    if (!robot?.last) return;
    if (this.detailOf !== robot.name) this.#makeDetail(robot);
    const now = this.state.shownStamp ?? robot.last.stamp;
    const path = robot.pathUntil(now);
    const pose = path.at(-1) ?? robot.history[0];
    const {facts, sigma, residual} = this.detail;
    const degrees = ((pose.theta * 180 / Math.PI) % 360 + 360) % 360;
    const figures = {
      'Place': `${pose.x.toFixed(2)}, ${pose.y.toFixed(2)} m`, 'Heading': `${degrees.toFixed(0)}°`,
      'Match': pose.reason || 'good', 'Latency': pose.latency === undefined ? '–' : `${(1000 * pose.latency).toFixed(1)} ms`,
      'Scans': pose.scans === undefined ? '–' : `${pose.scans}, ${pose.dropped} dropped`,
    };
    for (const [name, text] of Object.entries(figures)) setText(facts[name], text);
    const recent = path.filter(({stamp}) => stamp > now - kChart_s);
    const step = Math.max(1, Math.floor(recent.length / kChartPoints));
    const shown = recent.filter((_, i) => i % step === 0);
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--muted'), color = style.getPropertyValue('--accent');
    drawChart(sigma, shown.map(({stamp, cov}) => ({stamp, value: 100 * Math.sqrt(Math.max(0, cov[0] + cov[4]))})), {color, ink, floor: 1, unit: 'cm'});
    // What was in the journal tells no residual.
    drawChart(residual, shown.filter(({residual_m}) => residual_m !== undefined).map(({stamp, residual_m}) => ({stamp, value: 1000 * residual_m})), {color, ink, floor: 5, unit: 'mm'});
  }

  #makeDetail(robot) {
    this.detailOf = robot.name;
    const facts = {};
    const list = element('dl', {className: 'facts'});
    for (const name of ['Place', 'Heading', 'Match', 'Latency', 'Scans']) {
      facts[name] = element('dd');
      list.append(element('dt', {textContent: name}), facts[name]);
    }
    const chart = (title) => {
      const canvas = element('canvas', {className: 'chart'});
      canvas.setAttribute('role', 'img');
      canvas.setAttribute('aria-label', `${title}, last two minutes`);
      return [element('div', {className: 'chart-title'}, element('span', {textContent: title}), element('span', {textContent: 'last 2 min'})), canvas];
    };
    const [sigmaTitle, sigma] = chart('Uncertainty');
    const [residualTitle, residual] = chart('Residual of the match');
    const button = (text, act) => Object.assign(element('button', {textContent: text, type: 'button'}), {onclick: act});
    this.detail = {facts, sigma, residual};
    $('detail').replaceChildren(
      element('h2', {textContent: robot.name || 'robot'}), list, sigmaTitle, sigma, residualTitle, residual,
      element('div', {className: 'row'}, button('Show', () => this.actions.showRobot(robot.name)),
        button('Follow', () => this.actions.follow(robot.name)), button('Say where it is', () => this.actions.place(robot.name))));
  }

  #updateMarks() {
    const marks = [...this.model.marks.values()].sort((a, b) => a.number - b.number);
    const key = JSON.stringify(marks);
    if (key === this.marksKey) return;
    this.marksKey = key;
    $('marks-section').hidden = !marks.some(({removed}) => !removed);
    $('marks').replaceChildren(...marks.flatMap((mark) => {
      if (mark.removed) return [];
      const {word} = kMarkKinds[mark.kind] ?? kMarkKinds.note;
      const button = element('button', {className: 'mark', type: 'button', textContent: `${mark.number} · ${word}${mark.text ? ': ' + mark.text : ''}`});
      button.onclick = () => this.actions.showMark(mark.id);
      return [element('li', {}, button)];
    }));
  }

  #makeEvent(event) {
    const item = element('li', {}, element('time', {textContent: new Date(event.at_ms).toLocaleTimeString()}), event.text);
    if (!event.moves) return item;
    const button = element('button', {className: 'plain', type: 'button', textContent: 'before and after'});
    button.setAttribute('aria-pressed', String(this.state.shownEvent === event));
    button.onclick = () => this.actions.showEvent(event);
    item.append(' ', button);
    return item;
  }

  #updateService() {
    const {name, map_scans: scans, map_points: points, robots, journal, refused, uptime_s: uptime} = this.model.service;
    const facts = {'Name': name, 'Robots': robots, 'Map': scans && `${scans} scans, ${points} points`, 'Journal': journal, 'Refused': refused === undefined ? undefined : `${refused} samples`, 'Up for': uptime && `${Math.floor(uptime / 60)} min ${uptime % 60} s`};
    const key = JSON.stringify(facts);
    if (key !== this.factsKey) {
      this.factsKey = key;
      $('service').replaceChildren(...Object.entries(facts).flatMap(([what, text]) => text === undefined ? [] : [element('dt', {textContent: what}), element('dd', {textContent: text})]));
    }
    const newest = this.model.events[0];
    if (newest === this.newestEvent && this.state.shownEvent === this.shownEvent) return;
    this.newestEvent = newest;
    this.shownEvent = this.state.shownEvent;
    $('events').replaceChildren(...this.model.events.slice(0, 60).map((event) => this.#makeEvent(event)));
  }
}
