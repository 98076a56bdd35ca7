// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The page in Debian's chromium, with a service and four simulated robots behind it.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {after, before, test} from 'node:test';
import {chromium} from 'playwright-core';
import {freePort, kBrowser, Programs, until} from './programs.mjs';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let programs, browser, page, port, service;
const complaints = [];

// A correction makes a second map: the memory that a browser costs could not be told from it.
const kWithoutGraph = ['--set', 'graph.enabled=false'];

before(async () => {
  programs = new Programs();
  port = await freePort();
  service = await programs.serve(port, kWithoutGraph);
  programs.simulate('team', ['--duration', '300']);
  browser = await chromium.launch(kBrowser);
  // axe is a script of its own, which the page itself would not let in.
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, colorScheme: 'dark', bypassCSP: true});
  page = await context.newPage();
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.goto(`http://localhost:${port}/`);
});

after(async () => {
  await browser?.close();
  await programs?.stop();
});

const inPage = (ask) => page.evaluate(ask);
const untilInPage = (ask, what) => until(() => inPage(ask), what);

// In the dark and in the light, as the page is now.
async function assertAccessible(state) {
  await page.evaluate(kAxe);
  for (const theme of ['dark', 'light']) {
    await page.evaluate((name) => { document.documentElement.dataset.theme = name; }, theme);
    const {violations} = await inPage(() => window.axe.run(document));
    assert.deepEqual(violations.map(({id, nodes}) => [state, theme, id, nodes.map(({html}) => html)]), []);
  }
  await inPage(() => { document.documentElement.dataset.theme = window.qwsm.state.theme; });
}

test('four robots are on the map, with their state in words', async () => {
  await untilInPage(() => window.qwsm.model.robots.size === 4, 'four robots');
  await untilInPage(() => document.querySelectorAll('.robot').length === 4, 'four robots in the list');
  await untilInPage(() => [...document.querySelectorAll('.robot .state')].every((node) => node.textContent.startsWith('matched')), 'all are matched');
  await untilInPage(() => window.qwsm.model.maps.get('/map_tiles')?.chunks.size > 0, 'the map');
  assert.equal(await page.locator('#link').getAttribute('data-state'), 'live');
  // The scan of now lies on the map: most of it on what is drawn as a wall.
  await untilInPage(() => [...window.qwsm.model.robots.values()].every(({points}) => points?.length > 50), 'the scans of now');
});

test('nothing stands in the way of those who see or hear differently', async () => {
  await page.keyboard.press('l');
  await page.locator('.robot').first().click();
  await assertAccessible('layers and a chosen robot');
  await page.keyboard.press('l');
});

test('the map is zoomed, turned and shown whole again, and stays as it was left', async () => {
  const camera = () => inPage(() => ({...window.qwsm.view.camera}));
  const [px, py] = [500, 420];
  await page.mouse.move(px, py);
  // The map grows, and moves, until the wheel is turned.
  await inPage(() => addEventListener('wheel', ({offsetX, offsetY}) => { window.wheeled = window.qwsm.view.camera.toMap(offsetX, offsetY); }, {capture: true, once: true}));
  const {scale} = await camera();
  await page.mouse.wheel(0, -300);
  await until(async () => (await camera()).scale > 1.5 * scale, 'the map is enlarged');
  // What the pointer is at stays there, also when the page is brought up to date.
  await new Promise((resolve) => setTimeout(resolve, 600));
  const [nowX, nowY] = await inPage(() => window.qwsm.view.camera.planeToScreen(...window.wheeled));
  assert.ok(Math.hypot(nowX - px, nowY - py) < 3, `${nowX}, ${nowY}`);
  assert.match(await page.locator('#place-text').textContent(), /^-?\d+\.\d\d, -?\d+\.\d\d m$/);
  await page.locator('#map').focus();
  await page.keyboard.press('Shift+ArrowLeft');
  assert.ok((await camera()).turn > 0.2);
  await page.locator('#upright').click();
  await until(async () => (await camera()).turn === 0, 'the map is upright');
  await page.keyboard.press('f');
  await untilInPage(() => !window.qwsm.view.camera.isGliding, 'the map has come to rest');
  // The map may have grown meanwhile: its corners tell whether all of it is shown.
  await untilInPage(() => {
    const {camera} = window.qwsm.view, {left, right, bottom, top} = window.qwsm.view.bounds();
    const [x0, y0] = camera.planeToScreen(left, top), [x1, y1] = camera.planeToScreen(right, bottom);
    return x0 >= 0 && y0 >= 0 && x1 <= camera.width && y1 <= camera.height && Math.max(x1 - x0, y1 - y0) > 200;
  }, 'all is shown again');
});

