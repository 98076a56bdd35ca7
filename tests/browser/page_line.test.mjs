// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the page makes of a service that says nothing any more, and of what others publish beside it.
import assert from 'node:assert/strict';
import {after, before, test} from 'node:test';
import {chromium} from 'playwright-core';
import {freePort, kBrowser, Programs} from './programs.mjs';

let programs, browser, page, service;
const complaints = [];

before(async () => {
  programs = new Programs();
  const port = await freePort();
  service = await programs.serve(port);
  browser = await chromium.launch(kBrowser);
  page = await browser.newPage({viewport: {width: 1280, height: 800}});
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.goto(`http://localhost:${port}/`);
  await page.waitForFunction(() => document.getElementById('link').dataset.state === 'live');
});

after(async () => {
  await browser?.close();
  await programs?.stop();
});

test('a service that hangs is not shown as live, and not told anything', async () => {
  service.kill('SIGSTOP');
  await page.waitForFunction(() => document.getElementById('link').dataset.state === 'lost');
  assert.equal(await page.locator('#link-text').textContent(), 'no word from the service');
  assert.equal(await page.evaluate(() => window.qwsm.connection.prepare('/qwsm/marks', 'qwsm_msgs/msg/Mark')), false);
  await page.evaluate(() => window.qwsm.actions.mark('victim', 1, 2));
  await page.keyboard.type('Anna');
  await page.keyboard.press('Enter');
  await page.locator('#mark-trouble').waitFor();
  assert.equal(await page.locator('#mark-text').inputValue(), 'Anna', 'what was typed is still there');
  // As of a line that is dead: nobody answers that it is closed.
  const socket = await page.evaluateHandle(() => window.qwsm.connection.socket);
  await page.waitForFunction((old) => window.qwsm.connection.socket !== old, socket, {timeout: 60000});
  service.kill('SIGCONT');
  await page.waitForFunction(() => document.getElementById('link').dataset.state === 'live');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => [...window.qwsm.model.marks.values()].some(({text}) => text === 'Anna'));
  assert.ok(await page.locator('#mark-dialog').isHidden());
});

test('of a map whose service was started anew nothing of before is left', async () => {
  const {known, cells, relevant, path} = await page.evaluate(() => {
    const {model} = window.qwsm;
    const tile = (id, x) => model.take({id, topic: '/other/map_tiles', schemaName: 'qwsm_msgs/msg/MapTile'},
      {frame: 'map', generation: 1, resolution: 0.5, x, y: 0, width: 64, height: 64, runs: new Uint8Array(64).fill(0xbf)});
    const scan = (id, number) => model.take({id, topic: '/other/relevant_scans', schemaName: 'qwsm_msgs/msg/RelevantScan'},
      {origin: `of ${id}`, robot: 'robot_8', number, stamp: number, frame: 'map', pose: {x: 0, y: 0, theta: 0}, laser: {x: 0, y: 0, theta: 0},
        covariance: [], angleMin: 0, angleIncrement: 0.1, rangeMin: 0, rangeMax: 10, ranges: [1]});
    tile(1000001, 0);
    scan(1000002, 1);
    const [known] = [model.maps.get('/other/map_tiles').bounds];
    tile(1000003, 3200);
    tile(1000003, 3232);
    scan(1000004, 2);
    scan(1000004, 3);
    const robot = model.robots.get('robot_8');
    const found = {known, cells: model.maps.get('/other/map_tiles').bounds, relevant: [...model.relevant.values()].filter(({stamp}) => stamp <= 3).length, path: robot.relevant.length};
    model.beginSession();
    model.robots.delete('robot_8');
    return found;
  });
  assert.deepEqual({known, cells}, {known: {left: 0, bottom: 0, right: 32, top: 32}, cells: {left: 3200, bottom: 0, right: 3264, top: 32}});
  assert.deepEqual({relevant, path}, {relevant: 2, path: 2});
});

