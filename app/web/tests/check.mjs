// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Drives the page in headless Chromium and compares its state hashes with those of the program: `node check.mjs PAGE WINDFALL
// CHROMIUM TABLE OUT`. PAGE is what scripts/web built, TABLE tests/state_hashes.csv; screenshots go to OUT.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { gzipSync } from 'node:zlib';

import { launch, serve } from './browser.mjs';
import { rows } from './state_hashes.mjs';

const [folder, program, chromium, table, out] = process.argv.slice(2);
/** Size of the page in pixels: software draws few. */
const SIZE = [960, 540];
/** Most bytes that the page fetches for its first picture. */
const MOST_BYTES = 4_000_000;
/** Longest run of the program, in milliseconds. */
const PROGRAM_MS = 180_000;
/** Least number of colours among the sampled pixels of a picture that shows something. */
const FEWEST_COLOURS = 500;
/** Largest distance of two leaves under the tolerant contract in a smooth wind, in metres. */
const FARTHEST_M = 2.5e-4;

const scratch = mkdtempSync(join(tmpdir(), 'windfall-check-'));
mkdirSync(out, { recursive: true });
const site = await serve(resolve(folder));
const browser = await launch(chromium);
let passed = 0;

async function test(name, body) {
  const since = Date.now();
  await body();
  passed += 1;
  console.log(`ok ${passed} - ${name} (${((Date.now() - since) / 1000).toFixed(1)} s)`);
}

/** State hash that the program prints. */
function native(scene, steps, ...options) {
  const line = ['simulate', scene, '--steps', String(steps), '--backend', 'cpu', '--json', ...options];
  return JSON.parse(execFileSync(program, line, { timeout: PROGRAM_MS, stdio: ['ignore', 'pipe', 'ignore'] })).state_hash;
}

/** Waits until the page has drawn so many frames. */
const drawn = (page, frames) => page.until(`windfall.view.frames >= ${frames}`);
/** Waits until the page shows the state hash of a step, and returns it. */
const shown = (page, step) => page.until(`document.getElementById('hashed-step').value.replaceAll(',', '') === '${step}' && windfall.player.step() === ${step} && document.getElementById('hash').value`);
const messages = (page) => page.run(`document.getElementById('messages').innerText`);
const message = (page, part) => page.until(`document.getElementById('messages').innerText.includes(${JSON.stringify(part)})`);
const dismiss = (page) => page.run(`document.querySelectorAll('#messages p').forEach((line) => line.remove())`);
/** The link that the page keeps in its address, once it says what is seen. */
const link = (page, part) => page.until(`location.hash.includes(${JSON.stringify(part)}) && location.href`);
/** Drops a file of this text on the page. */
const drop = (page, name, text) => page.run(`(() => {
  const data = new DataTransfer();
  data.items.add(new File([${text}], ${JSON.stringify(name)}));
  document.body.dispatchEvent(new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: data }));
})()`);
/** The page steps, and draws if it draws at all. */
async function goes_on(page) {
  await page.run('windfall.pace.isPlaying = true');
  const step = await page.run('windfall.player.step()');
  await page.until(`windfall.player.step() > ${step}`);
}

