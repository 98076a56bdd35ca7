// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// An occupancy grid that comes in tiles, as few pictures of which each is redrawn rarely.
import {packed} from './colors.js';

const kChunkTiles = 8;  // Tiles of a chunk, along each side.

export const union = (a, b) => ({
  left: Math.min(a.left, b.left), bottom: Math.min(a.bottom, b.bottom), right: Math.max(a.right, b.right), top: Math.max(a.top, b.top),
});

// Cells of some tiles as one picture.
class Chunk {
  constructor(cells) {
    this.side = cells;
    this.states = new Uint8Array(cells * cells);
    this.canvas = null;
    this.known = null;  // Cells between which something is known: left, bottom, right, top.
  }
  put(tile, firstX, firstY) {
    let x = 0, y = 0;
    for (const run of tile.runs) {
      const state = run >> 6;
      for (let left = (run & 63) + 1; left > 0;) {
        const count = Math.min(left, tile.width - x);
        this.#fill(state, firstX + x, firstY + y, count);
        left -= count;
        x += count;
        if (x === tile.width) { x = 0; ++y; }
      }
    }
    this.canvas = null;
  }
  // Cells of one row.
  #fill(state, x, y, count) {
    const begin = (this.side - 1 - y) * this.side + x;  // A picture's first row is the highest.
    this.states.fill(state, begin, begin + count);
    if (state === 0) return;
    this.known ??= {left: x, bottom: y, right: x, top: y};
    const {left, bottom, right, top} = this.known;
    if (x < left) this.known.left = x;
    if (x + count > right) this.known.right = x + count;
    if (y < bottom) this.known.bottom = y;
    if (y >= top) this.known.top = y + 1;
  }
  // `palette`: for unknown, free, occupied, each [r, g, b, a].
  picture(palette) {
    if (this.canvas && this.palette === palette) return this.canvas;
    this.palette = palette;
    this.canvas = document.createElement('canvas');
    this.canvas.width = this.canvas.height = this.side;
    const context = this.canvas.getContext('2d');
    const image = context.createImageData(this.side, this.side);
    const colors = new Uint32Array(image.data.buffer);
    const ofState = palette.map(packed);
    for (let i = 0; i < this.states.length; ++i) colors[i] = ofState[this.states[i]];
    context.putImageData(image, 0, 0);
    return this.canvas;
  }
}

export class GridMap {
  constructor() { this.clear(); }
  clear() { this.chunks = new Map(); this.tiles = new Set(); this.generation = null; }
  take(tile) {
    if (this.generation !== null && tile.generation < this.generation) return;
    if (tile.generation !== this.generation) this.clear();
    this.generation = tile.generation;
    this.frame = tile.frame;
    const side_m = tile.resolution * tile.width;
    const column = Math.round(tile.x / side_m), row = Math.round(tile.y / side_m);
    const chunkColumn = Math.floor(column / kChunkTiles), chunkRow = Math.floor(row / kChunkTiles);
    const key = `${chunkColumn},${chunkRow}`;
    this.tiles.add(`${column},${row}`);
    let chunk = this.chunks.get(key);
    if (!chunk) {
      chunk = new Chunk(kChunkTiles * tile.width);
      chunk.size_m = kChunkTiles * side_m;
      chunk.x = tile.x - (column - chunkColumn * kChunkTiles) * side_m;
      chunk.y = tile.y - (row - chunkRow * kChunkTiles) * side_m;
      this.chunks.set(key, chunk);
    }
    chunk.put(tile, (column - chunkColumn * kChunkTiles) * tile.width, (row - chunkRow * kChunkTiles) * tile.width);
  }
  // Of what is known, in metres; null where nothing is.
  get bounds() {
    let bounds = null;
    for (const {known, x, y, size_m, side} of this.chunks.values()) {
      if (!known) continue;
      const cell_m = size_m / side;
      const box = {left: x + known.left * cell_m, bottom: y + known.bottom * cell_m, right: x + known.right * cell_m, top: y + known.top * cell_m};
      bounds = bounds ? union(bounds, box) : box;
    }
    return bounds;
  }
}
