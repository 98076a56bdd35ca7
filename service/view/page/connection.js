// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// The socket to the service: version 1 of the Foxglove WebSocket protocol, and again after each loss.

const kProtocol = 'foxglove.websocket.v1';
const kFirstPause_ms = 500;
const kLongestPause_ms = 4000;
// The service tells its time ten times a second, but while a large model is on a slow line. After 20 s it gives up itself
// whoever does not answer; TCP alone may hold a dead line for alive for an hour.
const kQuiet_ms = 3000;
const kGivenUp_ms = 25000;
const kDrift_ms = 0.1;  // Of two clocks, between two times that the service tells.

export class Connection {
  // `handlers`: opened(info), lost(), quiet() and heard() when the service has said nothing for some time and speaks again,
  // channels(list), message(channel, view, stamp_ms), status(status).
  constructor(url, handlers) {
    this.url = url;
    this.handlers = handlers;
    this.channels = new Map();  // By id.
    this.wanted = () => false;
    this.subscriptions = new Map();  // Channel by subscription id.
    this.publications = new Map();  // Our channel id by topic.
    this.lastId = 0;
    this.pause_ms = kFirstPause_ms;
    this.bytes = 0;
    this.ahead_ms = -Infinity;  // Of the service's clock before this computer's.
    this.isQuiet = false;
    this.watched_ms = 0;
    this.#connect();
  }

  // Subscribes to the channels of which `isWanted(channel)` is true, now and as they come.
  want(isWanted) {
    this.wanted = isWanted;
    this.#subscribe();
  }

  get topics() { return new Set([...this.channels.values()].map(({topic}) => topic)); }

  // @return whether that is on its way. What is said right after prepare() may be lost.
  publish(topic, schemaName, payload) {
    if (!this.prepare(topic, schemaName)) return false;
    const message = new Uint8Array(5 + payload.length);
    message[0] = 1;
    new DataView(message.buffer).setUint32(1, this.publications.get(topic), true);
    message.set(payload, 5);
    this.socket.send(message);
    return true;
  }

  // Says that something will be published: the service looks for who listens. @return whether it hears.
  prepare(topic, schemaName) {
    if (this.socket?.readyState !== WebSocket.OPEN || this.isQuiet) return false;
    if (this.publications.has(topic)) return true;
    const id = ++this.lastId;
    this.publications.set(topic, id);
    this.#send({op: 'advertise', channels: [{id, topic, encoding: 'cdr', schemaName}]});
    return true;
  }

  // Is called several times a second: who says nothing is no more there than who has gone, and may be behind a dead line.
  watch() {
    const now_ms = performance.now();
    const hasSlept = now_ms - this.watched_ms > kQuiet_ms / 2;  // This page: what came meanwhile has not been read yet.
    this.watched_ms = now_ms;
    if (hasSlept) this.heard_ms = now_ms;
    if (this.socket.readyState === WebSocket.CLOSED) return;
    const quiet_ms = now_ms - this.heard_ms;
    if (quiet_ms > kGivenUp_ms) return this.#giveUp();
    if (quiet_ms < kQuiet_ms || this.isQuiet) return;
    this.isQuiet = true;
    this.handlers.quiet();
  }

  #connect() {
    this.socket = new WebSocket(this.url, [kProtocol]);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onmessage = ({data}) => this.#hear(data);
    this.socket.onclose = () => this.#lose();
    this.heard_ms = performance.now();
  }

  #hear(data) {
    this.heard_ms = performance.now();
    if (this.isQuiet) this.handlers.heard();
    this.isQuiet = false;
    if (typeof data === 'string') this.#takeText(JSON.parse(data)); else this.#takeBytes(data);
  }

  // Closing takes an answer, which does not come.
  #giveUp() {
    this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
    this.#lose();
  }

  #lose() {
    this.isQuiet = false;
    this.channels.clear();
    this.subscriptions.clear();
    this.publications.clear();
    this.ahead_ms = -Infinity;
    this.handlers.lost();
    setTimeout(() => this.#connect(), this.pause_ms);
    this.pause_ms = Math.min(2 * this.pause_ms, kLongestPause_ms);
  }

  #takeText(message) {
    switch (message.op) {
      case 'serverInfo':
        this.pause_ms = kFirstPause_ms;
        this.handlers.opened(message);
        break;
      case 'advertise':
        for (const channel of message.channels) this.channels.set(channel.id, channel);
        this.#subscribe();
        this.handlers.channels([...this.channels.values()]);
        break;
      case 'unadvertise':
        for (const id of message.channelIds) this.#forget(id);
        this.handlers.channels([...this.channels.values()]);
        break;
      case 'status':
        this.handlers.status(message);
        break;
    }
  }

  #forget(channelId) {
    this.channels.delete(channelId);
    for (const [id, channel] of this.subscriptions) {
      if (channel.id === channelId) this.subscriptions.delete(id);
    }
  }

  #takeBytes(data) {
    this.bytes += data.byteLength;
    const view = new DataView(data);
    if (view.getUint8(0) === 2) return this.#takeTime(Number(view.getBigUint64(1, true)) / 1e6);
    const channel = this.subscriptions.get(view.getUint32(1, true));
    if (!channel) return;
    const stamp_ms = Number(view.getBigUint64(5, true)) / 1e6;
    this.handlers.message(channel, new DataView(data, 13), stamp_ms);
  }

  // The clock that is least late is right.
  #takeTime(service_ms) {
    const ahead_ms = service_ms - Date.now();
    this.ahead_ms = Math.max(ahead_ms, this.ahead_ms - kDrift_ms);
  }

  // When something of the service's clock was, on this computer's.
  toLocal(service_ms) {
    return Number.isFinite(this.ahead_ms) ? service_ms - this.ahead_ms : Date.now();
  }

  #subscribe() {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    const have = new Set([...this.subscriptions.values()].map((channel) => channel.id));
    const subscriptions = [];
    for (const channel of this.channels.values()) {
      if (have.has(channel.id) || !this.wanted(channel)) continue;
      const id = ++this.lastId;
      this.subscriptions.set(id, channel);
      // What says nothing new need not come: our addition to the protocol, which others pass over.
      subscriptions.push({id, channelId: channel.id, newsOnly: true});
    }
    const subscriptionIds = [...this.subscriptions].filter(([, channel]) => !this.wanted(channel)).map(([id]) => id);
    for (const id of subscriptionIds) this.subscriptions.delete(id);
    if (subscriptions.length > 0) this.#send({op: 'subscribe', subscriptions});
    if (subscriptionIds.length > 0) this.#send({op: 'unsubscribe', subscriptionIds});
  }

  #send(message) { this.socket.send(JSON.stringify(message)); }
}
