// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Colours of what is drawn on the map, in the light and in the dark.

// `palette`: of cells that are unknown, free, occupied.
export const kThemes = {
  light: {ground: '#dfe5ec', dot: '#b9c4d0', ink: '#16202c', paper: '#ffffff', point: '#00284f', moved: '#a3195b',
    palette: [[0, 0, 0, 0], [255, 255, 255, 255], [0, 40, 120, 255]]},
  dark: {ground: '#10151c', dot: '#2a3541', ink: '#eef4fa', paper: '#10151c', point: '#cfe6ff', moved: '#ff9ecb',
    palette: [[0, 0, 0, 0], [36, 46, 58, 255], [196, 222, 247, 255]]},
};

export const kMarkKinds = {
  victim: {word: 'Victim', color: '#f00a0a', shape: 'disc'},
  hazard: {word: 'Hazard', color: '#ff641e', shape: 'diamond'},
  note: {word: 'Note', color: '#0a0af0', shape: 'square'},
};

// Okabe and Ito's colours, which the colour-blind tell apart; robots are numbered all the same.
export const kRobotColors = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442', '#8c8c8c'];

// White or black, whichever is read better on a colour.
export function inkOn(color) {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));
  return 0.299 * r + 0.587 * g + 0.114 * b > 140 ? '#000' : '#fff';
}

export const packed = ([r, g, b, a]) => ((a << 24) | (b << 16) | (g << 8) | r) >>> 0;

// Of heights, from blue by green to yellow: also the colour-blind see which is higher.
export const kHeights = Uint32Array.from({length: 256}, (_, i) => {
  const stops = [[62, 74, 137], [38, 130, 142], [53, 183, 121], [253, 231, 37]];
  const at = i / 256 * 3, stop = Math.floor(at);
  return packed([...stops[stop].map((low, k) => Math.round(low + (at - stop) * (stops[stop + 1][k] - low))), 255]);
});
