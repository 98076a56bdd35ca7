// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The list of robots, marks, and what the service tells.
import {inkOn, kMarkKinds} from './colors.js';
import {Detail} from './detail.js';
import {element, setText} from './elements.js';
import {condition, Status} from './robot.js';

const $ = (id) => document.getElementById(id);

const metres = (m) => m < 0.995 ? `${(100 * m).toFixed(1)} cm` : `${m.toFixed(2)} m`;
const age = (s) => s === Infinity ? '' : s < 2 ? 'now' : s < 90 ? `${Math.floor(s)} s ago` : `${Math.floor(s / 60)} min ago`;

// How sure its place is, and how much of its scan the map confirms.
function qualityOf({last, sigma_m}) {
  if (!last || last.status === Status.simulated) return '';
  return ` · ±${metres(sigma_m)} · ${Math.round(100 * last.overlap)} % agree`;
}

export class Panel {
  // `actions`: select(name), showRobot(name), follow(name), place(name), showMark(id), showEvent(event).
  constructor(model, state, actions) {
    this.model = model;
    this.state = state;
    this.actions = actions;
    this.detail = new Detail(state, actions);
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
    const order = this.state.shownStamp === null ? 'who needs attention first' : 'as they are now';
    setText($('robot-count'), robots.length ? `${robots.length}, ${order}` : '');
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
    setText(row.badge, robot.label);
    setText(row.age, age(how.age_s));
    setText(row.state, (how.level > 0 ? '▲ ' : '') + how.text + (how.level > 0 ? '' : qualityOf(robot)));
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
    return {item: element('li', {}, button), button, badge, age: ageNode, state: stateNode};
  }

  // The chosen robot's figures stand below it in the list.
  #updateDetail() {
    const robot = this.model.robots.get(this.state.selected);
    const row = this.rows.get(robot?.name);
    this.detail.show(row && robot.last ? robot : null, row?.item);
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
      const textContent = `${mark.number} · ${word}${mark.text ? `: ${mark.text}` : ''}`;
      const button = element('button', {className: 'mark', type: 'button', textContent});
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
    const facts = {
      'Name': name, 'Robots': robots, 'Map': scans && `${scans} scans, ${points} points`, 'Journal': journal,
      'Refused': refused === undefined ? undefined : `${refused} samples`,
      'Up for': uptime && `${Math.floor(uptime / 60)} min ${uptime % 60} s`,
    };
    const key = JSON.stringify(facts);
    if (key !== this.factsKey) {
      this.factsKey = key;
      const told = Object.entries(facts).filter(([, text]) => text !== undefined);
      $('service').replaceChildren(...told.flatMap(([what, text]) => [element('dt', {textContent: what}), element('dd', {textContent: text})]));
    }
    const newest = this.model.events[0];
    if (newest === this.newestEvent && this.state.shownEvent === this.shownEvent) return;
    this.newestEvent = newest;
    this.shownEvent = this.state.shownEvent;
    $('events').replaceChildren(...this.model.events.slice(0, 60).map((event) => this.#makeEvent(event)));
  }
}
