// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Messages to the reader; the page goes on beneath them.

/** Milliseconds that a message stays which reports no trouble. */
const STAY_MS = 4000;
/** Most messages at once. */
const MOST = 4;

function show(text, kind, button) {
  const place = document.getElementById('messages');
  const line = document.createElement('p');
  line.className = kind;
  const words = document.createElement('span');
  words.textContent = text;
  const close = document.createElement('button');
  close.type = 'button';
  close.textContent = button?.label ?? 'Close';
  close.addEventListener('click', () => {
    line.remove();
    button?.action();
  });
  line.append(words, close);
  place.append(line);
  while (place.children.length > MOST) place.firstElementChild.remove();
  if (kind === 'note') setTimeout(() => line.remove(), STAY_MS);
}

/** A line that goes away by itself. */
export const note = (text) => show(text, 'note');

/** A line about what went wrong, which stays; of an error its message. */
export function complain(error) {
  const text = typeof error === 'string' ? error : error?.message ?? String(error);
  console.warn(text);
  if (error instanceof WebAssembly.RuntimeError) {
    show(`The simulator stopped: ${text}. The page must begin anew.`, 'error', { label: 'Reload', action: () => location.reload() });
  } else {
    show(text, 'error');
  }
}
