// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The figures of metrics.json: what each is called, its unit, and what it means.

// key: [name, unit, meaning, factor to the unit]
const kFigures = {
  matcher: ['Matcher', '', 'How scans were matched: against all relevant scans (q-wsm) or the last one (wsm, icp).'],
  scans: ['Scans', '', 'Scans that were answered with a pose.'],
  scans_in_series: ['Scans there were', '', 'Scans in the folder; fewer are registered where the run was interrupted.'],
  matched: ['Matched', '', 'Scans whose pose is that of the match.'],
  extended: ['Matched, much new', '', 'Matched scans of which much was new to the map.'],
  dead_reckoned: ['Dead-reckoned', '', 'Scans that could not be matched: their pose is that of odometry, and less certain.'],
  unusable: ['Unusable', '', 'Scans with fewer than three different points that count.'],
  lost: ['Lost', '', 'Scans while it was not known where in the map the robot is.'],
  relevant: ['Relevant scans', '', 'Scans that the map was made of: those that showed something new, or from elsewhere.'],
  path_length_m: ['Path', 'm', 'Length of the path from pose to pose.'],
  mean_residual_mm: ['Mean residual', 'mm', 'Mean distance of matched points to the nearest point of the map.'],
  mean_trace_m2: ['Mean trace', 'm²', 'Mean uncertainty of a match as Visser et al. (2009) chart it: variance in x plus that in y.'],
  scans_per_s: ['Scans per second', '1/s', 'Scans answered per second of computing.'],
  drive_s: ['Duration', 's', 'Time from the first scan to the last, by their stamps.'],
  ms_median: ['Time, median', 'ms', 'Half of the scans took no longer; processor time of the answer.'],
  ms_p99: ['Time, p99', 'ms', '99 of 100 scans took no longer.'],
  ms_max: ['Time, longest', 'ms', 'The slowest answer.'],
  'map.points': ['Points in the map', '', 'Points that scans are matched with.'],
  'map.scans': ['Scans in the map', '', 'Relevant scans whose points are in the map.'],
  'map.quadtree_nodes': ['Quadtree nodes', '', 'Nodes of the tree in which the points are searched.'],
  'map.quadtree_depth': ['Quadtree depth', '', 'Levels of the tree; a cell of the last one is a millimetre wide.'],
  'map.quadtree_bytes': ['Quadtree memory', 'MB', 'Memory of the tree.', 1e-6],
  'loops.found': ['Loops found', '', 'Places that looked like one seen in an earlier pass.'],
  'loops.accepted': ['Loops accepted', '', 'Those of them that path and map were corrected by.'],
  loops_closed: ['Loops closed', '', 'Pairs of scans that joined the model to an earlier part of it.'],
  ate_rmse_m: ['Error of the path', 'm', 'Root mean square distance to the true positions, after the best alignment.'],
  ate_from_start_rmse_m: ['Error from the start', 'm', 'The same in the map, which lies as its first robot began.'],
  heading_rmse_deg: ['Error of headings', '°', 'Root mean square, in the map, which lies as its first robot began.'],
  loop_gap_m: ['Gap from tip to tail', 'm', 'How wrong the way from the first pose to the last one is.'],
  nees: ['NEES', '', 'Squared error in units of its covariance: 3 is honest, more is too sure, less too careful.'],
  share_in_95_percent_ellipsoid: ['Within the 95 % ellipsoid', '%', 'Share of the true poses there; 95 is honest.', 100],
  points: ['Points', '', 'Points within range, of all scans.'],
  points_kept: ['Points kept', '', 'Points left after the thinning of the scans, which are registered.'],
  mean_voxel_m: ['Thinned to', 'm', 'Mean side of the cubes of which one point is kept; 0 where no scan was thinned.'],
  mean_overlap: ['Mean overlap', '%', 'Share of a scan that the scans before it have seen, too; mean of the matched ones.', 100],
  mean_rms_residual_m: ['Mean residual', 'mm', 'Root mean square distance of paired points; mean of the matched scans.', 1000],
  'refinement.fits': ['Refinement, fits', '', 'How often a scan was fitted to all of its neighbours in the end.'],
  'refinement.settled': ['Refinement settled', '', 'Whether no scan moved any more when it ended.'],
  time_registration_s: ['Time, registration', 's', 'Time of all registrations, without reading files.'],
  time_refinement_s: ['Time, refinement', 's', 'Time of fitting all scans to each other.'],
  interrupted: ['Interrupted', '', 'Whether the run was stopped before its end.'],
};

