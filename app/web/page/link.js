// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Contents of a link behind its #: scene, leaves, step, camera.

/** Most characters of a scene in a link; browsers and mail cut off longer ones. */
const MOST_PACKED = 64 << 10;
/** Most bytes of a scene's text, as in a file. */
export const MOST_TEXT = 4 << 20;

const toText = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
const toBytes = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (letter) => letter.charCodeAt(0));

/** All bytes of a stream; fails for more than `most`. */
async function gather(stream, most) {
  const parts = [];
  let length = 0;
  for (const reader = stream.getReader(); ;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > most) {
      await reader.cancel();
      throw new Error(`link: the scene is more than ${most} bytes; allowed: ${most}`);
    }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

const through = (bytes, transform) => new Blob([bytes]).stream().pipeThrough(transform);

/** A scene's text, compressed, in letters that links may have; null if it is too long for one. */
export async function pack(text) {
  const bytes = await gather(through(new TextEncoder().encode(text), new CompressionStream('deflate-raw')), Infinity);
  return bytes.length * 4 / 3 > MOST_PACKED ? null : toText(bytes);
}

/** The text that `pack` compressed. */
export async function unpack(packed) {
  try {
    const bytes = await gather(through(toBytes(packed), new DecompressionStream('deflate-raw')), MOST_TEXT);
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch (error) {
    if (error.message.startsWith('link:')) throw error;
    throw new Error('link: ron is cut off or changed; allowed: what "Copy link" gives');
  }
}

/** A whole number of a link; undefined if it is not there. */
function whole(fields, name, least) {
  const text = fields.get(name);
  if (text === null) return undefined;
  const number = Number(text);
  if (!/^\d{1,10}$/.test(text) || number < least || number > 0xffffffff) {
    throw new Error(`link: ${name} is '${text}'; allowed: a whole number from ${least} to 4294967295`);
  }
  return number;
}

/** Request of a fragment: { scene, ron, file, leaves, step, camera, isPlaying }. */
export function read(fragment) {
  const fields = new URLSearchParams(fragment.replace(/^#/, ''));
  const known = ['scene', 'ron', 'file', 'leaves', 'step', 'camera', 'play'];
  for (const name of fields.keys()) {
    if (!known.includes(name)) throw new Error(`link: '${name}' is no field; allowed: ${known.join(', ')}`);
  }
  const camera = fields.get('camera')?.split(',').map(Number);
  return {
    scene: fields.get('scene') ?? undefined,
    ron: fields.get('ron') ?? undefined,
    file: fields.get('file') ?? undefined,
    leaves: whole(fields, 'leaves', 1),
    step: whole(fields, 'step', 0),
    camera,
    isPlaying: fields.get('play') !== '0',
  };
}

/** The fragment that `read` reads. */
export function write({ scene, ron, file, leaves, step, camera, isPlaying }) {
  const fields = new URLSearchParams();
  if (ron) fields.set('ron', ron);
  else fields.set('scene', scene);
  if (ron && file) fields.set('file', file);
  if (leaves) fields.set('leaves', leaves);
  if (step) fields.set('step', step);
  // Single precision: nine digits give the same number back.
  if (camera) fields.set('camera', Array.from(camera, (number) => Number(number.toPrecision(9))).join(','));
  if (!isPlaying) fields.set('play', '0');
  return '#' + fields.toString().replaceAll('%2C', ',');
}
