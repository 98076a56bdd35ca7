// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The time that is shown: now, or what the journal and this page remember of earlier.

const kSteps = 1000;
const $ = (id) => document.getElementById(id);

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
    const {span} = this.model;
    if (!span) return;
    this.actions.lookBack();
    this.state.shownStamp = step >= kSteps ? null : span.first + (span.last - span.first) * step / kSteps;
    this.actions.changed();
    this.update();
  }

  update() {
    const {span} = this.model;
    const isLive = this.state.shownStamp === null;
    $('live').setAttribute('aria-pressed', String(isLive));
    $('time-slider').disabled = !span;
    const back_s = isLive || !span ? 0 : span.last - this.state.shownStamp;
    const text = isLive ? 'now' : `${Math.floor(back_s / 60)} min ${Math.floor(back_s % 60)} s before`;
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
