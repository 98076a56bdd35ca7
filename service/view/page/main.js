// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together: the socket feeds the model, the model is drawn.
import {Connection} from './connection.js';
import {initialLayers, makeLayers, toggleLayers} from './layers.js';
import {MapView} from './map_view.js';
import {MarkDialog} from './mark_dialog.js';
import {decode, decodes, encodeInitialPose, encodeMark} from './messages.js';
import {Model} from './model.js';
import {Navigation} from './navigation.js';
import {Panel} from './panel.js';
import {TimeLine} from './time_line.js';
import {Tools} from './tools.js';

const kPanelPeriod_ms = 250;
const kMoving_ms = 200;
const kPrepared_ms = 3000;  // Robots that have reported within that can be told where they are.
const kPoseSchema = 'geometry_msgs/msg/PoseWithCovarianceStamped';
const kMarkSchema = 'qwsm_msgs/msg/Mark';
const kMarkTopic = '/qwsm/marks';
const $ = (id) => document.getElementById(id);

const prefersDark = matchMedia('(prefers-color-scheme: dark)').matches;
const state = {
  tool: 'look', selected: null, followed: null, shownEvent: null, shownStamp: null, looksBack: false,
  theme: localStorage.getItem('theme') ?? (prefersDark ? 'dark' : 'light'),
  layers: initialLayers(),
};
const model = new Model();
const view = new MapView($('map'), model, state);
let isDirty = true;
const changed = () => { isDirty = true; };
const navigation = new Navigation(view, model, state, changed);

// What is heavy is asked for only when it is to be seen.
function wants({topic, schemaName}) {
  if (!decodes(schemaName) || topic === '/tf') return false;
  // Of grids maps: costs of navigation, which may be in another frame, would be walls.
  if (schemaName === 'qwsm_msgs/msg/MapTile') return topic.endsWith('/map_tiles');
  // Of clouds the model, not what each scan added to it.
  if (schemaName === 'sensor_msgs/msg/PointCloud2') return topic.endsWith('/cloud_map');
  if (schemaName === 'nav_msgs/msg/Path') return connection.topics.has(topic.replace(/path$/, 'cloud_map'));
  if (schemaName === 'nav_msgs/msg/Odometry') return topic.endsWith('/ground_truth') && model.needsTruth(topic);
  if (schemaName === 'qwsm_msgs/msg/RelevantScan') return state.layers.relevant || state.looksBack;
  return true;
}

// --- The service ---

let session = null, serviceName = '';
const token = new URLSearchParams(location.search).get('token');
const address = `${location.protocol.replace('http', 'ws')}//${location.host}/ws${token ? `?token=${encodeURIComponent(token)}` : ''}`;
const connection = new Connection(address, {
  opened: ({name, sessionId}) => {
    if (session !== null && sessionId !== session) {
      model.beginSession();
      model.tell('the service was started anew');
    }
    session = sessionId;
    serviceName = name;
    showLink('live', name);
    document.title = name;
  },
  lost: () => showLink('lost', session === null && token === null ? 'no service, or a token is needed; trying again' : 'no service: trying again'),
  quiet: () => showLink('lost', 'no word from the service'),
  heard: () => showLink('live', serviceName),
  channels: changed,
  message: (channel, bytes, stamp_ms) => {
    model.take(channel, decode(channel.schemaName, bytes), {published_ms: stamp_ms, told_ms: connection.toLocal(stamp_ms)});
    changed();
  },
  status: ({level, message}) => {
    model.tell(message);
    if (level > 0) tools.hint(message);
  },
});
connection.want(wants);

function showLink(how, text) {
  $('link').dataset.state = how;
  $('link-text').textContent = text;
}

const topicOf = (robot, part) => robot ? `/${robot}/${part}` : `/${part}`;

// Who listens to a robot's place takes a moment to be found: long before an operator has drawn an arrow.
function preparePlaces(now_ms) {
  for (const [name, {arrived_ms}] of model.robots) {
    if (now_ms - arrived_ms < kPrepared_ms) connection.prepare(topicOf(name, 'initialpose'), kPoseSchema);
  }
}

function tellPlace(name, pose) {
  if (connection.publish(topicOf(name, 'initialpose'), kPoseSchema, encodeInitialPose(pose))) model.tell(`${name || 'robot'} was told where it is`);
  else tools.hint('There is no service that could be told');
}

const tellMark = (mark) => connection.publish(kMarkTopic, kMarkSchema, encodeMark(mark));

// --- What the operator does ---