// What stands on the tiles at the top, where the run has it.
const kTiles = ['scans', 'path_length_m', 'drive_s', 'matched_share', 'dead_reckoned', 'mean_residual_mm',
  'mean_rms_residual_m', 'mean_overlap', 'loops', 'loops_closed', 'ate_rmse_m', 'nees', 'ms_median', 'ms_p99',
  'time_registration_s', 'points'];

// Figures within figures by their path: loops.found.
function flattened(figures, prefix = '') {
  return Object.entries(figures).flatMap(([key, value]) =>
    (value !== null && typeof value === 'object' ? flattened(value, `${prefix}${key}.`) : [[prefix + key, value]]));
}

function figureText(key, value) {
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value !== 'number') return String(value);
  const scaled = value * ((kFigures[key] || [])[3] || 1);
  return Number.isInteger(scaled) ? fixed(scaled, 0) : digits(scaled);
}

function tileOf(key, metrics) {
  if (key === 'matched_share') {
    const matched = (metrics.matched || 0) + (metrics.extended || 0);
    return { name: 'Matched', value: metrics.scans ? fixed(Math.floor(1000 * matched / metrics.scans) / 10, 1) : '–', unit: '%',
      meaning: 'Share of the scans whose pose comes from a match; the first scan has nothing to be matched with.' };
  }
  if (key === 'loops' && metrics.loops) {
    return { name: 'Loops accepted', value: fixed(metrics.loops.accepted, 0), unit: `of ${fixed(metrics.loops.found, 0)} found`,
      meaning: metrics.loops.accepted ? 'Path and map are corrected by them.' : 'Path and map stay as they were answered.' };
  }
  if (typeof metrics[key] !== 'number') return null;
  const [name, unit, meaning] = kFigures[key];
  if (key === 'drive_s') return { name, value: clock(metrics[key]), unit: metrics[key] < 3600 ? 'min' : 'h', meaning };
  return { name, value: figureText(key, metrics[key]), unit, meaning, warn: key === 'dead_reckoned' && metrics[key] > 0 };
}

function showFigures() {
  const { metrics } = report;
  const tiles = kTiles.map((key) => tileOf(key, metrics)).filter((tile) => tile);
  const rows = flattened(metrics).map(([key, value]) => {
    const [name, unit, meaning] = kFigures[key] || [key, '', ''];
    return make('tr', {}, make('td', {}, name), make('td', { class: 'number' }, figureText(key, value)),
      make('td', {}, unit), make('td', {}, meaning), make('td', {}, make('code', {}, key)));
  });
  const header = ['Figure', 'Value', 'Unit', 'What it means', 'In metrics.json'].map((text, i) =>
    make('th', { scope: 'col', class: i === 1 ? 'number' : undefined }, text));
  section('figures', 'Figures', null,
    make('div', { class: 'tiles' }, ...tiles.map(({ name, value, unit, meaning, warn }) =>
      make('div', { class: warn ? 'tile warn' : 'tile' }, make('div', { class: 'name' }, name),
        make('div', { class: 'value' }, value, make('small', {}, unit ? ` ${unit}` : '')),
        make('div', { class: 'meaning' }, meaning)))),
    make('details', {}, make('summary', {}, 'All figures, and what they mean'),
      make('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'All figures' },
        make('table', {}, make('thead', {}, make('tr', {}, ...header)), make('tbody', {}, ...rows)))));
}
