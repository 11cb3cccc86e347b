// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Makes small pictures of the presets for the page: `node assets.mjs ENGINE GALLERY OUT`. ENGINE is the module with the feature `make`; they are
// made of those in GALLERY.

import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [engine, gallery, out] = process.argv.slice(2);
const windfall = await import(pathToFileURL(resolve(engine, 'windfall_web.js')));
windfall.initSync({ module: readFileSync(join(engine, 'windfall_web_bg.wasm')) });

mkdirSync(out, { recursive: true });
// The page shows a preset without a picture by its name alone.
const names = windfall.presets().filter((_, index) => index % 2 === 0);
const pictured = names.filter((name) => existsSync(join(gallery, `${name}.png`)));
for (const name of pictured) writeFileSync(join(out, `${name}.jpg`), windfall.thumbnail(readFileSync(join(gallery, `${name}.png`))));
writeFileSync(join(out, 'list.json'), JSON.stringify(pictured));