function select(name) {
  state.selected = name === state.selected ? null : name;
  changed();
  panel.update(Date.now());
}

function place(name, pose) {
  if (pose) return tellPlace(name, pose);
  state.selected = name;
  tools.choose('start');
}

function mark(kind, x, y) {
  const id = crypto.randomUUID?.() ?? `${Date.now()}-${Math.random()}`;  // The former only where the page is trusted.
  markDialog.open({id, kind, x, y, text: '', author: 'operator', removed: false}, {isNew: true});
}

function showMark(id) {
  navigation.lookFrom('above');
  navigation.goTo(model.marks.get(id));
}

function showRobot(name) { navigation.goTo(model.robots.get(name).last); }

function showEvent(event) {
  state.shownEvent = state.shownEvent === event ? null : event;
  panel.update(Date.now());
  changed();
}

function lookBack() {
  state.looksBack = true;
  connection.want(wants);
}

// Chooses, and shows, who needs attention next after the one that is chosen.
function nextRobot() {
  const names = panel.order.filter((name) => model.robots.get(name)?.last);
  if (names.length === 0) return;
  const next = names[(names.indexOf(state.selected) + 1) % names.length];
  if (next !== state.selected) select(next);
  showRobot(next);
}

function setTheme(theme) {
  state.theme = theme;
  document.documentElement.dataset.theme = theme;
  localStorage.setItem('theme', theme);
  changed();
}
const otherTheme = () => setTheme(state.theme === 'dark' ? 'light' : 'dark');

const markDialog = new MarkDialog(tellMark, () => view.canvas.focus());
const editMark = (id) => markDialog.open(model.marks.get(id), {isNew: false});
const actions = {
  changed, select, place, mark, editMark, showMark, showRobot, showEvent, lookBack,
  follow: (name) => navigation.follow(name), lookFrom: (side) => navigation.lookFrom(side),
  enlarge: (from, to) => navigation.enlarge(from, to), moved: () => navigation.moved(), zoomed: () => navigation.zoomed(), pointed: (place) => navigation.point(place),
};
const panel = new Panel(model, state, actions);
const tools = new Tools(view, model, state, actions);
const timeLine = new TimeLine(model, state, actions);
makeLayers(state.layers, () => {
  connection.want(wants);
  changed();
});
$('theme').onclick = otherTheme;

const keys = {
  v: () => tools.choose('look'), m: () => tools.choose('measure'), p: () => tools.choose('start'), Escape: () => tools.choose('look'),
  1: () => tools.choose('victim'), 2: () => tools.choose('hazard'), 3: () => tools.choose('note'),
  f: () => navigation.showAll(), u: () => navigation.turnUpright(), s: () => navigation.nextSide(),
  n: nextRobot, c: async () => tools.hint(await navigation.copyPlace()), l: toggleLayers, t: otherTheme, End: () => timeLine.live(),
};
// Boxes and the time line take no letters: whoever has just used one goes on by keys, with Caps Lock, too.
addEventListener('keydown', (event) => {
  const isTyping = event.target.matches('input:not([type=checkbox], [type=range]), dialog *') || event.ctrlKey || event.metaKey || event.altKey;
  if (isTyping) return;
  keys[event.key.length === 1 ? event.key.toLowerCase() : event.key]?.();
  if (event.target === document.body) tools.press(event);  // Nothing else is meant by arrows, as on a page just opened.
});

new ResizeObserver(() => { view.resize(); changed(); }).observe($('map'));
setTheme(state.theme);
tools.choose('look');

// --- What is drawn, and when ---

// What need not be done in every frame. Ages go on, also of those who say nothing.
function updateNow(now_ms) {
  panel.update(now_ms);
  timeLine.update();
  model.placeLateScans();
  navigation.update();
  connection.watch();
  connection.want(wants);
  preparePlaces(now_ms);
  changed();
}

let updateDue_ms = 0, shown_ms = 0;
function frame() {
  requestAnimationFrame(frame);
  const now_ms = Date.now();
  if (now_ms >= updateDue_ms) {
    updateDue_ms = now_ms + kPanelPeriod_ms;
    updateNow(now_ms);
  }
  if (navigation.step(now_ms - shown_ms)) changed();
  shown_ms = now_ms;
  // While robots move, each frame shows them a little further.
  if (!isDirty && now_ms - model.reported_ms > kMoving_ms) return;
  isDirty = false;
  view.draw(now_ms);
  navigation.drawScale();
}
requestAnimationFrame(frame);

// For tests and for whoever wonders: the state of the page.
window.qwsm = {model, view, state, connection, actions};
