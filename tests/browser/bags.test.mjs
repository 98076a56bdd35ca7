// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bags that are written by qwsm, read by readers of others: @mcap/core and @foxglove/rosbag2-web.
import assert from 'node:assert/strict';
import {open, readFile} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {test} from 'node:test';
import * as mcap from '@mcap/core';
import rosbag2 from '@foxglove/rosbag2-web';
import rosmsg from '@foxglove/rosmsg';
import serialization from '@foxglove/rosmsg2-serialization';
import zstd from '@foxglove/wasm-zstd';
import {Programs, until} from './programs.mjs';

const kDriveTypes = {
  '/scan': 'sensor_msgs/msg/LaserScan', '/odom': 'nav_msgs/msg/Odometry', '/tf': 'tf2_msgs/msg/TFMessage',
  '/tf_static': 'tf2_msgs/msg/TFMessage', '/ground_truth': 'nav_msgs/msg/Odometry',
};
const kAnswerTypes = {
  '/pose': 'geometry_msgs/msg/PoseWithCovarianceStamped', '/tf': 'tf2_msgs/msg/TFMessage',
  '/map': 'nav_msgs/msg/OccupancyGrid',
};

// What a service and a robot say between them.
const kLiveTypes = {
  '/robot/scan': 'sensor_msgs/msg/LaserScan', '/robot/odom': 'nav_msgs/msg/Odometry', '/robot/ground_truth': 'nav_msgs/msg/Odometry',
  '/robot/pose': 'geometry_msgs/msg/PoseWithCovarianceStamped', '/robot/match_report': 'qwsm_msgs/msg/MatchReport',
  '/robot/odometry/matched': 'nav_msgs/msg/Odometry', '/tf': 'tf2_msgs/msg/TFMessage', '/tf_static': 'tf2_msgs/msg/TFMessage',
  '/map': 'nav_msgs/msg/OccupancyGrid', '/diagnostics': 'diagnostic_msgs/msg/DiagnosticArray', '/qwsm/relevant_scans': 'qwsm_msgs/msg/RelevantScan',
};

// All messages of an MCAP file by topic, unpacked by the definitions in it.
async function readMcap(path) {
  await zstd.isLoaded;
  const file = await open(path);
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, size) => {
      const bytes = new Uint8Array(Number(size));
      await file.read(bytes, 0, bytes.length, Number(offset));
      return bytes;
    },
  };
  const decompressHandlers = {zstd: (bytes, size) => zstd.decompress(bytes, Number(size))};
  const reader = await mcap.McapIndexedReader.Initialize({readable, decompressHandlers});
  const readers = new Map();
  for (const schema of reader.schemasById.values()) {
    assert.equal(schema.encoding, 'ros2msg');
    const definition = rosmsg.parse(new TextDecoder().decode(schema.data), {ros2: true});
    readers.set(schema.id, new serialization.MessageReader(definition));
  }
  const bag = {types: {}, messages: {}, count: Number(reader.statistics.messageCount)};
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    bag.types[channel.topic] = reader.schemasById.get(channel.schemaId).name;
    const unpacked = readers.get(channel.schemaId).readMessage(message.data);
    (bag.messages[channel.topic] ??= []).push(unpacked);
  }
  await file.close();
  return bag;
}

// The same of a database, unpacked by the definitions that the reader itself brings.
async function readDb3(path) {
  // A page would fetch it.
  const wasmBinary = await readFile(createRequire(import.meta.url).resolve('@foxglove/sql.js/dist/sql-wasm.wasm'));
  await rosbag2.SqliteSqljs.Initialize({wasmBinary});
  globalThis.File ??= (await import('node:buffer')).File;  // Not there in Debian's node.
  const bag = new rosbag2.Rosbag2([new rosbag2.SqliteSqljs(new Uint8Array(await readFile(path)))]);
  await bag.open();
  const types = Object.fromEntries((await bag.readTopics()).map(({name, type}) => [name, type]));
  const counts = await bag.messageCounts();
  const messages = {};
  for await (const message of bag.readMessages()) {
    (messages[message.topic.name] ??= []).push(message.value);
  }
  await bag.close();
  return {types, messages, count: [...counts.values()].reduce((sum, count) => sum + count, 0)};
}