try {
  const page = await browser.page(...SIZE);

  await test('state hashes of presets are those of the program', async () => {
    await page.open(`${site.address}#scene=storm&leaves=500&step=300&play=0`);
    assert.equal(await shown(page, 300), native('storm', 300, '--leaves', '500'), 'storm with 500 leaves, as the page shows it');
    assert.equal(
      await page.run(`document.getElementById('command').textContent`),
      'windfall simulate storm --steps 300 --leaves 500 --backend cpu',
      'and the command for it',
    );
    // By the scenes' numbers of leaves, without a picture.
    for (const { scene, steps, hash } of rows(table)) {
      const own = await page.run(`(() => { const it = windfall.engine.Player.of_preset('${scene}'); it.advance(${steps}); const hash = it.state_hash(); it.free(); return hash; })()`);
      assert.equal(own, hash, `${scene} after ${steps} steps`);
    }
  });

  await test('the first picture comes, and of fewer bytes than allowed', async () => {
    // Of few leaves: software takes minutes for a frame of the first scene's crowns, so of that one only the bytes are counted.
    await page.open(`${site.address}#scene=storm&leaves=3000&step=90&play=0`);
    await drawn(page, 1);
    const { ms, bytes, largest } = await page.run(`(async () => {
      const first = windfall.engine.Player.of_preset('autumn-park');
      const mine = windfall.player.leaf_packs();
      for (const name of first.leaf_packs()) if (!mine.includes(name)) await (await fetch('leaves/' + name + '.leaves')).arrayBuffer();
      first.free();
      const entries = performance.getEntriesByType('resource');
      const bytes = entries.reduce((sum, entry) => sum + entry.encodedBodySize, 0);
      return { ms: windfall.firstPictureMs, bytes, largest: entries.map((entry) => [entry.encodedBodySize, entry.name.split('/').pop()]).sort((a, b) => b[0] - a[0]).slice(0, 12) };
    })()`);
    console.log(`# first picture of storm with 3,000 leaves after ${(ms / 1000).toFixed(1)} s; ${bytes} bytes with the leaves of autumn-park`);
    console.log(`# ${largest.map(([size, name]) => `${name} ${size}`).join(', ')}`);
    assert.ok(bytes > 0 && bytes < MOST_BYTES, `${bytes} bytes; allowed: below ${MOST_BYTES}`);
    await shown(page, 90);
    await page.until(`!windfall.view.isStale && !windfall.view.screen.is_busy()`);
    assert.equal(await messages(page), '', 'without a message');
    await page.until(`getComputedStyle(document.getElementById('curtain')).opacity === '0'`);
    const picture = await page.picture();
    writeFileSync(join(out, 'page.png'), picture);
    const colours = await page.run(`(async () => {
      const bitmap = await createImageBitmap(await (await fetch('data:image/png;base64,${picture.toString('base64')}')).blob());
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext('2d');
      context.drawImage(bitmap, 0, 0);
      // What lies beside the panels.
      const { data } = context.getImageData(20, 120, 600, 300);
      const seen = new Set();
      for (let at = 0; at < data.length; at += 4) seen.add(data[at] << 16 | data[at + 1] << 8 | data[at + 2]);
      return seen.size;
    })()`);
    assert.ok(colours > FEWEST_COLOURS, `${colours} colours; a picture has more than ${FEWEST_COLOURS}`);
  });

  await test('time goes back to the bit', async () => {
    await page.open(`${site.address}#scene=six-motions&step=240&play=0`);
    const later = await shown(page, 240);
    await page.run(`(() => { const bar = document.getElementById('time'); bar.value = 101; bar.dispatchEvent(new Event('input')); })()`);
    assert.equal(await shown(page, 101), native('six-motions', 101), 'back at step 101');
    await page.run(`(() => { const bar = document.getElementById('time'); bar.value = 240; bar.dispatchEvent(new Event('input')); })()`);
    assert.equal(await shown(page, 240), later, 'and forth');
  });

  await test('a link gives scene, step and camera back', async () => {
    await drawn(page, 1);
    const mouse = (type, x, y) => page.ask('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1 });
    const before = await page.run('Array.from(windfall.player.camera())');
    await mouse('mousePressed', 300, 300);
    await mouse('mouseMoved', 380, 330);
    await mouse('mouseReleased', 380, 330);
    const camera = await page.run('Array.from(windfall.player.camera())');
    assert.notDeepEqual(camera, before, 'a drag turns the camera');
    const address = await link(page, `camera=${Number(camera[0].toPrecision(9))},${Number(camera[1].toPrecision(9))},${Number(camera[2].toPrecision(9))},${Number(camera[3].toPrecision(9))}`);
    const hash = await shown(page, 240);
    await page.open(address);
    assert.equal(await shown(page, 240), hash, 'the state');
    assert.deepEqual(await page.run('Array.from(windfall.player.camera())'), camera, 'the camera');
    assert.equal(await page.run('windfall.pace.isPlaying'), false, 'and paused');
  });

  const text = `(name: "Dropped", seed: 3, sources: [(shape: Disc(center_m: (0.0, 6.0, 0.0), radius_m: 2.0), count: 300, release: Rate(per_s: 100.0, from_s: 0.0))])`;
  const file = join(scratch, 'dropped.ron');
  writeFileSync(file, text);
  await test('a dropped scene has the state hash of its file, also by its link', async () => {
    await drop(page, 'dropped.ron', JSON.stringify(text));
    await page.until(`windfall.player.title() === 'Dropped'`);
    await page.run(`(() => { windfall.pace.isPlaying = false; windfall.pace.target = 180; })()`);
    const hash = await shown(page, 180);
    assert.equal(hash, native(file, 180), 'as the program has it');
    await page.run(`document.getElementById('play').click()`);
    await page.run(`document.getElementById('play').click()`);
    const step = await page.until('!windfall.pace.isPlaying && windfall.player.step()');
    const address = await link(page, `step=${step}`);
    assert.match(address, /#ron=/, 'the scene is in the link');
    await page.open(address);
    assert.equal(await shown(page, step), native(file, step), 'from the link');
  });

  await test('bad links and files are refused with a line, and the scene goes on', async () => {
    const links = [
      ['scene=nope', "scene 'nope' is neither a file nor a preset"],
      ['ron=AAAA', 'link: ron is cut off or changed'],
      ['scene=storm&step=soon', "link: step is 'soon'; allowed: a whole number"],
      ['scene=storm&leaves=1', 'leaf count is 1; allowed:'],
      ['scene=six-motions&camera=1,2', 'camera: target z is NaN; allowed:'],
      ['colour=red', "link: 'colour' is no field"],
    ];
    for (const [fragment, part] of links) {
      await dismiss(page);
      await page.run(`location.hash = ${JSON.stringify(fragment)}`);
      await message(page, part);
      await goes_on(page);
    }
    const files = [
      ['huge.ron', `new Uint8Array(5 << 20)`, 'huge.ron: size is 5242880 bytes; allowed: 4194304'],
      ['leaf.txt', `'leaf'`, 'leaf.txt: neither a scene nor a sky'],
      ['bytes.ron', `new Uint8Array([255, 254, 0])`, 'bytes.ron: not UTF-8 text'],
      ['bad.ron', `'(wind: (speed: 99.0))'`, 'bad.ron:'],
      ['field.ron', `'(species: [(name: "a", leaves: Some("folder"))])'`, "field.ron: names the file 'folder'; allowed:"],
      ['many.ron', `'(sources: [(shape: Disc(center_m: (0.0, 6.0, 0.0), radius_m: 2.0), count: 20000000, release: Rate(per_s: 100000.0, from_s: 0.0))])'`, 'many.ron: leaves and particles need'],
      ['broken.hdr', `'#?RADIANCE'`, 'broken.hdr'],
    ];
    for (const [name, content, part] of files) {
      await dismiss(page);
      await drop(page, name, content);
      await message(page, part);
      await goes_on(page);
    }
    await dismiss(page);
  });

  await test('a broken pack of leaf pictures is refused, wherever it is cut off', async () => {
    await drawn(page, 1);
    const refused = await page.run(`(async () => {
      const whole = new Uint8Array(await (await fetch('leaves/birch.leaves')).arrayBuffer());
      const refused = [];
      for (let part = 0; part < 16; part += 1) {
        try {
          windfall.view.screen.give_leaves('birch', whole.subarray(0, Math.floor(whole.length * part / 16)));
          refused.push('taken');
        } catch (error) {
          refused.push(error.message);
        }
      }
      windfall.view.screen.give_leaves('birch', whole);
      return refused;
    })()`);
    assert.equal(refused.length, 16, 'all lengths are tried');
    for (const line of refused) assert.match(line, /^birch: .* is broken; allowed: what scripts\/leaf-packs writes$/, 'a line that names the part');
  });

  await test('a dropped sky is drawn', async () => {
    await page.open(`${site.address}#scene=six-motions&play=0`);
    await drawn(page, 1);
    const frames = await page.run('windfall.view.frames');
    // Radiance, 16 by 8 pixels, without run lengths: an even red light.
    await drop(page, 'red.hdr', `'#?RADIANCE\\nFORMAT=32-bit_rle_rgbe\\n\\n-Y 8 +X 16\\n', new Uint8Array(16 * 8 * 4).map((_, at) => [200, 40, 30, 128][at % 4])`);
    await drawn(page, frames + 1);
    assert.equal(await messages(page), '', 'without a message');
  });

  await test('the simulator on WebGPU stays near that on the processor', async () => {
    await page.open(`${site.address}#scene=six-motions&step=60&play=0`);
    await drawn(page, 1);
    await shown(page, 60);
    await page.run(`document.getElementById('compare').click()`);
    await page.run('windfall.pace.target = 180');
    await shown(page, 180);
    await page.until(`document.getElementById('difference').innerText.startsWith('At step 180, 120 after')`);
    const found = await page.run('windfall.view.difference(windfall.player)');
    console.log(`# six-motions after 120 steps: ${JSON.stringify(found)}`);
    assert.equal(found.otherStates, 0, 'all leaves in the same states');
    assert.ok(found.farthestM < FARTHEST_M, `${found.farthestM} m; allowed: below ${FARTHEST_M}`);
    assert.equal(await messages(page), '', 'without a message');
  });

  await test('a lost device is replaced', async () => {
    const frames = await page.run('windfall.view.frames');
    await page.run('windfall.view.screen.lose()');
    await page.run('windfall.view.isStale = true');
    await message(page, 'The graphics device was lost');
    await goes_on(page);
    await drawn(page, frames + 2);
  });

  await test('without WebGPU the page says so, and the numbers are right', async () => {
    const plain = await browser.page(...SIZE, 'delete Navigator.prototype.gpu;');
    await plain.open(`${site.address}#scene=storm&leaves=500&step=120&play=0`);
    assert.equal(await shown(plain, 120), native('storm', 120, '--leaves', '500'), 'the state hash');
    await plain.until(`document.getElementById('progress').innerText.includes('This browser has no WebGPU')`);
    writeFileSync(join(out, 'without-webgpu.png'), await plain.picture());
    // A fresh page with a broken link begins with the first scene; here, where nobody waits for its picture.
    await plain.open(`${site.address}#scene=nope`);
    await message(plain, "scene 'nope' is neither a file nor a preset");
    await plain.until(`windfall.player.name() === 'autumn-park'`);
    await goes_on(plain);
    await plain.close();
  });
} finally {
  await browser.close();
  site.close();
  rmSync(scratch, { recursive: true, force: true });
}
const raw = readFileSync(join(folder, 'engine', 'windfall_web_bg.wasm'));
console.log(`# module: ${raw.length} bytes, ${gzipSync(raw, { level: 9 }).length} compressed`);
console.log(`${passed} passed`);
