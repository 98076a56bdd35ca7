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
  // As of a line that is dead: nobody answers that it is closed.
  const socket = await page.evaluateHandle(() => window.qwsm.connection.socket);
  await page.waitForFunction((old) => window.qwsm.connection.socket !== old, socket);
  service.kill('SIGCONT');
  await page.waitForFunction(() => document.getElementById('link').dataset.state === 'live');
});

test('nothing went wrong in the page', () => assert.deepEqual(complaints, []));
