// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The programs of the project as processes, on a network of their own.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createServer} from 'node:net';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

const kPrograms = process.env.QWSM_PROGRAMS ?? fileURLToPath(new URL('../../build/release/bin', import.meta.url));

// How a browser is started.
export const kBrowser = {
  executablePath: process.env.QWSM_CHROMIUM ?? '/usr/bin/chromium',
  args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync'],
};

export async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const {port} = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

export class Programs {
  constructor() {
    this.tag = `browser-${process.pid}`;
    this.folder = mkdtempSync(join(tmpdir(), 'qwsm-browser-'));
    this.processes = [];
  }

  start(args, program = join(kPrograms, 'qwsm')) {
    const child = spawn(program, args, {stdio: ['ignore', 'pipe', 'pipe']});
    child.said = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => { child.said += data; });
    child.ended = new Promise((resolve) => child.on('exit', resolve));
    this.processes.push(child);
    return child;
  }

  // Starts a service with a page, and waits until it is there.
  async serve(port, more = [], journal = 'team.db') {
    const service = this.start(['serve', '--view', '--journal', join(this.folder, journal),
      '--set', `view.port=${port}`, '--set', 'team.map_period_s=1',
      '--set', 'network.interface=lo', '--set', `network.tag=${this.tag}`, ...more]);
    await until(() => service.said.includes('look at'), 'the service tells its address');
    return service;
  }

  // Processor time of a process so far, by the order in which they were started.
  cpuTime_ms(index) {
    const fields = readFileSync(`/proc/${this.processes[index].pid}/stat`, 'utf8').split(') ')[1].split(' ');
    const kTick_ms = 10;  // Of Linux, on all computers of today.
    return kTick_ms * (Number(fields[11]) + Number(fields[12]));
  }

  memory_kB(child) {
    return Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${child.pid}/status`, 'utf8'))[1]);
  }

  simulate(scenario, more = []) {
    return this.start(['sim', scenario, '--dds', '--quiet', '--output', join(this.folder, 'drive'), '--force',
      '--network', 'interface=lo', '--network', `tag=${this.tag}`, ...more]);
  }

  // A service for robots that scan in space, and one that drives by it: `replayed()` ends when it has.
  driveInSpace(port) {
    const slam6d = join(kPrograms, 'slam6d'), scans = join(this.folder, 'scans'), network = ['--set', 'network.interface=lo', '--set', `network.tag=${this.tag}-space`];
    const serving = this.start(['serve', '--view', '--set', `view.port=${port}`, ...network], slam6d);
    const replayed = async () => {
      await this.start(['sim', 'park', '--scans', '5', '--output', scans, '--set', 'sim.laser.beams=181', '--set', 'sim.laser.sweeps=180'], slam6d).ended;
      await this.start(['replay', scans, '--robot', 'mole', '--rate', 'max', ...network], slam6d).ended;
    };
    return {serving, replayed};
  }

  // Somebody who publishes a map of 100 x 100 m at 5 cm.
  publishLargeMap(topic = '/large/map') {
    return this.start([this.tag, topic], join(kPrograms, '..', 'tests', 'browser', 'large_map'));
  }

  // Settings of a service that encrypts, with a certificate that nobody vouches for.
  async certificate() {
    const name = join(this.folder, 'page');
    await this.start([name], join(kPrograms, '..', 'tests', 'browser', 'make_certificate')).ended;
    return ['--set', `view.certificate=${name}.pem`, '--set', `view.key=${name}.key`];
  }

  async stop() {
    for (const child of this.processes) child.kill('SIGKILL');
    await Promise.all(this.processes.map((child) => child.ended));
    rmSync(this.folder, {recursive: true, force: true});
  }
}

// Waits until something is so; what it is, stands in the error if it never is.
export async function until(isSo, what, timeout_ms = 20000) {
  const end = Date.now() + timeout_ms;
  while (!await isSo()) {
    if (Date.now() > end) throw new Error(`not in ${timeout_ms} ms: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}
