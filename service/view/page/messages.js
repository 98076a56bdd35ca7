// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The messages of ROS and of ours that the page reads and writes (idl/), as plain objects.
import {CdrReader, CdrWriter} from './cdr.js';

const header = (r) => ({stamp: r.int32() + r.uint32() * 1e-9, frame: r.string()});
const yawOf = (z, w) => 2 * Math.atan2(z, w);

function pose2(r) {
  return {x: r.float64(), y: r.float64(), theta: r.float64()};
}

function transform(r) {
  const {stamp, frame} = header(r);
  const child = r.string();
  const [x, y] = r.float64s(3);
  const [, , qz, qw] = r.float64s(4);
  return {stamp, frame, child, x, y, theta: yawOf(qz, qw)};
}

// A cloud's points as x, y, z, x, y, z...; none where it has no coordinates of single precision.
function cloudPoints(fields, step, data, isLittle) {
  const kFloat32 = 7;
  const offsets = ['x', 'y', 'z'].map((axis) => fields.find(({name, type}) => name === axis && type === kFloat32)?.offset);
  if (offsets.includes(undefined) || step === 0) return new Float32Array(0);
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const points = new Float32Array(3 * Math.floor(data.byteLength / step));
  for (let i = 0; i < points.length; ++i) {
    points[i] = view.getFloat32(Math.floor(i / 3) * step + offsets[i % 3], isLittle);
  }
  return points;
}

