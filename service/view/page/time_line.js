// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The time that is shown: now, or what the journal and this page remember of earlier.

const kSteps = 1000;
const $ = (id) => document.getElementById(id);

const timeAgo = (s) => s < 60 ? `${Math.floor(s)} s ago` : `${Math.floor(s / 60)} min ${Math.floor(s % 60)} s ago`;

export class TimeLine {
  // `actions`: lookBack() when the past is asked for, changed().
  constructor(model, state, actions) {
    this.model = model;
    this.state = state;
    this.actions = actions;
    $('time-slider').addEventListener('input', ({target}) => this.#seek(Number(target.value)));
    $('time-slider').addEventListener('pointerdown', () => actions.lookBack());
    $('live').addEventListener('click', () => this.live());
  }

  live() {
    this.state.shownStamp = null;
    $('time-slider').value = kSteps;
    this.actions.changed();
    this.update();
  }

  #seek(step) {
    this.actions.lookBack();
    const {span} = this.model;
    if (!span) return this.live();  // What the journal holds is on its way.
    this.state.shownStamp = step >= kSteps ? null : span.first + (span.last - span.first) * step / kSteps;
    this.actions.changed();
    this.update();
  }

  update() {
    const {span} = this.model;
    const isLive = this.state.shownStamp === null;
    $('live').setAttribute('aria-pressed', String(isLive));
    const back_s = isLive || !span ? 0 : span.last - this.state.shownStamp;
    const text = isLive ? 'now' : timeAgo(back_s);
    if ($('time-text').value !== text) {
      $('time-text').value = text;
      $('time-slider').setAttribute('aria-valuetext', text);
    }
    if (span && !isLive) $('time-slider').value = Math.round(kSteps * (this.state.shownStamp - span.first) / (span.last - span.first));
    this.#drawEvents(span);
  }

  #drawEvents(span) {
    const canvas = $('time-events');
    canvas.width = canvas.clientWidth;
    canvas.height = canvas.clientHeight;
    if (!span) return;
    const c = canvas.getContext('2d');
    c.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--warn');
    for (const {stamp} of this.model.events) {
      if (stamp === null || stamp < span.first) continue;
      c.fillRect((stamp - span.first) / (span.last - span.first) * (canvas.width - 16) + 7, 3, 2, 12);
    }
  }
}
