// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// How fast a hand goes that drags.

const kRecent_ms = 100;  // Who rests for that before letting go, pushes nothing.

export class Swing {
  #places = [];

  begin() { this.#places = []; }

  note([px, py], at_ms) { this.#places.push({px, py, at_ms}); }

  // Speed in the last moments, px/ms.
  speed(now_ms) {
    const recent = this.#places.filter(({at_ms}) => now_ms - at_ms < kRecent_ms);
    if (recent.length < 2) return [0, 0];
    const first = recent[0], last = recent.at(-1);
    const passed_ms = Math.max(1, now_ms - first.at_ms);
    return [(last.px - first.px) / passed_ms, (last.py - first.py) / passed_ms];
  }
}
