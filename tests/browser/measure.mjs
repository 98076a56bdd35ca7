// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the live page costs and how fast it is: node tests/browser/measure.mjs [SECONDS [ROBOTS [WHAT]]]
// Needs build/release/bin/qwsm and build/release/bench/team_load, which plays the robots at 10 Hz.
//   live    one page in chromium: frames/s, publication to screen
//   cost    scan to pose without and with four who look on as pages do, in turns of 5 s; best with 200 SECONDS
//   late    from asking for a page until a map of 100 x 100 m at 5 cm is in it and drawn, of SECONDS pages
//   idle    what a page is sent while robots stand, when they are silent; without a page's choice, while they drive
import {spawn} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {getPriority, setPriority} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {chromium} from 'playwright-core';
import protocol from '@foxglove/ws-protocol';
import WebSocket from 'ws';
import {freePort, Programs} from './programs.mjs';

const [seconds = '20', robots = '16', only] = process.argv.slice(2);
const kTeamLoad = fileURLToPath(new URL('../../build/release/bench/team_load', import.meta.url));
const kPageTopics = /match_report$|\/scan$|_tiles$|tf_static$|diagnostics$|marks$/;
const kBrowserArguments = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const sleep = (s) => new Promise((resolve) => setTimeout(resolve, 1000 * s));

// Robots that drive; what team_load says in the end.
function drive(programs, file = '/dev/null', duration_s = seconds) {
  const child = spawn(kTeamLoad, [programs.tag, robots, '10', duration_s, '1', file]);
  let said = '';
  child.stdout.on('data', (data) => { said += data; });
  child.stderr.on('data', (data) => { said += data; });
  return new Promise((resolve) => child.on('exit', () => resolve(said)));
}

// Somebody who looks on as the page does, but draws nothing.
class Onlooker {
  constructor(port, newsOnly = true) {
    this.bytes = 0;
    const socket = new WebSocket(`ws://localhost:${port}/ws`, ['foxglove.websocket.v1']);
    socket.on('message', (data) => { this.bytes += data.byteLength ?? data.length; });
    this.client = new protocol.FoxgloveClient({ws: socket});
    this.client.on('advertise', (channels) => {
      const subscriptions = channels.filter(({topic}) => kPageTopics.test(topic)).map(({id}) => ({id, channelId: id, newsOnly}));
      if (subscriptions.length > 0) socket.send(JSON.stringify({op: 'subscribe', subscriptions}));
    });
  }
  close() { this.client.close(); }
}

async function withService(measure) {
  const programs = new Programs();
  try {
    const port = await freePort();
    await programs.serve(port);
    return await measure(programs, port);
  } finally {
    await programs.stop();
  }
}

const quantile = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * share))];

async function measureLive() {
  await withService(async (programs, port) => {
    const browser = await chromium.launch({executablePath: process.env.QWSM_CHROMIUM ?? '/usr/bin/chromium', args: kBrowserArguments});
    const page = await browser.newPage({viewport: {width: 1440, height: 900}});
    await page.goto(`http://localhost:${port}/`);
    const driven = drive(programs);
    await page.waitForFunction((count) => window.qwsm.model.robots.size >= count, Number(robots));
    await sleep(3);
    await page.evaluate(() => { window.qwsm.model.latencies_ms.length = 0; window.qwsm.view.frames = 0; });
    const watched_s = Number(seconds) - 8;
    await sleep(watched_s);
    const {frames, latencies} = await page.evaluate(() => ({frames: window.qwsm.view.frames, latencies: window.qwsm.model.latencies_ms}));
    if (process.env.QWSM_PICTURE) await page.screenshot({path: process.env.QWSM_PICTURE});
    latencies.sort((a, b) => a - b);
    console.log(`live    ${robots} robots: ${(frames / watched_s).toFixed(1)} frames/s; publication to screen median ${quantile(latencies, 0.5).toFixed(0)} ms, p99 ${quantile(latencies, 0.99).toFixed(0)} ms, of ${latencies.length}`);
    await driven;
    await browser.close();
  });
}

// Until all tiles have come and the next frame is drawn.
async function measureLate() {
  const kTiles = 32 * 32;
  await withService(async (programs, port) => {
    programs.publishLargeMap();
    const browser = await chromium.launch({executablePath: process.env.QWSM_CHROMIUM ?? '/usr/bin/chromium', args: kBrowserArguments});
    const took_ms = [];
    for (let i = 0; i <= Number(seconds); ++i) {
      const page = await browser.newPage({viewport: {width: 1440, height: 900}});
      await page.addInitScript(([tiles]) => {
        const look = () => {
          requestAnimationFrame(look);
          const isThere = window.qwsm?.model.maps.get('/large/map_tiles')?.tiles.size === tiles;
          if (isThere && !window.drawn_ms) requestAnimationFrame(() => { window.drawn_ms ??= performance.now(); });
        };
        requestAnimationFrame(look);
      }, [kTiles]);
      await page.goto(`http://localhost:${port}/`);
      await page.waitForFunction(() => window.drawn_ms > 0);
      if (i > 0) took_ms.push(await page.evaluate(() => window.drawn_ms));  // Before the first, the map has to be made.
      await page.close();
    }
    took_ms.sort((a, b) => a - b);
    console.log(`late    the whole map is drawn after ${quantile(took_ms, 0.5).toFixed(0)} ms in the median, ${took_ms.at(-1).toFixed(0)} ms at most, of ${took_ms.length} pages`);
    await browser.close();
  });
}

// Four look on for some seconds, then nobody, in turns within one drive: what else the computer does
// comes to both alike. Which of a round is first changes.
const kTurn_s = 5;
const kSettle_s = 0.5;

