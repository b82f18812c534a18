// The page of a run that is going on: it follows, its buttons work, and nobody else's do.

import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import http from 'node:http';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { ask, changes, close, folder, freePort, open, serving, smallRun, until } from './harness.mjs';

const run = (name) => join(folder, 'live', name);
const pill = (page, text) => until(page, (wanted) => document.querySelector('.pill')?.textContent.includes(wanted), text);
let port, address, child, page;

before(async () => {
  port = await freePort();
  ({ child, address } = await serving(...smallRun('live', 1000, '--watch', '--port', String(port))));
  page = await open(address);
});
after(close);

test('opens while the bed is packed and follows into digging', async () => {
  await pill(page, 'digging');
  await until(page, () => document.querySelector('output')?.textContent.includes('t = ') && document.querySelectorAll('figure svg').length > 5);
  assert.match(await page.textContent('.told'), /t = .* of 1000 s · S\/D = .* left/);
  await changes(page, 'a new frame', () => {});
  const [told] = (await page.textContent('output')).match(/[\d.]+ s/);
  await until(page, (before) => !document.querySelector('output').textContent.includes(before), told);
});

test('pauses, goes on and writes a checkpoint', async () => {
  await page.click('[data-command=pause]');
  await pill(page, 'paused');
  const seen = readdirSync(run('checkpoints')).join();
  await page.click('[data-command=checkpoint]');
  await until(page, () => document.querySelector('.answer').textContent === 'asked: checkpoint');
  for (let n = 0; n < 300 && !/as asked/.test(readFileSync(run('log.txt'), 'utf8')); ++n) await new Promise((done) => setTimeout(done, 100));
  assert.match(readFileSync(run('log.txt'), 'utf8'), /checkpoint at t = .*, as asked/);
  assert.ok(readdirSync(run('checkpoints')).length > 0, seen);
  await page.click('[data-command=go]');
  await pill(page, 'digging');
});

test('refuses other hosts, other origins, other pages and wrong tokens', async () => {
  const stop = (headers) => ask(`${address}command`, { method: 'POST', body: 'stop', headers });
  const token = await page.evaluate(() => JSON.parse(document.getElementById('settings').textContent).token);
  assert.match(token, /^[0-9a-f]{32}$/);
  for (const headers of [{}, { 'X-Livebed-Token': 'wrong' }, { 'X-Livebed-Token': '0'.repeat(32) }, { 'X-Livebed-Token': token, Origin: 'http://elsewhere.example' },
    { 'X-Livebed-Token': token, Origin: 'null' }, { 'X-Livebed-Token': token, Host: `elsewhere.example:${port}` }, { 'X-Livebed-Token': token, 'Sec-Fetch-Site': 'cross-site' }])
    assert.equal((await stop(headers)).status, 403, JSON.stringify(headers));
  for (const headers of [{ Host: `elsewhere.example:${port}` }, { Origin: 'http://elsewhere.example' }, { 'Sec-Fetch-Site': 'same-site' }])
    assert.equal((await ask(`${address}data/run.json`, { headers })).status, 403, JSON.stringify(headers));
  assert.equal((await ask(address, { headers: { Host: `elsewhere.example:${port}` } })).status, 403);
  assert.equal((await ask(`${address}command`, { method: 'POST', body: 'dance', headers: { 'X-Livebed-Token': token } })).status, 400);
  assert.equal((await ask(`${address}command`, { method: 'POST', body: 'x'.repeat(1000), headers: { 'X-Livebed-Token': token } })).status, 413);
  assert.equal((await ask(`${address}command`)).status, 404);
  assert.equal((await ask(`${address}data/../case.resolved.toml`)).status, 404);
  const answer = await ask(address);
  assert.match(answer.headers['content-security-policy'], /default-src 'none'.*frame-ancestors 'none'/);
  assert.equal(answer.headers['x-frame-options'], 'DENY');
  assert.ok(!('access-control-allow-origin' in answer.headers));
});

test('a page from elsewhere can neither read nor stop the run', async () => {
  const elsewhere = http.createServer((_, answer) => answer.setHeader('Content-Type', 'text/html').end('<p>elsewhere</p>'));
  await new Promise((done) => elsewhere.listen(0, '127.0.0.1', done));
  const other = await open(`http://127.0.0.1:${elsewhere.address().port}/`);
  const outcome = await other.evaluate(async (target) => {
    const read = await fetch(`${target}data/run.json`).then((a) => a.text(), () => 'refused');
    await fetch(`${target}command`, { method: 'POST', mode: 'no-cors', body: 'stop' }).catch(() => {});
    const frame = Object.assign(document.createElement('iframe'), { src: target });
    document.body.append(frame);
    await new Promise((done) => { frame.onload = done; });
    let inside = 'refused';
    try { inside = frame.contentDocument?.body?.innerText ?? 'refused'; } catch { /* another origin, as it should be */ }
    return [read, inside];
  }, address);
  assert.deepEqual(outcome, ['refused', 'refused']);
  await other.close();
  elsewhere.close();
  await new Promise((done) => setTimeout(done, 600));
  assert.ok(existsSync(run('status.json')), 'the run has stopped');
});

test('stops the run, outlives it and a restart of the server', async () => {
  page.on('dialog', (dialog) => dialog.accept());
  await page.click('[data-command=stop]');
  assert.equal(await child.ended, 143);
  await pill(page, 'ended: stopped by a signal');
  assert.ok(await page.isDisabled('[data-command=stop]'));
  assert.deepEqual(page.complaints, []);

  // The server beside the run stays while the page asks; another one must take another port.
  const second = await serving('watch', 'live');
  assert.notEqual(second.address, address);
  const other = await open(second.address);
  await pill(other, 'ended');
  second.child.kill('SIGKILL');
  await second.child.ended;
  await pill(other, 'no answer');
  const third = await serving('watch', 'live', '--port', new URL(second.address).port);
  assert.equal(third.address, second.address);
  await pill(other, 'ended: stopped by a signal');  // it has loaded itself anew, with the new token
  await changes(other, 'the slider', () => other.locator('input[type=range]').fill('0'));
  third.child.kill('SIGTERM');
  // What a browser says when nobody answers, or of an answer the kill cut short, is not the page's fault.
  const cut = /net::ERR_(CONNECTION|EMPTY|SOCKET|CONTENT_LENGTH_MISMATCH|INCOMPLETE_CHUNKED)/;
  assert.deepEqual(other.complaints.filter((text) => !cut.test(text)), []);
  await other.close();
});
