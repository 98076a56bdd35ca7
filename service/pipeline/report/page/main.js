// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause

function showTitle() {
  const names = report.inputs.map((input) => input.split('/').filter((part) => part).pop() || input);
  document.getElementById('command').textContent = `${report.command} ${report.inputs.join(' ')}`;
  document.getElementById('heading').textContent = names.length > 3
    ? `${names.slice(0, 3).join(', ')} and ${names.length - 3} more` : names.join(', ');
  const facts = [`made by version ${report.version}`];
  document.getElementById('facts').replaceChildren(...facts,
    ...(report.interrupted ? [' · ', make('span', { class: 'badge' }, 'interrupted: what came until then')] : []));
}

const dark = window.matchMedia('(prefers-color-scheme: dark)');
document.getElementById('theme').addEventListener('click', () =>
  theme.set(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'));
dark.addEventListener('change', () => theme.set(dark.matches ? 'dark' : 'light'));
theme.set(dark.matches ? 'dark' : 'light');
showTitle();
showFigures();
if (report.kind === 'map') showMapReport(); else showCloudReport();
