// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Finds room for words beside what stands on the map: where there is none, they are left out.

const kGap_px = 3;
const kSides = [[0, 1], [0, -1], [1, 0], [-1, 0]];  // Below first, then above, right, left.

const overlap = (a, b) => Math.abs(a.x - b.x) < a.wide + b.wide && Math.abs(a.y - b.y) < a.high + b.high;

export class Labels {
  #boxes = [];  // Their middles, and half of their sizes.

  // Keeps words off a symbol, or off others that were placed.
  block(px, py, radius) { this.keepOff({x: px, y: py, wide: radius, high: radius}); }
  keepOff(box) { this.#boxes.push(box); }

  // Where words of a size are beside a symbol, and keeps others off; null where there is no room.
  place(px, py, radius, width, height) {
    const [wide, high] = [width / 2, height / 2];
    for (const [dx, dy] of kSides) {
      const box = {x: px + dx * (radius + kGap_px + wide), y: py + dy * (radius + kGap_px + high), wide, high};
      if (this.#boxes.some((other) => overlap(box, other))) continue;
      this.keepOff(box);
      return box;
    }
    return null;
  }
}