async function measureCost() {
  setPriority(getPriority() + 10);  // Who looks on is on another computer, as a rule.
  const rounds = Math.max(2, Math.floor((Number(seconds) - 4) / (2 * kTurn_s)));
  await withService(async (programs, port) => {
    const file = join(programs.folder, 'answers');
    const driven = drive(programs, file, 2 * kTurn_s * rounds + 4);
    await sleep(4);
    const turns = [];
    for (let round = 0; round < rounds; ++round) {
      for (const isWatched of round % 2 === 0 ? [false, true] : [true, false]) {
        const looking = isWatched ? [1, 2, 3, 4].map(() => new Onlooker(port)) : [];
        await sleep(kSettle_s);
        const begin = Date.now(), busy_ms = programs.cpuTime_ms(0);
        await sleep(kTurn_s - kSettle_s);
        turns.push({round, isWatched, begin, end: Date.now(), share: (programs.cpuTime_ms(0) - busy_ms) / (Date.now() - begin)});
        for (const one of looking) one.close();
      }
    }
    await driven;
    tellCost(turns, readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(' ').map(Number)));
  });
}

function tellCost(turns, answers) {
  for (const turn of turns) turn.latencies = answers.filter(([heard]) => heard > turn.begin && heard < turn.end).map(([, , latency]) => latency);
  const p99 = (chosen) => quantile(chosen.flatMap(({latencies}) => latencies).sort((a, b) => a - b), 0.99);
  const ofRounds = (rounds) => [false, true].map((isWatched) => p99(rounds.flatMap((round) => turns.filter((turn) => turn.round === round && turn.isWatched === isWatched))));
  const rounds = [...new Set(turns.map(({round}) => round))];
  const [alone, watched] = ofRounds(rounds);
  // How far chance goes: rounds drawn again and again.
  const ratios = Array.from({length: 1000}, () => {
    const [without, withFour] = ofRounds(rounds.map(() => rounds[Math.floor(Math.random() * rounds.length)]));
    return withFour / without;
  }).sort((a, b) => a - b);
  const share = (isWatched) => { const chosen = turns.filter((turn) => turn.isWatched === isWatched); return (chosen.reduce((sum, turn) => sum + turn.share, 0) / chosen.length).toFixed(3); };
  console.log(`cost    p99 scan to pose: nobody looks on ${alone.toFixed(3)} ms, four ${watched.toFixed(3)} ms; ratio ${(watched / alone).toFixed(3)}, 95 % within ${quantile(ratios, 0.025).toFixed(3)} to ${quantile(ratios, 0.975).toFixed(3)}, of ${answers.length} answers in ${rounds.length} rounds`);
  console.log(`cost    processors busy with the service: ${share(false)}, ${share(true)}`);
}

// Robots that stand in a hall and go on scanning: whoever drives them has let go of the stick.
function standingTeam(folder) {
  writeFileSync(join(folder, 'still.commands'), '0 0 0\n600 0 0\n');
  const side = Math.ceil(Math.sqrt(Number(robots)));
  const wall = (x1, y1, x2, y2) => `    - {from_x_m: ${x1}, from_y_m: ${y1}, to_x_m: ${x2}, to_y_m: ${y2}}\n`;
  const team = Array.from({length: Number(robots)}, (_, i) => `  - name: robot_${i + 1}
    start_x_m: ${4 * (i % side)}
    start_y_m: ${3 * Math.floor(i / side)}
    laser: {rate_hz: 10, useful_range_m: 30}
    driver: {kind: recorded, command_log: still.commands}
`);
  const far = 4 * side, file = join(folder, 'standing.yaml');
  writeFileSync(file, `duration_s: 600\nscenery:\n  walls:\n${wall(-3, -3, far, -3)}${wall(far, -3, far, far)}${wall(far, far, -3, far)}${wall(-3, far, -3, -3)}robots:\n${team.join('')}`);
  return file;
}

async function measureIdle() {
  await withService(async (programs, port) => {
    const browser = await chromium.launch({executablePath: process.env.QWSM_CHROMIUM ?? '/usr/bin/chromium', args: kBrowserArguments});
    const page = await browser.newPage();
    await page.goto(`http://localhost:${port}/`);
    const kilobitsIn = async (s) => {
      const before = await page.evaluate(() => window.qwsm.connection.bytes);
      await sleep(s);
      return (8 * (await page.evaluate(() => window.qwsm.connection.bytes) - before) / s / 1000).toFixed(1);
    };
    const standing = programs.simulate(standingTeam(programs.folder));
    standing.ended.then(() => { if (standing.said) console.error(standing.said); });
    await page.waitForFunction((count) => [...window.qwsm.model.robots.values()].filter(({last}) => last).length >= count, Number(robots));
    await sleep(5);
    console.log(`idle    ${robots} robots stand and scan at 10 Hz: ${await kilobitsIn(12)} kbit/s`);
    if (process.env.QWSM_PICTURE) await page.screenshot({path: process.env.QWSM_PICTURE});
    standing.kill();
    await standing.ended;
    await sleep(6);
    console.log(`idle    when all are silent: ${await kilobitsIn(12)} kbit/s`);
    await browser.close();
  });
  await withService(async (programs, port) => {
    const looking = new Onlooker(port, false);
    const driven = drive(programs);
    await sleep(Number(seconds) / 2);
    const before = looking.bytes;
    await sleep(4);
    console.log(`idle    while ${robots} robots drive, to one who wants all of it: ${(8 * (looking.bytes - before) / 4000).toFixed(0)} kbit/s`);
    looking.close();
    await driven;
  });
}

const measurements = {live: measureLive, late: measureLate, cost: measureCost, idle: measureIdle};
for (const [name, measure] of Object.entries(measurements)) {
  if (!only || only === name) await measure();
}
