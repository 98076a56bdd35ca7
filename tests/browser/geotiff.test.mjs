// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A rescue map is read by npm's geotiff, which knows nothing of our writer: colours, place and scale.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {fromFile} from 'geotiff';
import {Programs} from './programs.mjs';

const kColors = {
  outside: [[226, 226, 227], [237, 237, 238]], free: [[255, 255, 255]], grid: [[190, 190, 191]], wall: [[0, 40, 120]],
  path: [[120, 0, 140]], start: [[255, 200, 0]], victim: [[240, 10, 10]], hazard: [[255, 100, 30]],
};
const kMarks = [{type: 'victim', x: 2.5, y: 1.25}, {type: 'hazard', x: -1.75, y: 3.5}];
const kOffCentre_m = 0.14;  // Beside the number on a mark, and still on it: a disc of 0.35 m, a diamond of 0.3 m.

test('npm\'s geotiff reads a rescue map, with its colours and with marks at the right metre', async (t) => {
  const programs = new Programs();
  t.after(() => programs.stop());
  const run = async (args) => {
    const process = programs.start(args);
    assert.equal(await process.ended, 0, process.said);
  };
  const results = join(programs.folder, 'results'), marks = join(programs.folder, 'marks.csv'), name = join(programs.folder, 'rescue');
  await run(['map', '--sim', 'office', '--duration', '20', '--quiet', '--output', results]);
  writeFileSync(marks, `x,y,type\n${kMarks.map(({x, y, type}) => `${x},${y},${type}`).join('\n')}\n`);
  await run(['export', results, '--geotiff', name, '--pois', marks, '--pixels-per-cell', '2']);

  const image = await (await fromFile(`${name}.tif`)).getImage();
  const [left, top] = image.getOrigin(), [wide_m, high_m] = image.getResolution();
  assert.ok(Math.abs(wide_m - 0.025) < 1e-9 && Math.abs(high_m + 0.025) < 1e-9, `${wide_m}, ${high_m}`);
  const pixels = await image.readRGB({interleave: true});
  const colorAt = (x, y) => {
    const at = 3 * (Math.floor((y - top) / high_m) * image.getWidth() + Math.floor((x - left) / wide_m));
    return [...pixels.subarray(at, at + 3)];
  };
  for (const {type, x, y} of kMarks) assert.deepEqual(colorAt(x + kOffCentre_m, y), kColors[type][0], type);

  const seen = new Set();
  for (let i = 0; i < pixels.length; i += 3) seen.add(`${pixels[i]},${pixels[i + 1]},${pixels[i + 2]}`);
  for (const [what, colors] of Object.entries(kColors)) for (const color of colors) assert.ok(seen.has(color.join()), what);

  // The world file tells the middle of the first pixel.
  const world = readFileSync(`${name}.tfw`, 'utf8').trim().split(/\s+/).map(Number);
  [wide_m, 0, 0, high_m, left + wide_m / 2, top + high_m / 2].forEach((value, i) => assert.ok(Math.abs(world[i] - value) < 1e-6, `line ${i + 1}: ${world[i]}`));
});