const readers = {
  'qwsm_msgs/msg/MatchReport': (r) => ({
    ...header(r), robot: r.string(), pose: pose2(r), covariance: r.float64s(9), status: r.uint8(),
    reason: r.string(), relevant: r.uint8() !== 0, pairs: r.uint32(), iterations: r.uint32(),
    overlap: r.float64(), meanResidual: r.float64(), positionTrace: r.float64(),
    duration: r.float64(), latency: r.float64(), scans: r.uint64(), dropped: r.uint64(),
  }),
  'qwsm_msgs/msg/RegistrationReport': (r) => {
    const head = {...header(r), robot: r.string()};
    const [x, y, z] = r.float64s(3);
    const [, , qz, qw] = r.float64s(4);
    const c = r.float64s(36);
    const covariance = [c[0], c[1], c[5], c[6], c[7], c[11], c[30], c[31], c[35]];
    // Unusable scans are answered as badly matched ones are: by odometry.
    const status = [0, 1, 3, 3][r.uint8()];
    const reason = r.string();
    const [points, pairs, iterations] = [r.uint32(), r.uint32(), r.uint32()];
    const [overlap, meanResidual] = r.float64s(2);
    const loops = r.list(() => r.uint32());
    const [duration, latency] = r.float64s(2);
    return {...head, pose: {x, y, z, theta: yawOf(qz, qw)}, covariance, status, reason, points, pairs,
      iterations, overlap, meanResidual, loops, duration, latency, scans: r.uint64(), dropped: r.uint64()};
  },
  'sensor_msgs/msg/PointCloud2': (r) => {
    const head = {...header(r), height: r.uint32(), width: r.uint32()};
    const fields = r.list(() => ({name: r.string(), offset: r.uint32(), type: r.uint8(), count: r.uint32()}));
    const [isBigEndian, step] = [r.uint8() !== 0, r.uint32()];
    r.uint32();  // Bytes of a row: our clouds have one.
    const data = r.bytes(r.uint32());
    return {...head, points: cloudPoints(fields, step, data, !isBigEndian)};
  },
  'qwsm_msgs/msg/MapTile': (r) => {
    const head = header(r);
    const tile = {...head, generation: r.uint32(), resolution: r.float32(), x: r.float64(), y: r.float64(),
      width: r.uint32(), height: r.uint32()};
    return {...tile, runs: r.bytes(r.uint32())};
  },
  'qwsm_msgs/msg/RelevantScan': (r) => ({
    ...header(r), origin: r.string(), robot: r.string(), number: r.uint64(), pose: pose2(r),
    covariance: r.float64s(9), hasOdometry: r.uint8() !== 0, odometry: pose2(r), laser: pose2(r),
    angleMin: r.float32(), angleIncrement: r.float32(), rangeMin: r.float32(), rangeMax: r.float32(),
    ranges: r.float32s(),
  }),
  'sensor_msgs/msg/LaserScan': (r) => {
    const head = header(r);
    const [angleMin, , angleIncrement, , , rangeMin, rangeMax] = Array.from({length: 7}, () => r.float32());
    return {...head, angleMin, angleIncrement, rangeMin, rangeMax, ranges: r.float32s()};
  },
  'qwsm_msgs/msg/MapEpoch': (r) => ({
    ...header(r), origin: r.string(), number: r.uint64(),
    robots: r.list(() => ({robot: r.string(), frameBefore: r.string(), frame: r.string(), correction: pose2(r)})),
    scans: r.list(() => ({origin: r.string(), robot: r.string(), number: r.uint64(), frameBefore: r.string(), before: pose2(r),
      frame: r.string(), pose: pose2(r), covariance: r.float64s(9)})),
  }),
  'nav_msgs/msg/Odometry': (r) => {
    const head = header(r);
    r.string();  // The robot's frame.
    const [x, y] = r.float64s(3);
    const [, , qz, qw] = r.float64s(4);
    return {...head, pose: {x, y, theta: yawOf(qz, qw)}};
  },
  'nav_msgs/msg/Path': (r) => ({
    ...header(r),
    poses: r.list(() => {
      const {stamp} = header(r);
      const [x, y, z] = r.float64s(3);
      const [, , qz, qw] = r.float64s(4);
      return {stamp, x, y, z, theta: yawOf(qz, qw)};
    }),
  }),
  'tf2_msgs/msg/TFMessage': (r) => r.list(transform),
  'diagnostic_msgs/msg/DiagnosticArray': (r) => ({
    ...header(r),
    status: r.list(() => ({level: r.uint8(), name: r.string(), message: r.string(), hardware: r.string(),
      values: Object.fromEntries(r.list(() => [r.string(), r.string()]))})),
  }),
  'qwsm_msgs/msg/Mark': (r) => ({
    ...header(r), id: r.string(), kind: r.string(), text: r.string(), author: r.string(),
    x: r.float64(), y: r.float64(), removed: r.uint8() !== 0, number: r.uint32(), revision: r.uint64(),
  }),
};

export const decodes = (schema) => schema in readers;

export function decode(schema, view) {
  return readers[schema](new CdrReader(view));
}

function writeHeader(w, frame) {
  const now = Date.now();
  w.int32(Math.floor(now / 1000));
  w.uint32((now % 1000) * 1e6);
  w.string(frame);
}

// A start told by an operator: known to half a metre and a quarter of a radian.
export function encodeInitialPose({x, y, theta}) {
  const w = new CdrWriter();
  writeHeader(w, 'map');
  for (const value of [x, y, 0, 0, 0, Math.sin(theta / 2), Math.cos(theta / 2)]) w.float64(value);
  const variances = {0: 0.25, 7: 0.25, 35: 0.0685};
  for (let i = 0; i < 36; ++i) w.float64(variances[i] ?? 0);
  return w.bytes;
}

export function encodeMark(mark) {
  const w = new CdrWriter();
  writeHeader(w, 'map');
  for (const text of [mark.id, mark.kind, mark.text, mark.author]) w.string(text);
  w.float64(mark.x);
  w.float64(mark.y);
  w.uint8(mark.removed ? 1 : 0);
  // Number and anchor are the service's to give.
  w.uint32(0);
  w.uint64(0);
  w.uint8(0);
  w.string('');
  w.int32(0);
  w.uint32(0);
  w.float64(0);
  w.float64(0);
  return w.bytes;
}
