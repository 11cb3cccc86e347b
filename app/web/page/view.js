// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The picture: a canvas with a WebGPU device, the renderer of a scene, and what happens when the device is lost.

import { Screen } from './engine/windfall_web.js';

/** Devices that are tried, one after another is lost. */
const DEVICES = 3;
/** Most pixels of the canvas for a pixel of the page. */
const MOST_SCALE = 2;

export class View {
  /** Frames that are drawn and finished. */
  frames = 0;
  /** True if the picture is older than what it shows. */
  isStale = true;
  /** Pixels a side for each of the page's. */
  detail = 1;
  #canvas;
  #screen = null;
  #isShown = false;
  #devices = 0;
  /** Time at which the frame before was begun, and that of the one that the device still works on. */
  #before = null;
  #begun = null;
  #report;

  /** `report` has `lost(reason)`, `without(reason)`, `complain(error)` and `framed(ms)`. */
  constructor(canvas, report) {
    this.#canvas = canvas;
    this.#report = report;
  }

  get screen() { return this.#screen; }
  get isShown() { return this.#isShown; }

  /** Opens a device; where there is none, says so and stays without a picture. */
  async open() {
    if (!navigator.gpu) return this.#report.without('This browser has no WebGPU, so there is no picture.');
    this.#devices += 1;
    try {
      this.#screen = await Screen.open(this.#canvas);
    } catch (error) {
      this.#report.without(`There is no picture (${error.message}).`);
    }
  }

  /** Shows the scene of a player from now on, with packs of leaf pictures: pairs of name and bytes. */
  show(player, packs) {
    this.#isShown = false;
    if (!this.#screen) return;
    try {
      for (const [name, bytes] of packs) this.#screen.give_leaves(name, bytes);
      this.#fit();
      this.#screen.show(player);
      [this.#isShown, this.isStale, this.#before, this.#begun] = [true, true, null, null];
    } catch (error) {
      this.#report.complain(error);
    }
  }

  /** Draws under the sky of a file. */
  setSky(player, name, bytes) {
    if (!this.#isShown) throw new Error(`${name}: there is no picture to put a sky into`);
    this.#screen.set_sky(player, name, bytes);
    this.isStale = true;
  }

  /** True while the simulator on WebGPU runs beside the player. */
  get compares() { return this.#isShown && this.#screen.compares(); }

  /** Starts or ends that. */
  setComparing(player, compares) {
    if (!this.#isShown) throw new Error('There is no graphics device to compare with.');
    this.#screen.compare(player, compares);
  }

  /** Lets it follow; returns { step, since, farthestM, otherStates } of the latest reading, or undefined. */
  difference(player) {
    const [step, since, farthestM, otherStates] = this.#screen.difference(player) ?? [];
    return step === undefined ? undefined : { step, since, farthestM, otherStates };
  }

  /** True while it has steps to take that the player has taken. */
  isBehind(player) {
    return this.compares && this.#screen.is_behind(player);
  }

  /** Draws the player's world if it has changed and the device is free. */
  draw(player, now) {
    if (!this.#isShown) return;
    const lost = this.#screen.lost();
    if (lost !== undefined) {
      this.#complain();
      this.#screen = null;
      this.#isShown = false;
      const isLast = this.#devices >= DEVICES;
      return isLast ? this.#report.without(`The graphics device was lost ${DEVICES} times (${lost}).`) : this.#report.lost(lost);
    }
    // One frame at a time, or a slow device would fall behind ever more.
    if (this.#screen.is_busy()) return;
    if (this.#begun !== null) {
      this.frames += 1;
      this.#report.framed(now - this.#begun);
      this.#begun = null;
      this.#complain();
    }
    this.#fit();
    if (!this.isStale) return;
    const sinceS = this.#before === null ? Infinity : (now - this.#before) / 1000;
    if (this.#screen.draw(player, sinceS)) {
      [this.#before, this.#begun, this.isStale] = [now, now, false];
    }
  }

  /** Passes on what the device has complained of. */
  #complain() {
    const complaint = this.#screen.take_complaint();
    if (complaint !== undefined) this.#report.complain(`The graphics device refused something: ${complaint}`);
  }

  /** Lets the canvas have as many pixels as the page shows. */
  #fit() {
    const scale = Math.min(devicePixelRatio, MOST_SCALE) * this.detail;
    const [width, height] = [this.#canvas.clientWidth, this.#canvas.clientHeight].map((side) => Math.max(1, Math.round(side * scale)));
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      [this.#canvas.width, this.#canvas.height] = [width, height];
      this.#screen.resize(width, height);
      this.isStale = true;
    }
  }

  /** Milliseconds that the device last spent on a frame; undefined where it does not say. */
  deviceMs() {
    return this.#isShown ? this.#screen.device_ms() : undefined;
  }
}