test('what a frame encloses is enlarged, buttons zoom, and the address tells what is looked at', async () => {
  const camera = () => inPage(() => ({...window.qwsm.view.camera}));
  const untilAtRest = () => untilInPage(() => !window.qwsm.view.camera.isGliding, 'the map has come to rest');
  const {scale} = await camera();
  const [enclosedX, enclosedY] = await inPage(() => window.qwsm.view.camera.toMap(550, 420));
  await page.keyboard.down('Shift');
  await page.mouse.move(500, 380);
  await page.mouse.down();
  await page.mouse.move(600, 460, {steps: 3});
  await page.mouse.up();
  await page.keyboard.up('Shift');
  await untilAtRest();
  assert.ok((await camera()).scale > 3 * scale);
  const [nowX, nowY] = await page.evaluate((place) => window.qwsm.view.camera.planeToScreen(...place), [enclosedX, enclosedY]);
  assert.ok(nowX > 300 && nowX < 800 && nowY > 250 && nowY < 500, `${nowX}, ${nowY} is not where nothing lies over the map`);
  const enlarged = (await camera()).scale;
  await page.locator('#zoom-out').click();
  await untilAtRest();
  assert.ok(Math.abs((await camera()).scale * 1.5 / enlarged - 1) < 1e-6);
  const isTold = () => Math.abs(Number(location.hash.split('/')[2]) / window.qwsm.view.camera.scale - 1) < 1e-3;
  await untilInPage(isTold, 'the address tells what is looked at');
  const left = await camera();
  const other = await page.context().newPage();
  await other.goto(page.url());
  await other.waitForFunction(() => window.qwsm?.view.frames > 0 && !window.qwsm.view.camera.isGliding);
  const met = await other.evaluate(() => ({...window.qwsm.view.camera}));
  await other.close();
  assert.ok(Math.hypot(met.x - left.x, met.y - left.y) < 0.01 && Math.abs(met.scale / left.scale - 1) < 1e-3);
  await page.locator('#map').focus();
  await page.keyboard.press('f');
  await untilInPage(() => location.hash === '', 'all is shown, and no place is told');
  await untilAtRest();
});

test('a map that is pushed goes on, and one that rests under the hand does not', async () => {
  const drag = (rest_ms) => page.evaluate(async (wait_ms) => {
    const {view} = window.qwsm;
    // At the times of a hand, however busy the computer is.
    const at = (type, x, timeStamp) => view.canvas.dispatchEvent(Object.defineProperty(
      new PointerEvent(type, {pointerId: 1, clientX: x, clientY: 420, button: 0}), 'timeStamp', {value: timeStamp}));
    view.canvas.setPointerCapture = () => {};  // Of a hand that is not there.
    at('pointerdown', 400, 0);
    for (let step = 1; step <= 5; ++step) at('pointermove', 400 + 20 * step, 10 * step);
    at('pointerup', 500, 50 + wait_ms);
    const released = view.camera.x;
    while (view.camera.isGliding) await new Promise(requestAnimationFrame);
    delete view.canvas.setPointerCapture;
    return view.camera.scale * (released - view.camera.x);
  }, rest_ms);
  const pushed_px = await drag(0);
  assert.ok(pushed_px > 20, `${pushed_px} px`);
  assert.equal(await drag(300), 0);
  await page.locator('#fit').click();
});

