// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The presets as pictures.

/** Fills the dialog with the presets, pairs of names and titles; `choose` is called with the name of one. */
export async function fill(dialog, pairs, choose) {
  const grid = dialog.querySelector('#grid');
  let pictured = [];
  try {
    pictured = await (await fetch('presets/list.json')).json();
  } catch {
    // Names do without pictures.
  }
  for (let at = 0; at < pairs.length; at += 2) {
    const [name, title] = [pairs[at], pairs[at + 1]];
    const card = document.createElement('button');
    card.type = 'button';
    card.dataset.scene = name;
    const view = document.createElement(pictured.includes(name) ? 'img' : 'span');
    view.className = 'view';
    if (pictured.includes(name)) Object.assign(view, { src: `presets/${name}.jpg`, alt: '', loading: 'lazy' });
    else view.textContent = title;
    const label = document.createElement('span');
    label.className = 'name';
    label.textContent = title;
    card.append(view, label);
    card.addEventListener('click', () => {
      dialog.close();
      choose(name);
    });
    grid.append(card);
  }
}
