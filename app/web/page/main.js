// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The page: a scene that the module steps, its picture, and the controls around it.

import init, * as engine from './engine/windfall_web.js';
import { accept, take } from './files.js';
import * as link from './link.js';
import { complain, note } from './messages.js';
import { Meter } from './meter.js';
import { Pace } from './pace.js';
import { follow } from './pointer.js';
import { fill } from './scenes.js';
import { View } from './view.js';

/** Scene of a page that is asked for none. */
const FIRST_SCENE = 'autumn-park';
/** Milliseconds between two state hashes while time goes on: each reads the whole state. */
const HASH_MS = 500;
/** Milliseconds between two rounds of the other numbers. */
const NUMBERS_MS = 250;
/** Milliseconds after a change before the address of the page follows. */
const LINK_MS = 400;
/** Longest wait for a frame, in milliseconds. */
const PATIENCE_MS = 200;
/** Steps of the time bar at least. */
const BAR_STEPS = 3600;
/** Share of the leaves that a phone gets, unless the link says how many, and fewest leaves of a scene of which it gets a share. */
const PHONE = { share: 0.1, leaves: 5000 };
/** Most leaves of the slider: so many times those of the scene, and no more than so many. */
const MOST_LEAVES = { times: 8, count: 2_000_000 };
/** Notches of the slider of leaves. */
const NOTCHES = 1000;

const at = (id) => document.getElementById(id);
const pace = new Pace();
const meter = new Meter(at('graph'));

let player = null;
/** Scene that goes on: { preset } or { text, file }. */
let scene = null;
/** Number of the latest scene asked for: one that was asked for before is not waited for. */
let request = 0;
let hashed = { step: -1, at: 0 };
let numbersAt = 0;
let before = null;
let linkTimer = 0;
/** Fragment that the page itself has put into its address. */
let ownFragment = null;
let firstPictureMs = null;
/** Megabytes that had been fetched by then. */
let fetchedMb = 0;

const view = new View(at('picture'), {
  complain,
  without: doWithout,
  framed(ms) {
    meter.add(ms);
    if (firstPictureMs === null) [firstPictureMs, fetchedMb] = [performance.now(), resourceMb()];
    at('curtain').classList.add('gone');
  },
  async lost(reason) {
    complain(`The graphics device was lost: ${reason}. The leaves go on; the picture comes back on a new device.`);
    await view.open();
    if (player) view.show(player, await fetchPacks(player));
  },
});

// For whoever looks on from the console, and for the test.
globalThis.windfall = {
  engine, pace, view,
  get player() { return player; },
  get firstPictureMs() { return firstPictureMs; },
};

const say = (text) => { at('progress').textContent = text; };

/** Goes on without a picture: the leaves fall all the same. */
function doWithout(reason) {
  document.body.classList.add('plain');
  at('curtain').classList.remove('gone');
  dressCurtain();
  say(`${reason} The leaves fall all the same: numbers and state hash are those of the program.`);
}

/** Puts the picture of a preset behind the line of progress. */
function dressCurtain() {
  at('curtain').style.backgroundImage = scene?.preset === undefined ? '' : `url("presets/${encodeURIComponent(scene.preset)}.jpg")`;
}

/** A player of a scene, with another number of leaves if one is given. */
function playerOf(scene, leaves) {
  return scene.preset === undefined
    ? engine.Player.of_ron(scene.text, scene.file, leaves)
    : engine.Player.of_preset(scene.preset, leaves);
}