test('on small screens no tool is hidden below something else', async () => {
  for (const [width, height] of [[1024, 600], [390, 844], [820, 1180], [390, 660], [360, 560], [740, 340], [1280, 420]]) {
    const small = await browser.newPage({viewport: {width, height}});
    await small.goto(`http://localhost:${port}/`);
    await small.waitForFunction(() => document.querySelectorAll('.robot').length === 4);
    await small.evaluate(() => { for (const id of ['upright', 'side']) document.getElementById(id).hidden = false; });
    const hidden = await small.evaluate(() => [...document.querySelectorAll('#tools button')].filter((button) => {
      const {left, top, width, height} = button.getBoundingClientRect();
      return width > 0 && document.elementFromPoint(left + width / 2, top + height / 2)?.closest('button') !== button;
    }).map(({title}) => title));
    assert.deepEqual(hidden, [], `${width} x ${height}`);
    assert.ok(await small.locator('#scale-bar').isVisible());
    await small.keyboard.press('l');
    for (const box of await small.locator('#layers input').all()) await box.click({timeout: 2000});
    await small.evaluate(() => window.qwsm.actions.showRobot('robot_1'));
    await small.keyboard.press('f');
    await small.waitForFunction(() => !window.qwsm.view.camera.isGliding);
    const isFilled = await small.evaluate(() => {
      const {camera} = window.qwsm.view, {left, right} = window.qwsm.view.bounds();
      return (right - left) * camera.scale > 0.2 * camera.width;
    });
    assert.ok(isFilled, `the map can be seen on ${width} x ${height}`);
    await small.close();
  }
});

test('two fingers that zoom place no robot', async () => {
  const context = await browser.newContext({viewport: {width: 820, height: 1180}, hasTouch: true, deviceScaleFactor: 2});
  const tablet = await context.newPage();
  await tablet.goto(`http://localhost:${port}/`);
  await tablet.waitForFunction(() => window.qwsm?.model.robots.size === 4 && window.qwsm.view.bounds());
  await tablet.evaluate(() => {
    window.qwsm.actions.place('robot_1', null);
    window.told = 0;
    window.qwsm.connection.publish = () => { ++window.told; return true; };
  });
  const {scale, tool} = await tablet.evaluate(() => ({scale: window.qwsm.view.camera.scale, tool: window.qwsm.state.tool}));
  assert.equal(tool, 'start');
  const session = await context.newCDPSession(tablet);
  const touch = (type, ...xs) => session.send('Input.dispatchTouchEvent', {type, touchPoints: xs.map((x, id) => ({x, y: 400, id}))});
  await touch('touchStart', 380);
  await touch('touchStart', 380, 440);
  for (const off of [20, 40, 60]) await touch('touchMove', 380 - off, 440 + off);
  await touch('touchEnd');
  await tablet.waitForFunction((before) => window.qwsm.view.camera.scale > 1.5 * before, scale);
  assert.equal(await tablet.evaluate(() => window.told), 0);
  await context.close();
});

test('dragging says where a robot is', async () => {
  await inPage(() => { window.qwsm.state.selected = 'robot_1'; });
  await page.locator('[data-tool="start"]').click();
  const {from, reports, contradicted} = await inPage(() => {
    const {view, model} = window.qwsm;
    const robot = model.robots.get('robot_1');
    const {x, y} = robot.last;
    const place = {x: x + (x > view.camera.x ? -5 : 5), y};
    return {from: view.camera.toScreen(place.x, place.y), reports: robot.history.length, contradicted: Number(robot.counts.contradicted_poses)};
  });
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0], from[1] - 60, {steps: 4});
  await page.mouse.up();
  // The service puts that to a trial: the robot jumps there, or as far as its scans agree with a room that is alike,
  // or they contradict.
  await until(() => page.evaluate(([since, before]) => {
    const {history, counts} = window.qwsm.model.robots.get('robot_1');
    const jumps = history.some((pose, i) => i >= since && Math.hypot(pose.x - history[i - 1].x, pose.y - history[i - 1].y) > 1);
    return jumps || Number(counts.contradicted_poses) > before;
  }, [reports, contradicted]), 'the service has heard of it');
});

