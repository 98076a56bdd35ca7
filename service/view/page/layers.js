// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// What is drawn, each of which can be left out.
const $ = (id) => document.getElementById(id);

const kLayers = {
  occupancy: {word: 'Map', isShown: true}, scans: {word: 'Scans of now', isShown: true}, trails: {word: 'Trails', isShown: true},
  loops: {word: 'Loops', isShown: true}, uncertainty: {word: 'Uncertainty', isShown: true}, relevant: {word: 'Relevant scans', isShown: false},
  marks: {word: 'Marks', isShown: true}, grid: {word: 'Grid', isShown: true},
};

export const initialLayers = () => Object.fromEntries(Object.entries(kLayers).map(([layer, {isShown}]) => [layer, isShown]));

// Fills the box of layers. `changed()` is called when the operator has changed one of `shown`.
export function makeLayers(shown, changed) {
  for (const [layer, {word}] of Object.entries(kLayers)) {
    const box = Object.assign(document.createElement('input'), {type: 'checkbox', checked: shown[layer]});
    box.onchange = () => {
      shown[layer] = box.checked;
      changed();
    };
    const label = document.createElement('label');
    label.append(box, word);
    $('layers').append(label);
  }
  $('layers-button').onclick = toggleLayers;
}

export function toggleLayers() {
  $('layers').hidden = !$('layers').hidden;
  $('layers-button').setAttribute('aria-expanded', String(!$('layers').hidden));
}
