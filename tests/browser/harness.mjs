// Runs of the program, and a browser that notes whatever it complains about.

import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import http from 'node:http';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { chromium } from 'playwright-core';

export const program = process.env.LIVEBED_PROGRAM;
export const folder = mkdtempSync(join(tmpdir(), 'livebed-browser-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

/// The quick case made smaller still, with frames close together; ends at `end` [s].
export function smallRun(out, end, ...more) {
  const keys = ['mesh.length=0.12', 'mesh.height=0.06', 'pipe.x=0.05', 'bed.count=500', 'time.spin_up=0.05', 'output.series_every=0.005',
    'output.bed_every=0.01', 'output.fields_every=0.02', 'output.checkpoint_every=0.1', `time.end=${end}`];
  return ['run', resolve('../../cases/quick'), '--out', out, '--no-bed-cache', '--quiet', ...keys.flatMap((key) => ['--set', key]), ...more];
}

export const livebed = (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8' });

const children = new Set();

/// Starts the program; resolves with the process and the address it tells.
export function serving(...words) {
  const child = spawn(program, words, { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
  children.add(child);
  child.ended = new Promise((done) => child.on('exit', (code, signal) => done(code ?? signal)));
  return new Promise((found, failed) => {
    let told = '';
    const listen = (text) => {
      told += text;
      const [address] = /http:\/\/127\.0\.0\.1:\d+\//.exec(told) ?? [];
      if (address) found({ child, address });
    };
    child.stdout.on('data', listen);
    child.stderr.on('data', listen);
    child.ended.then((code) => failed(new Error(`ended with ${code}: ${told}`)));
  });
}

/// A port that nobody uses now.
export function freePort() {
  return new Promise((found) => {
    const server = http.createServer().listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => found(port));
    });
  });
}

/// A bare request, with whatever headers: what a browser would not let a page send.
export function ask(address, { method = 'GET', headers = {}, body = '' } = {}) {
  return new Promise((done, failed) => {
    const request = http.request(address, { method, headers }, (answer) => {
      let text = '';
      answer.on('data', (part) => { text += part; }).on('end', () => done({ status: answer.statusCode, headers: answer.headers, text }));
    });
    request.on('error', failed);
    request.end(body);
  });
}

let browser;
export async function open(address, { width = 1280, height = 900, scheme = 'light' } = {}) {
  browser ??= await chromium.launch({ executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage'] });
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme });
  page.setDefaultTimeout(60000);
  page.complaints = [];
  page.requests = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) page.complaints.push(message.text()); });
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('request', (request) => { if (!/^(data|blob):/.test(request.url())) page.requests.push(request.url()); });
  await page.goto(address);
  return page;
}
/// Ends the browser and whatever a failed test has left running.
export async function close() {
  for (const child of children) child.kill('SIGKILL');
  await browser?.close();
}

/// Waits until a function of the page returns something true.
export const until = (page, holds, argument) => page.waitForFunction(holds, argument, { timeout: 60000 });

/// Colours of the picture of the moment at places (0 to 1, from the lower left corner), and how different its pixels are.
export function pixels(page, places) {
  return page.evaluate((wanted) => {
    const canvas = document.querySelector('.plate canvas'), copy = document.createElement('canvas');
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    const pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const all = pen.getImageData(0, 0, copy.width, copy.height).data;
    let sum = 0;
    for (let n = 0; n < all.length; ++n) sum = (sum * 31 + all[n]) % 1000000007;
    return { sum, colours: wanted.map(([x, y]) => [...pen.getImageData(Math.floor(x * copy.width), Math.floor((1 - y) * copy.height), 1, 1).data].slice(0, 3)) };
  }, places);
}

export async function changes(page, what, act) {
  const before = (await pixels(page, [])).sum;
  await act();
  await assert.doesNotReject(until(page, () => true));
  for (let n = 0; n < 300; ++n) {
    if ((await pixels(page, [])).sum !== before) return;
    await new Promise((done) => setTimeout(done, 100));
  }
  assert.fail(`${what} changed no pixel`);
}
