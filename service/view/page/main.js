// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together: the socket feeds the model, the model is drawn.
import {Connection} from './connection.js';
import {MapView} from './map_view.js';
import {decode, decodes, encodeInitialPose, encodeMark} from './messages.js';
import {Model} from './model.js';
import {Panel} from './panel.js';
import {TimeLine} from './time_line.js';
import {Tools} from './tools.js';

const kPanelPeriod_ms = 250;
const kMoving_ms = 200;
const kPoseSchema = 'geometry_msgs/msg/PoseWithCovarianceStamped';
const kMarkSchema = 'qwsm_msgs/msg/Mark';
const kMarkTopic = '/qwsm/marks';
const kLayers = {occupancy: 'Map', scans: 'Scans of now', trails: 'Trails', loops: 'Loops', uncertainty: 'Uncertainty', relevant: 'Relevant scans', marks: 'Marks', grid: 'Grid'};
const $ = (id) => document.getElementById(id);

const prefersDark = matchMedia('(prefers-color-scheme: dark)').matches;
const state = {
  tool: 'look', selected: null, shownEvent: null, followed: null, shownStamp: null, looksBack: false,
  theme: localStorage.getItem('theme') ?? (prefersDark ? 'dark' : 'light'),
  layers: {occupancy: true, scans: true, trails: true, loops: true, uncertainty: true, relevant: false, marks: true, grid: true},
};
const model = new Model();
const view = new MapView($('map'), model, state);
let isDirty = true;
let hasFitted = false;
const changed = () => { isDirty = true; };

// What is heavy is asked for only when it is to be seen.
const unused = new Set(['/tf']);
const wants = (channel) => {
  if (!decodes(channel.schemaName) || unused.has(channel.topic)) return false;
  // Of clouds the model, not what each scan added to it.
  if (channel.schemaName === 'sensor_msgs/msg/PointCloud2') return channel.topic.endsWith('/cloud_map');
  if (channel.schemaName === 'nav_msgs/msg/Odometry') return channel.topic.endsWith('/ground_truth') && model.needsTruth(channel.topic);
  if (channel.schemaName === 'qwsm_msgs/msg/RelevantScan') return state.layers.relevant || state.looksBack;
  return true;
};

let session = null;
const query = new URLSearchParams(location.search);
const token = query.get('token');
const connection = new Connection(`${location.protocol.replace('http', 'ws')}//${location.host}/ws${token ? `?token=${encodeURIComponent(token)}` : ''}`, {
  opened: ({name, sessionId}) => {
    if (session !== null && sessionId !== session) {
      model.beginSession();
      model.tell('the service was started anew');
    }
    session = sessionId;
    setLink('live', name);
    document.title = name;
  },
  lost: () => {
    setLink('lost', session === null && token === null ? 'no service, or a token is needed; trying again' : 'no service: trying again');
  },
  channels: () => { changed(); },
  message: (channel, bytes, stamp_ms) => {
    model.take(channel, decode(channel.schemaName, bytes), {published_ms: stamp_ms, told_ms: connection.toLocal(stamp_ms)});
    changed();
  },
  status: ({level, message}) => { model.tell(message); if (level > 0) tools.hint(message); },
});
connection.want(wants);

function setLink(how, text) {
  $('link').dataset.state = how;
  $('link-text').textContent = text;
}

function fit() {
  const bounds = view.bounds();
  if (!bounds) return;
  const isNarrow = innerWidth <= 760;
  const margins = isNarrow ? {left: 40, right: 0, top: 50, bottom: innerHeight * 0.4} : {left: 80, right: 350, top: 0, bottom: 70};
  view.camera.fit(bounds, margins);
  hasFitted = true;
  changed();
}

// Models in space are looked at from above or from a side.
const kSides = ['above', 'south', 'east', 'north', 'west'];
function lookFrom(side) {
  if (view.camera.from === side) return;
  view.camera.look(side);
  $('side').querySelector('span').textContent = side[0].toUpperCase() + side.slice(1);
  fit();
}
const nextSide = () => { if (model.clouds.size > 0) lookFrom(kSides[(kSides.indexOf(view.camera.from) + 1) % kSides.length]); };

const topicOf = (robot, part) => robot ? `/${robot}/${part}` : `/${part}`;

const actions = {
  changed,
  select: (name) => {
    state.selected = name === state.selected ? null : name;
    changed();
    panel.update(Date.now());
  },
  centre: (name) => {
    const {last} = model.robots.get(name);
    const [x, y] = view.camera.project(last.x, last.y, last.z ?? 0);
    Object.assign(view.camera, {x, y, scale: Math.max(view.camera.scale, 50)});
    hasFitted = true;
    changed();
  },
  follow: (name) => { state.followed = name; actions.centre(name); },
  stopFollowing: () => { state.followed = null; hasFitted = true; },
  place: (name, pose) => {
    if (pose === undefined) {
      state.selected = name;
      return tools.choose('start');
    }
    connection.publish(topicOf(name, 'initialpose'), kPoseSchema, encodeInitialPose(pose));
    model.tell(`${name || 'robot'} was told where it is`);
  },
  mark: (kind, x, y) => editMark({id: crypto.randomUUID?.() ?? `${Date.now()}-${Math.random()}`, kind, x, y, text: '', author: 'operator', removed: false}, true),
  editMark: (id) => editMark(model.marks.get(id), false),
  showMark: (id) => {
    const {x, y} = model.marks.get(id);
    lookFrom('above');
    Object.assign(view.camera, {x, y, scale: Math.max(view.camera.scale, 50)});
    changed();
  },
  showEvent: (event) => {
    state.shownEvent = state.shownEvent === event ? null : event;
    panel.update(Date.now());
    changed();
  },
  lookFrom,
  lookBack: () => {
    state.looksBack = true;
    connection.want(wants);
  },
};