async function lastLineOf(path) {
  return (await readFile(path, 'utf8')).trimEnd().split('\n').at(-1);
}

async function run(programs, args) {
  const program = programs.start(args);
  assert.equal(await program.ended, 0, program.said);
}

test('bags are read by readers of others, message for message', async (t) => {
  const programs = new Programs();
  t.after(() => programs.stop());
  const inFolder = (name) => join(programs.folder, name);
  await run(programs, ['sim', 'corridor', '--duration', '20', '--output', inFolder('drive'), '--quiet']);
  const log = inFolder('drive/robot.log');
  await run(programs, ['convert', log, '-o', inFolder('drive.mcap')]);
  await run(programs, ['convert', log, '--to', 'db3', '-o', inFolder('bag')]);

  const inMcap = await readMcap(inFolder('drive.mcap'));
  const inDb3 = await readDb3(inFolder('bag/bag_0.db3'));
  assert.deepEqual(inMcap.types, kDriveTypes);
  assert.deepEqual(inDb3.types, kDriveTypes);
  const all = Object.values(inMcap.messages).reduce((sum, messages) => sum + messages.length, 0);
  assert.equal(inMcap.count, all);
  assert.equal(inDb3.count, all);
  assert.deepEqual(inDb3.messages, inMcap.messages);
  assert.ok(inMcap.messages['/scan'].length > 100);
  assert.ok(inMcap.messages['/scan'].every(({ranges}) => ranges.length > 100 && ranges.some((range) => range > 0.1)));

  await run(programs, ['map', inFolder('drive.mcap'), '--bag', '--output', inFolder('mapped'), '--quiet']);
  const answers = await readMcap(inFolder('mapped/answers.mcap'));
  assert.deepEqual(answers.types, kAnswerTypes);
  assert.equal(answers.messages['/pose'].length, inMcap.messages['/scan'].length);
  const [, x, y] = (await lastLineOf(inFolder('mapped/trajectory.tum'))).split(' ').map(Number);
  const {position} = answers.messages['/pose'].at(-1).pose.pose;
  assert.ok(Math.abs(position.x - x) < 1e-6 && Math.abs(position.y - y) < 1e-6);
  const [map] = answers.messages['/map'];
  assert.equal(map.data.length, map.info.width * map.info.height);
});

test('all that is said on the network is recorded, each message with its definition', async (t) => {
  const programs = new Programs();
  t.after(() => programs.stop());
  const bag = join(programs.folder, 'live.mcap');
  const network = ['--set', 'network.interface=lo', '--set', `network.tag=${programs.tag}`];
  const recorder = programs.start(['record', bag, '--verbose', ...network]);
  await until(() => recorder.said.includes('recording'), 'the recorder listens');
  const service = programs.start(['serve', '--verbose', '--set', 'team.map_period_s=0.5', ...network]);
  await until(() => service.said.includes('serving as'), 'the service is there');
  const robot = programs.simulate('corridor', ['--duration', '4']);
  await robot.ended;
  await until(() => Object.keys(kLiveTypes).every((topic) => recorder.said.includes(`recording ${topic} `)),
    'a message of every topic').catch((error) => { throw new Error(`${error.message}; ${recorder.said}`); });
  recorder.kill('SIGINT');
  assert.equal(await recorder.ended, 0, recorder.said);

  const {types, messages, count} = await readMcap(bag);
  for (const [topic, type] of Object.entries(kLiveTypes)) assert.equal(types[topic], type, topic);
  assert.equal(count, Object.values(messages).reduce((sum, of) => sum + of.length, 0));
  assert.ok(messages['/robot/scan'].length > 10, `${messages['/robot/scan'].length} scans`);
  assert.ok(messages['/robot/match_report'].every(({robot: name}) => name === 'robot'));
});
