// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
// CDR as ROS 2 writes it: XCDR1 behind a head of four bytes, each number aligned to its size.

export class CdrReader {
  constructor(view) {
    this.view = new DataView(view.buffer, view.byteOffset + 4, view.byteLength - 4);
    this.little = view.getUint8(1) % 2 === 1;
    this.at = 0;
  }
  #take(size) {
    const begin = Math.ceil(this.at / size) * size;
    this.at = begin + size;
    return begin;
  }
  uint8() { return this.view.getUint8(this.#take(1)); }
  int32() { return this.view.getInt32(this.#take(4), this.little); }
  uint32() { return this.view.getUint32(this.#take(4), this.little); }
  uint64() { return Number(this.view.getBigUint64(this.#take(8), this.little)); }
  float32() { return this.view.getFloat32(this.#take(4), this.little); }
  float64() { return this.view.getFloat64(this.#take(8), this.little); }
  string() {
    const length = this.uint32();
    const text = this.bytes(length);
    return new TextDecoder().decode(text.subarray(0, Math.max(0, length - 1)));
  }
  bytes(length) {
    const bytes = new Uint8Array(this.view.buffer, this.view.byteOffset + this.at, length);
    this.at += length;
    return bytes;
  }
  float64s(count) { return Array.from({length: count}, () => this.float64()); }
  float32s() { return Float32Array.from({length: this.uint32()}, () => this.float32()); }
  list(read) { return Array.from({length: this.uint32()}, () => read(this)); }
}

export class CdrWriter {
  #bytes = [0, 1, 0, 0];
  #add(size, set) {
    while ((this.#bytes.length - 4) % size !== 0) this.#bytes.push(0);
    const view = new DataView(new ArrayBuffer(size));
    set(view);
    for (let i = 0; i < size; ++i) this.#bytes.push(view.getUint8(i));
  }
  uint8(value) { this.#add(1, (view) => view.setUint8(0, value)); }
  int32(value) { this.#add(4, (view) => view.setInt32(0, value, true)); }
  uint32(value) { this.#add(4, (view) => view.setUint32(0, value, true)); }
  uint64(value) { this.#add(8, (view) => view.setBigUint64(0, BigInt(value), true)); }
  float64(value) { this.#add(8, (view) => view.setFloat64(0, value, true)); }
  string(text) {
    const bytes = new TextEncoder().encode(text);
    this.uint32(bytes.length + 1);
    this.#bytes.push(...bytes, 0);
  }
  get bytes() { return Uint8Array.from(this.#bytes); }
}
