// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Motions in the plane, and the end points of scans.

export function compose(a, b) {
  const c = Math.cos(a.theta), s = Math.sin(a.theta);
  return {x: a.x + c * b.x - s * b.y, y: a.y + s * b.x + c * b.y, theta: a.theta + b.theta};
}

export function inverse(a) {
  const c = Math.cos(a.theta), s = Math.sin(a.theta);
  return {x: -c * a.x - s * a.y, y: s * a.x - c * a.y, theta: -a.theta};
}

// A point, or a pose, where a motion takes it.
export function move(motion, thing) {
  const {x, y, theta} = compose(motion, {x: thing.x, y: thing.y, theta: thing.theta ?? 0});
  return thing.theta === undefined ? {...thing, x, y} : {...thing, x, y, theta};
}

export function movePoints(motion, points) {
  const c = Math.cos(motion.theta), s = Math.sin(motion.theta);
  return points.map((_, i) => i % 2 === 0
    ? motion.x + c * points[i] - s * points[i + 1]
    : motion.y + s * points[i - 1] + c * points[i]);
}

// End points of a scan's beams, in the frame of the pose's parent, as x, y, x, y...
export function scanPoints(scan, sensor) {
  const points = [];
  for (let i = 0; i < scan.ranges.length; ++i) {
    const range = scan.ranges[i];
    if (!(range >= scan.rangeMin && range < scan.rangeMax)) continue;
    const bearing = sensor.theta + scan.angleMin + i * scan.angleIncrement;
    points.push(sensor.x + range * Math.cos(bearing), sensor.y + range * Math.sin(bearing));
  }
  return Float32Array.from(points);
}