/** Begins a scene; if that cannot be, the one before goes on. */
async function begin(asked, { leaves, step, camera, isPlaying = true } = {}) {
  const mine = ++request;
  // Lets the browser show what was said before it is busy.
  await new Promise((done) => setTimeout(done));
  let next = playerOf(asked, leaves);
  if (matchMedia('(pointer: coarse)').matches && leaves === undefined && next.leaves() > PHONE.leaves) {
    const fewer = Math.round(next.leaves() * PHONE.share);
    next.free();
    next = playerOf(asked, fewer);
  }
  if (camera !== undefined) {
    try {
      next.set_camera(Float32Array.from(camera));
    } catch (error) {
      complain(error);
    }
  }
  const packs = await fetchPacks(next);
  if (mine !== request) return next.free();
  const former = player;
  [player, scene] = [next, asked];
  former?.free();
  pace.isPlaying = isPlaying;
  pace.target = step ?? null;
  hashed = { step: -1, at: 0 };
  meter.forget();
  if (document.body.classList.contains('plain')) dressCurtain();
  view.show(player, packs);
  describe();
  keepLink();
  if (player.sky() !== undefined) note(`${player.name()} names the sky ${player.sky()}: drop that file to see it. The state hash does not depend on it.`);
}

/** The same, with a message if it cannot be. */
const tryBegin = (asked, options) => begin(asked, options).catch(complain);

/** Begins what a link asks for. */
async function followLink(fragment) {
  const asked = link.read(fragment);
  const file = asked.file ?? 'linked.ron';
  const wanted = asked.ron === undefined ? { preset: asked.scene ?? FIRST_SCENE } : { text: await link.unpack(asked.ron), file };
  await begin(wanted, asked);
}

/** Packs of leaf pictures that have been asked for, by name: each is fetched once. */
const packs = new Map();