test('a scan is drawn from where its laser sits, over any number of steps', async () => {
  const points = await page.evaluate(() => {
    const {model} = window.qwsm;
    const transform = (frame, child, x, y, theta) => ({frame, child, x, y, theta});
    model.take({id: 1, topic: '/tf_static', schemaName: 'tf2_msgs/msg/TFMessage'},
      [transform('robot_7/base_link', 'robot_7/mast', 0.5, 0, Math.PI / 2), transform('robot_7/mast', 'robot_7/laser', 0.25, 0, 0),
        transform('robot_7/odd', 'robot_7/even', 0, 0, 0), transform('robot_7/even', 'robot_7/odd', 0, 0, 0)], {});
    model.take({id: 2, topic: '/robot_7/match_report', schemaName: 'qwsm_msgs/msg/MatchReport'},
      {robot: 'robot_7', frame: 'map', stamp: 5, pose: {x: 10, y: 20, theta: 0}, covariance: new Float64Array(9), status: 1, reason: '', overlap: 1}, {published_ms: 0, told_ms: Date.now()});
    const scan = (frame) => {
      model.take({id: 3, topic: '/robot_7/scan', schemaName: 'sensor_msgs/msg/LaserScan'},
        {stamp: 5, frame, angleMin: 0, angleIncrement: 0.1, rangeMin: 0, rangeMax: 10, ranges: [2]}, {});
      return [...model.robots.get('robot_7').points];
    };
    const points = [scan('robot_7/laser'), scan('robot_7/base_link'), scan('robot_7/odd')];
    model.beginSession();
    model.robots.delete('robot_7');
    return points;
  });
  // Of the mast, turned left, 0.25 m farther on; of a circle, which nobody can follow, once round.
  assert.deepEqual(points, [[10.5, 22.25], [12, 20], [12, 20]]);
});

test('costs of navigation are no walls on the map', async () => {
  const costs = programs.publishLargeMap('/local_costmap/costmap');
  await page.waitForFunction(() => window.qwsm.connection.topics.has('/local_costmap/costmap_tiles'));
  const map = programs.publishLargeMap();
  await page.waitForFunction(() => window.qwsm.model.maps.has('/large/map_tiles'));
  assert.deepEqual(await page.evaluate(() => [...window.qwsm.model.maps.keys()]), ['/large/map_tiles']);
  for (const publisher of [costs, map]) publisher.kill('SIGKILL');
});

test('keys do what they say on a page just opened, with Caps Lock, and after a box or the time line was used', async () => {
  const other = await browser.newPage({viewport: {width: 1280, height: 800}});
  await other.goto(page.url());
  await other.waitForFunction(() => document.getElementById('link').dataset.state === 'live');
  const camera = () => other.evaluate(() => ({x: window.qwsm.view.camera.x, tool: window.qwsm.state.tool}));
  const before = await camera();
  await other.keyboard.press('ArrowRight');
  assert.ok((await camera()).x > before.x);
  await other.keyboard.press('M');
  assert.equal((await camera()).tool, 'measure');
  await other.keyboard.press('l');
  await other.locator('#layers input').first().click();
  await other.keyboard.press('v');
  assert.equal((await camera()).tool, 'look');
  await other.locator('#time-slider').focus();
  await other.keyboard.press('m');
  assert.equal((await camera()).tool, 'measure');
  const {x} = await camera();
  await other.keyboard.press('ArrowLeft');
  assert.equal((await camera()).x, x, 'arrows are the time line\'s');
  await other.close();
});

test('a long remark does not lie across the map', async () => {
  const words = await page.evaluate(async () => {
    const {wordsOf} = await import('/symbols.js');
    return ['Anna', 'x'.repeat(200), '👩‍🚒'.repeat(40)].map((text) => wordsOf({text}));
  });
  assert.equal(words[0], 'Anna');
  assert.equal(words[1], `${'x'.repeat(31)}…`);
  assert.ok(words[2].isWellFormed?.() ?? true);
  assert.ok([...words[2]].length <= 32);
});

test('robots of several kinds with one number are told apart', async () => {
  const labels = await page.evaluate(async () => {
    const {Model} = await import('/model.js');
    const labelsOf = (names) => {
      const model = new Model();
      for (const name of names) model.robot(name);
      return Object.fromEntries([...model.robots].map(([name, {label, isSecond}]) => [name, isSecond ? `(${label})` : label]));
    };
    return [['robot_1', 'robot_2'], ['spot1', 'husky1', 'husky2'], ['husky2', 'husky1', 'spot1'], ['rover_1', 'raptor_1'], ['alpha', 'beta_1'], ['', 'robot_1'], ['rover_9', 'spot_9'],
      ['team/rover_12', 'other/rover_12']].map(labelsOf);
  });
  assert.deepEqual(labels, [
    {robot_1: '1', robot_2: '2'}, {spot1: '(s1)', husky1: 'h1', husky2: '2'}, {husky2: '2', husky1: 'h1', spot1: '(s1)'},
    {rover_1: '(ro1)', raptor_1: 'ra1'}, {alpha: 'a', beta_1: '(b1)'}, {'': '1', robot_1: '(r1)'}, {rover_9: '(r9)', spot_9: 's9'},
    {'team/rover_12': 'rov12', 'other/rover_12': '(rov12)'},
  ]);
});

test('nothing went wrong in the page', () => assert.deepEqual(complaints, []));
