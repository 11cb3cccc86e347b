// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Headless Chromium by its own protocol over a pipe, with SwiftShader's WebGPU, and a server of the page that compresses as static hosts do.

import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { gzipSync } from 'node:zlib';

const KINDS = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.json': 'application/json',
  '.wasm': 'application/wasm', '.jpg': 'image/jpeg',
};
/** Longest wait for an answer, in milliseconds: software pipelines compile slowly. */
const PATIENCE_MS = 240_000;
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** Serves a folder on a free port; returns { address, close }. */
export async function serve(folder) {
  const kept = new Map();
  const server = createServer((request, answer) => {
    const path = normalize(new URL(request.url, 'http://localhost').pathname);
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    if (!file.startsWith(folder) || !existsSync(file)) return answer.writeHead(404).end();
    if (!kept.has(file)) kept.set(file, gzipSync(readFileSync(file), { level: 9 }));
    const kind = KINDS[extname(file)] ?? 'application/octet-stream';
    answer.writeHead(200, { 'content-type': kind, 'content-encoding': 'gzip', 'cache-control': 'no-store' }).end(kept.get(file));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** Starts Chromium; returns { page(width, height, prepare), close }. */
export async function launch(program) {
  const profile = mkdtempSync(join(tmpdir(), 'windfall-web-'));
  const flags = [
    '--headless=new', '--no-sandbox', '--remote-debugging-pipe', `--user-data-dir=${profile}`, '--enable-unsafe-webgpu',
    '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--use-angle=swiftshader', '--ignore-gpu-blocklist', '--no-first-run', '--disable-extensions', '--hide-scrollbars',
    '--disable-gpu-watchdog', 'about:blank',
  ];
  const child = spawn(program, flags, { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
  const [, , , to, from] = child.stdio;
  const waiting = new Map();
  let [number, rest] = [0, Buffer.alloc(0)];
  from.on('data', (part) => {
    rest = Buffer.concat([rest, part]);
    for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
      const message = JSON.parse(rest.subarray(0, end).toString());
      rest = rest.subarray(end + 1);
      if (message.id !== undefined) {
        const { done, fail } = waiting.get(message.id);
        waiting.delete(message.id);
        if (message.error) fail(new Error(message.error.message));
        else done(message.result);
      }
    }
  });
  const ended = new Promise((done) => child.on('exit', done));
  ended.then(() => waiting.forEach(({ fail }) => fail(new Error('Chromium ended'))));
  const send = (method, params = {}, sessionId) => new Promise((done, fail) => {
    number += 1;
    waiting.set(number, { done, fail });
    to.write(`${JSON.stringify({ id: number, method, params, sessionId })}\0`);
  });

  const page = async (width, height, prepare) => {
    const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
    const ask = (method, params) => send(method, params, sessionId);
    await ask('Page.enable');
    await ask('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    if (prepare) await ask('Page.addScriptToEvaluateOnNewDocument', { source: prepare });
    const run = async (expression) => {
      const { result, exceptionDetails } = await ask('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
      return result.value;
    };
    /** Waits until an expression is true, and returns its value. */
    const until = async (expression) => {
      const since = Date.now();
      for (;;) {
        const value = await run(`(() => { try { return ${expression}; } catch { return false; } })()`);
        if (value) return value;
        if (Date.now() - since > PATIENCE_MS) {
          const seen = await run('document.body.innerText.slice(0, 800)');
          throw new Error(`waited ${PATIENCE_MS} ms for ${expression}; the page says: ${seen}`);
        }
        await pause(50);
      }
    };
    return {
      ask, run, until,
      /** Goes to an address, as a new document. */
      async open(address) {
        await ask('Page.navigate', { url: 'about:blank' });
        await ask('Page.navigate', { url: address });
      },
      async picture() {
        const { data } = await ask('Page.captureScreenshot', { format: 'png' });
        return Buffer.from(data, 'base64');
      },
      close: () => send('Target.closeTarget', { targetId }),
    };
  };
  const close = async () => {
    send('Browser.close').catch(() => {});
    await Promise.race([ended, pause(5000).then(() => child.kill('SIGKILL'))]);
    rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  };
  return { page, close };
}
