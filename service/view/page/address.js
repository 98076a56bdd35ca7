// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What of the map is looked at, as a part of the page's address: to be kept, or sent to somebody else.

const kRadian = 180 / Math.PI;

// Place in m, pixels per m and, where the map is turned, degrees: #12.5/-3.02/48.2/30
export function addressOf({x, y, scale, turn}) {
  const parts = [Number(x.toFixed(2)), Number(y.toFixed(2)), Number(scale.toPrecision(4))];
  const degrees = Number((turn * kRadian).toFixed(1));
  if (degrees !== 0) parts.push(degrees);
  return `#${parts.join('/')}`;
}

// What such an address says; null of any other.
export function fromAddress(hash) {
  const number = String.raw`(-?\d+(?:\.\d+)?)`;
  const [, ...parts] = new RegExp(`^#${number}/${number}/${number}(?:/${number})?$`).exec(hash) ?? [];
  if (parts.length === 0) return null;
  const [x, y, scale, degrees] = parts.map((part) => Number(part ?? 0));
  return {x, y, scale, turn: degrees / kRadian};
}