/** Bytes of a pack. */
async function fetchPack(name) {
  const answer = await fetch(`leaves/${name}.leaves`);
  if (!answer.ok) throw new Error(`leaves/${name}.leaves: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** The leaf pictures that a scene needs, pairs of name and bytes; those that cannot be fetched are left out, and asked for again another time. */
async function fetchPacks(player) {
  if (!navigator.gpu) return [];
  const fetched = player.leaf_packs().map(async (name) => {
    try {
      if (!packs.has(name)) packs.set(name, fetchPack(name));
      return [name, await packs.get(name)];
    } catch (error) {
      packs.delete(name);
      complain(error);
      return null;
    }
  });
  return (await Promise.all(fetched)).filter((pack) => pack !== null);
}

// Numbers and controls.

const whole = new Intl.NumberFormat('en');
const ms = (value) => (value === undefined ? '–' : `${value.toFixed(value < 10 ? 2 : 0)} ms`);

/** Bounds of the slider of leaves, which is logarithmic. */
function leafRange() {
  const own = player.own_leaves();
  return [player.fewest_leaves(), Math.max(Math.min(own * MOST_LEAVES.times, MOST_LEAVES.count), own)];
}

function sliderLeaves() {
  const [low, high] = leafRange();
  return Math.round(low * (high / low) ** (at('leaves').value / NOTCHES));
}

/** Shows what stays the same while a scene goes on. */
function describe() {
  const [low, high] = leafRange();
  document.title = `${player.title()} – Windfall`;
  at('title').textContent = player.title();
  at('leaves').value = high > low ? Math.round(NOTCHES * Math.log(player.leaves() / low) / Math.log(high / low)) : 0;
  at('leaves').disabled = high <= low;
  at('leaf-count').value = whole.format(player.leaves());
  at('compare').textContent = view.compares ? 'Stop comparing' : 'Compare';
  at('play').textContent = pace.isPlaying ? '❚❚' : '▶';
  at('play').setAttribute('aria-label', pace.isPlaying ? 'Pause' : 'Play');
}

/** Command that prints the same state hash. */
function command() {
  const quoted = /^[\w.-]+$/.test(player.name()) ? player.name() : `'${player.name().replaceAll("'", "'\\''")}'`;
  const leaves = player.leaves() === player.own_leaves() ? '' : ` --leaves ${player.leaves()}`;
  return `windfall simulate ${quoted} --steps ${hashed.step}${leaves} --backend cpu`;
}

/** Shows it in lines that end before options, not within them. */
function showCommand() {
  const parts = command().split(/ (?=--)/).map((part) => Object.assign(document.createElement('span'), { textContent: part }));
  at('command').replaceChildren(...parts.flatMap((part, number) => (number === 0 ? [part] : [' ', part])));
}

function showNumbers(now) {
  const step = player.step();
  const isStill = pace.target === null && !pace.isPlaying;
  if (step !== hashed.step && (isStill || now - hashed.at > HASH_MS)) {
    hashed = { step, at: now };
    at('hash').value = player.state_hash();
    at('hashed-step').value = whole.format(step);
    showCommand();
  }
  at('hash').classList.toggle('old', step !== hashed.step);
  at('clock').value = `${(step * player.dt_s()).toFixed(2)} s · step ${whole.format(step)}`;
  at('time').max = Math.max(BAR_STEPS, step, pace.target ?? 0);
  if (document.activeElement !== at('time')) at('time').value = pace.target ?? step;
  if (now - numbersAt < NUMBERS_MS) return;
  numbersAt = now;
  const [attached, falling, resting] = player.counts();
  at('falling').textContent = whole.format(falling);
  at('resting').textContent = whole.format(resting);
  at('attached').textContent = whole.format(attached);
  at('frame-ms').textContent = ms(meter.median());
  at('step-ms').textContent = ms(pace.stepMs);
  at('device-ms').textContent = ms(view.deviceMs());
  at('first-picture').textContent = firstPictureMs === null ? '–' : `after ${(firstPictureMs / 1000).toFixed(1)} s, ${fetchedMb.toFixed(1)} MB`;
  meter.draw();
}

/** Shows how far the simulator on WebGPU is from that on the processor. */
function showDifference(found) {
  if (found === undefined) {
    at('difference').textContent = 'Waiting for the graphics device …';
    return;
  }
  const { step, since, farthestM, otherStates } = found;
  const apart = farthestM === 0 ? 'no leaf is elsewhere' : `the farthest leaf is ${(1000 * farthestM).toPrecision(2)} mm away`;
  at('difference').textContent = `At step ${whole.format(step)}, ${whole.format(step - since)} after both were the same: ${apart}, ${whole.format(otherStates)} in another state.`;
}

/** Megabytes that the page has fetched. */
const resourceMb = () => {
  const sizes = performance.getEntriesByType('resource').map((entry) => entry.encodedBodySize);
  return sizes.reduce((sum, size) => sum + size, 0) / 1e6;
};

/** The fragment that begins what is seen now; null for a scene too long for links. */
async function fragment() {
  const ron = scene.preset === undefined ? await link.pack(scene.text) : undefined;
  if (ron === null) return null;
  return link.write({
    scene: scene.preset,
    ron,
    file: scene.file,
    leaves: player.leaves() === player.own_leaves() ? undefined : player.leaves(),
    step: pace.target ?? player.step(),
    camera: player.camera(),
    isPlaying: pace.isPlaying,
  });
}

/** Lets the address of the page follow, a moment after the last change. */
function keepLink() {
  clearTimeout(linkTimer);
  linkTimer = setTimeout(async () => {
    const own = await fragment();
    if (own !== null) {
      ownFragment = own;
      history.replaceState(null, '', own);
    }
  }, LINK_MS);
}

async function copy(text, done) {
  try {
    await navigator.clipboard.writeText(text);
    note(done);
  } catch {
    note(text);
  }
}

function setPlaying(isPlaying) {
  pace.isPlaying = isPlaying;
  describe();
  keepLink();
}

function seek(step) {
  pace.target = step;
  keepLink();
}

const takeFile = (file) => take(file, {
  scene: (text, name) => begin({ text, file: name }),
  sky: (bytes, name) => view.setSky(player, name, bytes),
}).catch(complain);

function wire() {
  const on = (id, kind, act) => at(id).addEventListener(kind, act);
  on('play', 'click', () => setPlaying(!pace.isPlaying));
  on('one', 'click', () => {
    setPlaying(false);
    seek(player.step() + 1);
  });
  on('time', 'input', () => seek(Number(at('time').value)));
  on('time', 'change', () => at('time').blur());
  on('leaves', 'input', () => { at('leaf-count').value = whole.format(sliderLeaves()); });
  on('leaves', 'change', () => tryBegin(scene, { leaves: sliderLeaves(), camera: player.camera(), isPlaying: pace.isPlaying }));
  on('detail', 'change', () => { view.detail = Number(at('detail').value); });
  let isFilled = false;
  on('choose', 'click', () => {
    // Pictures of presets are fetched by those alone who look at them.
    if (!isFilled) fill(at('scenes'), engine.presets(), (name) => tryBegin({ preset: name }));
    isFilled = true;
    at('scenes').showModal();
  });
  on('open', 'click', () => at('file').click());
  on('file', 'change', () => {
    for (const file of at('file').files) takeFile(file);
    at('file').value = '';
  });
  on('copy-command', 'click', () => copy(command(), 'The command is copied.'));
  on('compare', 'click', () => {
    try {
      view.setComparing(player, !view.compares);
    } catch (error) {
      complain(error);
    }
    at('compare').textContent = view.compares ? 'Stop comparing' : 'Compare';
  });
  on('copy-link', 'click', async () => {
    const own = await fragment();
    if (own === null) note('This scene is too long for a link: save it and send the file.');
    else copy(location.href.replace(/#.*$/, '') + own, 'The link is copied.');
  });
  on('save', 'click', () => {
    const address = URL.createObjectURL(new Blob([player.ron()], { type: 'text/plain' }));
    const name = player.name().endsWith('.ron') ? player.name() : `${player.name()}.ron`;
    Object.assign(document.createElement('a'), { href: address, download: name }).click();
    URL.revokeObjectURL(address);
  });
  on('home', 'click', () => {
    player.reset_camera();
    view.isStale = true;
    keepLink();
  });
  addEventListener('keydown', (event) => {
    const isFree = event.target === document.body || event.target === at('picture');
    if (event.key === ' ' && isFree) {
      event.preventDefault();
      setPlaying(!pace.isPlaying);
    }
  });
  addEventListener('hashchange', () => {
    if (location.hash !== ownFragment) followLink(location.hash).catch(complain);
  });
  follow(at('picture'), () => player, () => {
    view.isStale = true;
    keepLink();
  });
  accept(takeFile);
}

/** A round of the page: steps, the picture, the numbers. */
function round(now) {
  try {
    const sinceS = before === null ? 0 : (now - before) / 1000;
    before = now;
    // Both simulators go in lockstep while they are compared.
    if (!view.isBehind(player) && pace.go(player, sinceS)) view.isStale = true;
    if (view.compares) showDifference(view.difference(player));
    view.draw(player, now);
    showNumbers(now);
  } catch (error) {
    complain(error);
    // A trap leaves the module's memory as it happened to be: nothing is to be done with it any more.
    if (error instanceof WebAssembly.RuntimeError) return;
  }
  next();
}

/** Has the next round done: with the next frame, or a while later where a busy device holds frames up, or the page is out of sight. */
function next() {
  let isDone = false;
  const go = (now) => {
    if (isDone) return;
    isDone = true;
    clearTimeout(timer);
    round(now);
  };
  const timer = setTimeout(() => go(performance.now()), PATIENCE_MS);
  requestAnimationFrame(go);
}

try {
  await init();
  say('Building the scene …');
  const opened = view.open();
  try {
    await followLink(location.hash);
  } catch (error) {
    complain(error);
    await begin({ preset: FIRST_SCENE });
  }
  await opened;
  if (view.screen && !view.isShown) view.show(player, await fetchPacks(player));
  if (view.screen) say('Preparing the picture …');
  wire();
  next();
} catch (error) {
  say('The page cannot begin.');
  complain(error);
}
