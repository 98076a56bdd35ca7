// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// An independent client of the Foxglove WebSocket protocol subscribes to everything, unpacks it by the
// definitions that are offered, and says where a robot is.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import rosmsg from '@foxglove/rosmsg';
import serialization from '@foxglove/rosmsg2-serialization';
import protocol from '@foxglove/ws-protocol';
import WebSocket from 'ws';
import {freePort, Programs, until} from './programs.mjs';

const kExpected = {
  '/robot_1/scan': 'sensor_msgs/msg/LaserScan', '/robot_1/odom': 'nav_msgs/msg/Odometry', '/robot_1/pose': 'geometry_msgs/msg/PoseWithCovarianceStamped',
  '/robot_1/odometry/matched': 'nav_msgs/msg/Odometry', '/robot_1/match_report': 'qwsm_msgs/msg/MatchReport', '/robot_1/ground_truth': 'nav_msgs/msg/Odometry',
  '/tf': 'tf2_msgs/msg/TFMessage', '/tf_static': 'tf2_msgs/msg/TFMessage', '/map': 'nav_msgs/msg/OccupancyGrid', '/map_tiles': 'qwsm_msgs/msg/MapTile',
  '/map_points': 'sensor_msgs/msg/PointCloud2', '/diagnostics': 'diagnostic_msgs/msg/DiagnosticArray', '/qwsm/relevant_scans': 'qwsm_msgs/msg/RelevantScan',
};

function definitionOf(channel) {
  return rosmsg.parse(channel.schema, {ros2: true});
}

test('a client of Foxglove gets everything that is published, and says where a robot is', async (t) => {
  const programs = new Programs();
  t.after(() => programs.stop());
  const port = await freePort();
  const service = await programs.serve(port);
  programs.simulate('team', ['--duration', '60']);

  const client = new protocol.FoxgloveClient({ws: new WebSocket(`ws://localhost:${port}/ws`, ['foxglove.websocket.v1'])});
  t.after(() => client.close());
  const channels = new Map();  // By topic.
  const bySubscription = new Map();
  const last = new Map();  // Newest message by topic.
  const errors = [];
  let time = 0n;
  client.on('error', (error) => errors.push(error));
  client.on('status', (status) => errors.push(status));
  client.on('time', ({timestamp}) => { time = timestamp; });
  client.on('advertise', (come) => {
    for (const channel of come) {
      channels.set(channel.topic, channel);
      const reader = new serialization.MessageReader(definitionOf(channel));
      bySubscription.set(client.subscribe(channel.id), {topic: channel.topic, reader});
    }
  });
  client.on('message', ({subscriptionId, data}) => {
    const {topic, reader} = bySubscription.get(subscriptionId);
    last.set(topic, reader.readMessage(data));
  });
  await until(() => Object.keys(kExpected).every((topic) => last.has(topic)), 'a message of every topic')
    .catch((error) => { throw new Error(`${error.message}; got ${[...last.keys()].join(' ')}; ${service.said}`); });

  for (const [topic, schema] of Object.entries(kExpected)) {
    assert.equal(channels.get(topic).schemaName, schema);
    assert.equal(channels.get(topic).encoding, 'cdr');
  }
  assert.ok(Math.abs(Number(time / 1000000n) - Date.now()) < 10000);
  const report = last.get('/robot_1/match_report');
  assert.equal(report.robot, 'robot_1');
  assert.ok(report.overlap > 0.3 && report.overlap <= 1, `overlap ${report.overlap}`);
  const scan = last.get('/robot_1/scan');
  assert.ok(scan.ranges.length > 100 && scan.header.frame_id === 'robot_1/laser');
  const map = last.get('/map');
  assert.equal(map.data.length, map.info.width * map.info.height);
  const tile = last.get('/map_tiles');
  assert.equal(tile.runs.reduce((cells, run) => cells + (run & 63) + 1, 0), tile.width * tile.height);
  assert.ok(last.get('/diagnostics').status.some(({name}) => name === 'qwsm: robot_1'));
  assert.ok(last.get('/tf').transforms.length > 0);

  // Foxglove advertises such topics as soon as it is connected.
  client.advertise({topic: '/move_base_simple/goal', encoding: 'cdr', schemaName: 'geometry_msgs/msg/PoseStamped'});
  const pose = channels.get('/robot_1/pose');
  const id = client.advertise({topic: '/robot_1/initialpose', encoding: 'cdr', schemaName: pose.schemaName});
  const writer = new serialization.MessageWriter(definitionOf(pose));
  const told = structuredClone(last.get('/robot_1/pose'));
  told.header.stamp = {sec: 0, nanosec: 0};
  told.pose.covariance = Array.from(told.pose.covariance);
  // Somewhere else: the service puts that to a trial, and says on /diagnostics that it was wrong.
  told.pose.pose.position.x += 1.5;
  client.sendMessage(id, writer.writeMessage(told));
  await until(() => {
    const values = last.get('/diagnostics').status.find(({name}) => name === 'qwsm: robot_1')?.values ?? [];
    return Number(values.find(({key}) => key === 'contradicted_poses')?.value) > 0;
  }, 'the service has put the told pose to a trial');
  assert.deepEqual(errors, []);
});
