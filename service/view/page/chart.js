// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// A small plot of one quantity over time.

export function drawChart(canvas, values, {color, ink, floor, unit}) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const c = canvas.getContext('2d');
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  if (values.length < 2) return;
  const first = values[0].stamp, span = Math.max(values.at(-1).stamp - first, 1);
  const top = Math.max(floor, ...values.map(({value}) => value)) * 1.4;  // Room for the figure of its height.
  c.strokeStyle = ink;
  c.globalAlpha = 0.25;
  c.strokeRect(0.5, 0.5, width - 1, height - 1);
  c.globalAlpha = 1;
  c.beginPath();
  values.forEach(({stamp, value}, i) => {
    const x = (stamp - first) / span * width, y = height - 2 - value / top * (height - 4);
    if (i === 0) c.moveTo(x, y); else c.lineTo(x, y);
  });
  c.strokeStyle = color;
  c.lineWidth = 1.8;
  c.stroke();
  c.fillStyle = ink;
  c.font = '11px system-ui, "DejaVu Sans", sans-serif';
  c.textAlign = 'left';
  c.fillText(`${Number(top.toPrecision(2))} ${unit}`, 4, 12);
}