test('a victim is marked, and known to the service', async () => {
  await page.locator('#map').focus();
  await page.keyboard.press('1');
  await page.mouse.click(500, 300);
  await page.locator('#mark-text').fill('Anna, awake');
  await page.keyboard.press('Enter');
  await untilInPage(() => [...window.qwsm.model.marks.values()].some(({text, kind}) => text === 'Anna, awake' && kind === 'victim'), 'the mark has come back');
  await untilInPage(() => document.getElementById('marks').textContent.includes('Victim: Anna, awake'), 'the mark is in the list');
});

test('without a pointer, a hazard is marked in the middle of the map, and removed', async () => {
  await page.locator('#map').focus();
  await page.keyboard.press('2');
  await page.keyboard.press('Enter');
  await page.locator('#mark-text').fill('gas');
  await page.keyboard.press('Enter');
  await untilInPage(() => [...window.qwsm.model.marks.values()].some(({text}) => text === 'gas'), 'the mark has come back');
  const {off, id} = await inPage(() => {
    const {camera} = window.qwsm.view;
    const {x, y, id} = [...window.qwsm.model.marks.values()].find(({text}) => text === 'gas');
    return {off: Math.hypot(x - camera.x, y - camera.y), id};
  });
  assert.ok(off < 1e-6);
  await page.evaluate((mark) => window.qwsm.actions.editMark(mark), id);
  await assertAccessible('a dialog');
  await page.locator('#mark-remove').click();
  await untilInPage(() => document.querySelectorAll('.mark').length === 1, 'one mark is left');
});

test('the page comes back with the service after kill -9', async () => {
  service.kill('SIGKILL');
  await service.ended;
  await untilInPage(() => document.getElementById('link').dataset.state === 'lost', 'the page says that the service is gone');
  await untilInPage(() => document.querySelectorAll('.robot[data-level="2"]').length === 4, 'all are told to be silent');
  await assertAccessible('no service, silent robots');
  service = await programs.serve(port, kWithoutGraph);
  await untilInPage(() => document.getElementById('link').dataset.state === 'live', 'the page is live again');
  await untilInPage(() => document.querySelectorAll('.mark').length === 1, 'the mark is there again');
  await untilInPage(() => window.qwsm.model.maps.get('/map_tiles')?.chunks.size > 0, 'the map is there again');
  await untilInPage(() => [...window.qwsm.model.robots.values()].every((robot) => Date.now() - robot.arrived_ms < 1000), 'all robots are answered again');
});

test('the time line goes back to what the journal holds', async () => {
  await page.locator('#time-slider').focus();
  await page.keyboard.press('PageDown');
  await untilInPage(() => window.qwsm.model.relevant.size > 10, 'relevant scans of before');
  await page.keyboard.press('PageDown');
  assert.ok(await inPage(() => window.qwsm.state.shownStamp < window.qwsm.model.span.last));
  assert.match(await page.locator('#time-text').textContent(), / ago$/);
  await assertAccessible('looking back');
  await page.keyboard.press('End');
  await page.locator('#live').click();
  assert.equal(await inPage(() => window.qwsm.state.shownStamp), null);
});

test('what is seen is drawn at once', async (t) => {
  await inPage(() => { window.qwsm.model.latencies_ms.length = 0; window.qwsm.view.frames = 0; });
  await new Promise((resolve) => setTimeout(resolve, 3000));
  const {frames, latencies} = await inPage(() => ({frames: window.qwsm.view.frames, latencies: [...window.qwsm.model.latencies_ms].sort((a, b) => a - b)}));
  t.diagnostic(`${(frames / 3).toFixed(0)} frames/s, publication to screen ${latencies[latencies.length >> 1].toFixed(0)} ms in the median, ${latencies[Math.floor(latencies.length * 0.99)].toFixed(0)} ms p99`);
  assert.ok(latencies.length > 30 && frames > 9);
});

