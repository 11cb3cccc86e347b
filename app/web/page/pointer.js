// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The camera by pointer, wheel and keys.

/** Radians for a drag over the height of the canvas. */
const TURN_RAD = 3;
/** Factor of nearness for a pixel of the wheel. */
const WHEEL = 1.0015;
/** Radians for a press of an arrow key. */
const KEY_RAD = 0.06;
/** Pixels of a line of the wheel, where it counts lines. */
const LINE_PX = 16;

/** Lets `canvas` move the camera of the player that `player()` returns; `moved` is called after each move. */
export function follow(canvas, player, moved) {
  const fingers = new Map();
  const act = (move) => {
    if (player()) {
      move(player());
      moved();
    }
  };
  const distance = () => {
    const [a, b] = fingers.values();
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener('pointermove', (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const apart = fingers.size === 2 ? distance() : 0;
    const height = canvas.clientHeight;
    const [right, down] = [(event.clientX - before.x) / height, (event.clientY - before.y) / height];
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (fingers.size === 2) act((it) => it.zoom(distance() / Math.max(apart, 1)));
    else if (event.shiftKey || event.buttons === 4) act((it) => it.pan(-right, down));
    else act((it) => it.orbit(-right * TURN_RAD, down * TURN_RAD));
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY * LINE_PX : event.deltaY;
    act((it) => it.zoom(WHEEL ** -pixels));
  }, { passive: false });
  const keys = {
    ArrowLeft: (it) => it.orbit(-KEY_RAD, 0),
    ArrowRight: (it) => it.orbit(KEY_RAD, 0),
    ArrowUp: (it) => it.orbit(0, KEY_RAD),
    ArrowDown: (it) => it.orbit(0, -KEY_RAD),
    '+': (it) => it.zoom(1.1),
    '-': (it) => it.zoom(1 / 1.1),
  };
  canvas.addEventListener('keydown', (event) => {
    if (keys[event.key]) {
      event.preventDefault();
      act(keys[event.key]);
    }
  });
}