// Asks for a mark's words, and tells everybody.
function editMark(mark, isNew) {
  const dialog = $('mark-dialog');
  $('mark-title').textContent = `${mark.kind[0].toUpperCase()}${mark.kind.slice(1)} at ${mark.x.toFixed(1)}, ${mark.y.toFixed(1)} m`;
  $('mark-text').value = mark.text;
  $('mark-remove').hidden = isNew;
  dialog.returnValue = 'cancel';
  dialog.onclose = () => {
    view.canvas.focus();
    if (dialog.returnValue === 'cancel') return;
    const kept = {...mark, text: $('mark-text').value.trim(), removed: dialog.returnValue === 'remove'};
    if (!connection.publish(kMarkTopic, kMarkSchema, encodeMark(kept))) return tools.hint('There is no service that could keep the mark');
  };
  dialog.showModal();
  $('mark-text').focus();
}
// Enter keeps the mark: of a form's buttons it would choose the first.
$('mark-text').addEventListener('keydown', (event) => {
  if (event.key !== 'Enter') return;
  event.preventDefault();
  $('mark-dialog').close('ok');
});

const panel = new Panel(model, state, actions);
const tools = new Tools(view, model, state, actions);
const timeLine = new TimeLine(model, state, actions);

function setTheme(theme) {
  state.theme = theme;
  document.documentElement.dataset.theme = theme;
  localStorage.setItem('theme', theme);
  changed();
}
const otherTheme = () => setTheme(state.theme === 'dark' ? 'light' : 'dark');
const toggleLayers = () => {
  $('layers').hidden = !$('layers').hidden;
  $('layers-button').setAttribute('aria-expanded', String(!$('layers').hidden));
};

for (const [layer, word] of Object.entries(kLayers)) {
  const box = Object.assign(document.createElement('input'), {type: 'checkbox', checked: state.layers[layer]});
  box.onchange = () => {
    state.layers[layer] = box.checked;
    connection.want(wants);
    changed();
  };
  const label = document.createElement('label');
  label.append(box, word);
  $('layers').append(label);
}
$('fit').onclick = fit;
$('theme').onclick = otherTheme;
$('layers-button').onclick = toggleLayers;
$('side').onclick = nextSide;

const keys = {v: () => tools.choose('look'), m: () => tools.choose('measure'), p: () => tools.choose('start'), 1: () => tools.choose('victim'), 2: () => tools.choose('hazard'), 3: () => tools.choose('note'), f: fit, l: toggleLayers, s: nextSide, t: otherTheme, End: () => timeLine.live(), Escape: () => tools.choose('look')};
addEventListener('keydown', (event) => {
  const isTyping = event.target.matches('input, dialog *') || event.ctrlKey || event.metaKey || event.altKey;
  if (!isTyping) keys[event.key]?.();
});

new ResizeObserver(() => { view.resize(); changed(); }).observe($('map'));
setTheme(state.theme);
tools.choose('look');

function drawScale() {
  const length_m = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200].find((m) => m * view.camera.scale > 60) ?? 500;
  $('scale-bar').style.width = `${length_m * view.camera.scale}px`;
  $('scale-text').textContent = `${length_m} m`;
}

let panelDue_ms = 0;
function frame() {
  requestAnimationFrame(frame);
  const now_ms = Date.now();
  if (now_ms >= panelDue_ms) {
    panelDue_ms = now_ms + kPanelPeriod_ms;
    panel.update(now_ms);
    timeLine.update();
    model.placeLateScans();
    $('side').hidden = model.clouds.size === 0;
    connection.want(wants);
    isDirty = true;  // Ages go on, also of those who say nothing.
    // Until somebody moves the map, all of it is shown as it grows.
    if (!hasFitted && model.robots.size > 0) { fit(); hasFitted = false; }
  }
  // While robots move, each frame shows them a little further.
  if (!isDirty && now_ms - model.reported_ms > kMoving_ms) return;
  isDirty = false;
  const followed = model.robots.get(state.followed)?.last;
  if (followed) {
    const [x, y] = view.camera.project(followed.x, followed.y, followed.z ?? 0);
    Object.assign(view.camera, {x, y});
  }
  view.draw(now_ms);
  drawScale();
}
requestAnimationFrame(frame);

// For tests and for whoever wonders: the state of the page.
window.qwsm = {model, view, state, connection, actions};