test('a correction of the map takes along what lies on it, and is shown before and after', async () => {
  const {before, after, text} = await inPage(() => {
    const {model} = window.qwsm;
    const robot = model.robots.get('robot_2');
    const {x, y} = robot.trail[0];
    const moved = {origin: 'test', robot: 'robot_2', number: 1, frameBefore: 'map', frame: 'map', before: {x, y, theta: 0}, pose: {x: x + 2, y, theta: 0}};
    const last = model.epoch;
    model.take({topic: '/map_epoch', schemaName: 'qwsm_msgs/msg/MapEpoch'},
      {stamp: model.now, origin: 'test', number: (last?.number ?? 0) + 1, robots: [], scans: [moved]}, {published_ms: Infinity, told_ms: Date.now()});
    return {before: x, after: robot.trail[0].x, text: model.events[0].text};
  });
  assert.ok(Math.abs(after - before - 2) < 1e-9);
  assert.equal(text, 'the map was corrected: 1 of 1 scans moved, by 2.0 m at most');
  await page.locator('.events button').first().click();
  assert.ok(await inPage(() => window.qwsm.state.shownEvent?.moves.length === 1));
  await page.locator('.events button').first().click();
  assert.equal(await inPage(() => window.qwsm.state.shownEvent), null);
});

test('a robot in a map of its own is not drawn in the team\'s until it is found there', async () => {
  const {apart, drawn, joined, found, text} = await inPage(() => {
    const {model} = window.qwsm;
    const report = (frame) => model.take({topic: '/robot_9/match_report', schemaName: 'qwsm_msgs/msg/MatchReport'},
      {robot: 'robot_9', frame, stamp: model.now, pose: {x: 1, y: 2, theta: 0}, covariance: new Float64Array(9), status: 1, reason: '', overlap: 1}, {published_ms: 0, told_ms: Date.now()});
    const isDrawn = () => model.robotsInMap().some(({name}) => name === 'robot_9');
    report('map_robot_9');
    const drawn = isDrawn();
    const robot = model.robots.get('robot_9');
    const apart = robot.isApart;
    const moved = {origin: 'test', robot: 'robot_9', number: 1, frameBefore: 'map_robot_9', frame: 'map', before: {x: 0, y: 0, theta: 0}, pose: {x: 10, y: 0, theta: 0}};
    model.take({topic: '/map_epoch', schemaName: 'qwsm_msgs/msg/MapEpoch'},
      {stamp: model.now, origin: 'test', number: model.epoch.number + 1, robots: [], scans: [moved]}, {published_ms: Infinity, told_ms: Date.now()});
    const [joined, found, text] = [isDrawn(), robot.last.x, model.events[0].text];
    model.robots.delete('robot_9');
    return {apart, drawn, joined, found, text};
  });
  assert.deepEqual({apart, drawn, joined, found}, {apart: true, drawn: false, joined: true, found: 11});
  assert.equal(text, 'map_robot_9 was found in map: they are one map now');
});

