// How smooth the page is: node tests/browser/speed.mjs PROGRAM RUN  (after tests/browser/run fetch; not a test).
//
// Prints, for the last frames of a run folder: bytes of a frame and how long the program takes to hand it out; how long
// the page takes from the slider to the picture (new frames, and frames it has already); the script's time for a picture
// while the whole box is panned, and zoomed to an eighth of it; pictures a second then, with all the browser does.

import { resolve } from 'node:path';

const [, , program, folder] = process.argv;
process.env.LIVEBED_PROGRAM = resolve(program);
const { close, open, serving, until } = await import('./harness.mjs');

const { child, address } = await serving('watch', resolve(folder), '--port', '7393');
const page = await open(address);
await until(page, () => document.querySelector('output')?.textContent.includes('t = '));
await page.waitForTimeout(3000);  // the analysis of all frames

const measured = await page.evaluate(async () => {
  const slider = document.querySelector('input[type=range]'), output = document.querySelector('output'), plate = document.querySelector('.plate');
  const median = (times) => Number(times.sort((a, b) => a - b)[Math.floor(times.length / 2)].toFixed(1));
  const last = Number(slider.max), ks = Array.from({ length: Math.min(6, last) }, (_, n) => last - 1 - n);
  const fetched = [];
  let bytes = 0;
  for (const k of ks) {
    const began = performance.now();
    bytes = (await (await fetch(`data/frame/${k}`)).arrayBuffer()).byteLength;
    fetched.push(performance.now() - began);
  }
  const show = async (k) => {
    const before = output.textContent, began = performance.now();
    slider.value = k;
    slider.dispatchEvent(new Event('input'));
    while (output.textContent === before) await new Promise((done) => setTimeout(done, 1));
    await new Promise(requestAnimationFrame);
    return performance.now() - began;
  };
  const fresh = [], again = [];
  for (const k of ks) fresh.push(await show(k));
  for (const k of ks) again.push(await show(k));

  const ask = window.requestAnimationFrame;
  const panned = async () => {
    const spent = [];
    window.requestAnimationFrame = (act) => ask((t) => { const began = performance.now(); act(t); spent.push(performance.now() - began); });
    const box = plate.getBoundingClientRect(), began = performance.now(), count = 40;
    for (let n = 0; n < count; ++n) {
      plate.dispatchEvent(new WheelEvent('wheel', { deltaY: n % 2 ? 3 : -3, clientX: box.x + 0.5 * box.width, clientY: box.y + 0.8 * box.height, cancelable: true }));
      await new Promise((done) => ask(done));
    }
    window.requestAnimationFrame = ask;
    return [median(spent), Number(((1000 * count) / (performance.now() - began)).toFixed(1))];
  };
  const [whole, wholeRate] = await panned();
  const box = plate.getBoundingClientRect();
  plate.dispatchEvent(new WheelEvent('wheel', { deltaY: -1387, clientX: box.x + 0.5 * box.width, clientY: box.y + 0.8 * box.height, cancelable: true }));
  await new Promise((done) => ask(done));
  const [zoomed, zoomedRate] = await panned();
  const canvas = plate.querySelector('canvas');
  return { bytes, fetch_ms: median(fetched), show_new_ms: median(fresh), show_known_ms: median(again), picture_ms: whole, pictures_a_second: wholeRate,
    zoomed_picture_ms: zoomed, zoomed_pictures_a_second: zoomedRate, canvas: [canvas.width, canvas.height] };
});
console.log(JSON.stringify(measured));
child.kill();
await close();
