// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Times of frames, as numbers and as a graph.

/** Frames in the graph. */
const FRAMES = 132;
/** Milliseconds at the top of the graph, at least. */
const TOP_MS = 40;
/** Milliseconds of a frame at sixty a second, where the line is. */
const SIXTY_MS = 1000 / 60;

export class Meter {
  #times = [];
  #context;

  constructor(canvas) {
    this.#context = canvas.getContext('2d');
  }

  /** Notes a frame that took so many milliseconds. */
  add(ms) {
    this.#times.push(ms);
    if (this.#times.length > FRAMES) this.#times.shift();
  }

  forget() {
    this.#times = [];
  }

  /** Median of the frames in the graph in milliseconds; undefined without any. */
  median() {
    return [...this.#times].sort((a, b) => a - b)[this.#times.length >> 1];
  }

  draw() {
    const { width, height } = this.#context.canvas;
    const top = Math.max(TOP_MS, ...this.#times);
    const y = (ms) => height - (ms / top) * height;
    this.#context.clearRect(0, 0, width, height);
    this.#context.fillStyle = '#f0a04b';
    this.#times.forEach((ms, at) => this.#context.fillRect((at * width) / FRAMES, y(ms), width / FRAMES - 0.5, height));
    this.#context.fillStyle = 'rgb(255 244 228 / 0.5)';
    this.#context.fillRect(0, y(SIXTY_MS), width, 1);
  }
}