test('whoever comes late sees the whole map about as soon as a small one', async (t) => {
  const kTiles = 32 * 32;
  const publisher = programs.publishLargeMap();
  const tilesOf = () => window.qwsm.model.maps.get('/large/map_tiles')?.tiles.size ?? 0;
  await until(async () => await inPage(tilesOf) === kTiles, 'the map is in the first page');
  const late = await browser.newPage();
  await late.addInitScript(([tiles]) => {
    const tilesOf = (topic) => window.qwsm?.model.maps.get(topic)?.tiles.size ?? 0;
    const look = () => {
      if (tilesOf('/map_tiles') > 0) window.small_ms ??= performance.now();
      if (tilesOf('/large/map_tiles') === tiles) window.drawn_ms = performance.now();
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  }, [kTiles]);
  await late.goto(`http://localhost:${port}/`);
  await late.waitForFunction(() => window.drawn_ms > 0 && window.small_ms > 0);
  const {drawn_ms, small_ms} = await late.evaluate(() => ({drawn_ms: window.drawn_ms, small_ms: window.small_ms}));
  t.diagnostic(`${drawn_ms.toFixed(0)} ms after the page was asked for, the robots' own map after ${small_ms.toFixed(0)} ms`);
  assert.ok(drawn_ms < 10 * small_ms);
  await late.close();
  publisher.kill('SIGKILL');
});

// How old poses are when they are drawn, in the median of some time, and how many they are.
async function latencyDuring(rest_ms) {
  await inPage(() => { window.qwsm.model.latencies_ms.length = 0; });
  await new Promise((resolve) => setTimeout(resolve, rest_ms));
  const latencies = await inPage(() => [...window.qwsm.model.latencies_ms].sort((a, b) => a - b));
  return {poses: latencies.length, median_ms: latencies[latencies.length >> 1]};
}

test('a browser that hangs holds nobody up, and comes back', async (t) => {
  const usual = await latencyDuring(2000);
  const server = await chromium.launchServer(kBrowser);
  t.after(() => server.kill());
  const other = await chromium.connect(server.wsEndpoint());
  const hanging = await other.newPage();
  await hanging.goto(`http://localhost:${port}/`);
  await hanging.waitForFunction(() => window.qwsm.model.robots.size === 4);
  const group = -server.process().pid;
  process.kill(group, 'SIGSTOP');
  const before = programs.memory_kB(service);
  const beside = await latencyDuring(4000);
  const grown_kB = programs.memory_kB(service) - before;
  process.kill(group, 'SIGCONT');
  t.diagnostic(`beside it ${beside.poses} poses, in the median ${beside.median_ms.toFixed(0)} ms old, ${usual.median_ms.toFixed(0)} ms without it; the service grew by ${grown_kB} kB`);
  assert.ok(beside.poses > 50 && beside.median_ms < 10 * usual.median_ms);
  assert.ok(grown_kB < 8192, `the service grew by ${grown_kB} kB`);
  await hanging.waitForFunction(() => [...window.qwsm.model.robots.values()].every((robot) => Date.now() - robot.arrived_ms < 2000));
  await other.close();
});

test('whoever comes after a drive in space sees the model, the way and where the robot is now', async () => {
  const otherPort = await freePort();
  const {serving, replayed} = programs.driveInSpace(otherPort);
  await until(() => serving.said.includes('look at'), 'the service in space tells its address');
  await replayed();
  const late = await browser.newPage({viewport: {width: 1280, height: 800}});
  await late.goto(`http://localhost:${otherPort}/`);
  await late.waitForFunction(() => window.qwsm.model.clouds.get('/mole/cloud_map')?.length > 3000 && window.qwsm.model.robots.get('mole')?.history.length === 5);
  const {trail, off, side} = await late.evaluate(() => {
    const {model, view} = window.qwsm;
    const {trail, last} = model.robots.get('mole');
    document.getElementById('side').click();
    return {trail: trail.length, off: Math.hypot(last.x - trail.at(-1).x, last.y - trail.at(-1).y), side: view.camera.from};
  });
  assert.deepEqual({trail, side}, {trail: 5, side: 'south'});
  assert.ok(off < 0.01, 'the robot is at the end of its way');
  await late.close();
  serving.kill('SIGKILL');
});

test('the page is encrypted where the service has a certificate', async () => {
  const otherPort = await freePort();
  const certificate = await programs.certificate();
  const encrypted = await programs.serve(otherPort, [...certificate, '--set', 'view.token=open-sesame'], 'encrypted.db');
  assert.match(encrypted.said, /look at https:\/\/localhost:/);
  const context = await browser.newContext({ignoreHTTPSErrors: true});
  const other = await context.newPage();
  await other.goto(`https://localhost:${otherPort}/?token=open-sesame`);
  await other.waitForFunction(() => document.getElementById('link').dataset.state === 'live' && window.qwsm.model.robots.size === 4);
  await context.close();
  encrypted.kill('SIGKILL');
});

test('nothing went wrong in the page', () => assert.deepEqual(complaints, []));
