// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Turns the time that passes into whole steps.

/** Most steps in one frame. */
const MOST_STEPS = 32;
/** Milliseconds that the steps of a frame may take, unless a single one takes longer. */
const BUDGET_MS = 24;
/** Longest time between two frames that counts, in seconds. */
const LONGEST_FRAME_S = 0.25;

export class Pace {
  isPlaying = true;
  /** Step that is to be reached before time goes on; null if none is. */
  target = null;
  /** Milliseconds of a step, lately. */
  stepMs = 5;
  #owedS = 0;

  /** Takes steps of `player` as `sinceS` seconds ask for, or towards the target; returns true if time has moved. */
  go(player, sinceS) {
    const before = player.step();
    if (this.target !== null) {
      this.#pursue(player);
    } else if (this.isPlaying) {
      const dtS = player.dt_s();
      this.#owedS += Math.min(sinceS, LONGEST_FRAME_S);
      const due = Math.floor(this.#owedS / dtS);
      const steps = Math.min(due, this.#affordable());
      // What cannot be done in time is dropped: simulated time then goes slower.
      this.#owedS = Math.min(this.#owedS - steps * dtS, dtS);
      if (steps > 0) this.#take(player, steps);
    }
    return player.step() !== before;
  }

  #affordable() {
    return Math.min(MOST_STEPS, Math.max(1, Math.floor(BUDGET_MS / this.stepMs)));
  }

  #take(player, steps) {
    const since = performance.now();
    player.advance(steps);
    this.stepMs += 0.2 * ((performance.now() - since) / steps - this.stepMs);
  }

  #pursue(player) {
    const since = performance.now();
    player.go_towards(this.target);
    while (player.step() < this.target && performance.now() - since < 2 * BUDGET_MS) {
      this.#take(player, Math.min(this.#affordable(), this.target - player.step()));
    }
    if (player.step() >= this.target) {
      this.target = null;
      this.#owedS = 0;
    }
  }
}
