// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Figures of the chosen robot, and their course.
import {drawChart} from './chart.js';
import {element, setText} from './elements.js';

const kChart_s = 120;
const kChartPoints = 240;
const kFacts = ['Place', 'Heading', 'Match', 'Latency', 'Scans'];

const button = (text, act) => element('button', {type: 'button', textContent: text, onclick: act});

function chart(title) {
  const canvas = element('canvas', {className: 'chart'});
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', `${title}, last two minutes`);
  const words = element('div', {className: 'chart-title'}, element('span', {textContent: title}), element('span', {textContent: 'last 2 min'}));
  return {canvas, words};
}

// What was in the journal tells no latency, and no scans.
function factsOf({x, y, theta, reason, latency, scans, dropped}) {
  const degrees = ((theta * 180 / Math.PI) % 360 + 360) % 360;
  return {
    Place: `${x.toFixed(2)}, ${y.toFixed(2)} m`, Heading: `${degrees.toFixed(0)}°`, Match: reason || 'good',
    Latency: latency === undefined ? '–' : `${(1000 * latency).toFixed(1)} ms`, Scans: scans === undefined ? '–' : `${scans}, ${dropped} dropped`,
  };
}

export class Detail {
  // `actions`: showRobot(name), follow(name), place(name).
  constructor(state, actions) {
    this.state = state;
    this.actions = actions;
    this.section = document.getElementById('detail');
  }

  // Shows a robot in its row of the list; null: none.
  show(robot, row) {
    this.section.hidden = !robot;
    if (!robot) {
      this.shown = null;
      return;
    }
    if (this.shown !== robot) this.#make(robot, row);
    this.#update(robot);
  }

  #make(robot, row) {
    this.shown = robot;
    this.facts = Object.fromEntries(kFacts.map((name) => [name, element('dd')]));
    const list = element('dl', {className: 'facts'}, ...kFacts.flatMap((name) => [element('dt', {textContent: name}), this.facts[name]]));
    this.sigma = chart('Uncertainty');
    this.residual = chart('Residual of the match');
    this.follow = button('Follow', () => this.actions.follow(robot.name));
    const buttons = element('div', {className: 'row'}, button('Show', () => this.actions.showRobot(robot.name)), this.follow,
      button('Say where it is', () => this.actions.place(robot.name)));
    this.section.replaceChildren(list, this.sigma.words, this.sigma.canvas, this.residual.words, this.residual.canvas, buttons);
    this.section.setAttribute('aria-label', robot.name || 'robot');
    row.append(this.section);
    row.scrollIntoView({block: 'nearest'});
  }

  #update(robot) {
    const isFollowed = this.state.followed === robot.name;
    this.follow.setAttribute('aria-pressed', String(isFollowed));
    setText(this.follow, isFollowed ? 'Following' : 'Follow');
    const now = this.state.shownStamp ?? robot.last.stamp;
    const path = robot.pathUntil(now);
    const facts = factsOf(path.at(-1) ?? robot.history[0]);
    for (const name of kFacts) setText(this.facts[name], facts[name]);
    const recent = path.filter(({stamp}) => stamp > now - kChart_s);
    const step = Math.max(1, Math.floor(recent.length / kChartPoints));
    this.#draw(recent.filter((_, i) => i % step === 0));
  }

  // What was in the journal tells no residual.
  #draw(path) {
    const style = getComputedStyle(document.documentElement);
    const colors = {ink: style.getPropertyValue('--muted'), color: style.getPropertyValue('--accent')};
    const sigmas = path.map(({stamp, cov}) => ({stamp, value: 100 * Math.sqrt(Math.max(0, cov[0] + cov[4]))}));
    const residuals = path.filter(({residual_m}) => residual_m !== undefined).map(({stamp, residual_m}) => ({stamp, value: 1000 * residual_m}));
    drawChart(this.sigma.canvas, sigmas, {...colors, floor: 1, unit: 'cm'});
    drawChart(this.residual.canvas, residuals, {...colors, floor: 5, unit: 'mm'});
  }
}
