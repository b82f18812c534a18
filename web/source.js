// Where the page's data come from: the server of a running program, or the page itself.  Both answer to the same names
// (src/report/page_data.hpp) with the same bytes.

import { unpack } from './pack.js';

const decode = (bytes) => JSON.parse(new TextDecoder().decode(bytes));

/// Data frozen into report.html, compressed.
function frozenBytes(name) {
  const element = document.querySelector(`script[data-name="${name}"]`);
  if (!element) throw new Error(`this page holds no ${name}`);
  const packed = Uint8Array.from(atob(element.textContent), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer();
}

/// Data of the server.
async function servedBytes(name) {
  const answer = await fetch(`data/${name}`, { cache: 'no-store' });
  if (!answer.ok) throw new Error(`${name}: ${answer.status} ${await answer.text()}`);
  return answer.arrayBuffer();
}

/// One run: its head, its tables so far, and its frames on demand.
export class Run {
  #bytes;
  #prefix;
  #frames = new Map();

  constructor(live, prefix = '') {
    this.live = live;
    this.#bytes = live ? servedBytes : frozenBytes;
    this.#prefix = prefix;
    this.forget();
  }

  forget() {
    this.series = {};
    this.rows = 0;
    this.bed = { time: [], x: new Float32Array(), lines: [], rows: 0, level: null };
    this.analysis = {};
    this.motion = null;
    this.#frames.clear();
  }

  async #pack(name) { return unpack(await this.#bytes(this.#prefix + name)); }

  async readHead() { this.head = decode(await this.#bytes(`${this.#prefix}run.json`)); }

  /// Takes the rows that are new since the last call; true when there were any.
  async readTables() {
    const ask = (name, first) => this.#pack(this.live ? `${name}?first=${first}` : name);
    const series = await ask('series', this.rows);
    if (series.head.rows < this.rows) {  // cut by a run that went on from an older checkpoint
      this.forget();
      return this.readTables();
    }
    const fresh = series.head.rows > this.rows;
    this.rows = series.head.rows;
    for (const { name } of series.head.arrays)
      this.series[name] = joined(this.series[name] ?? new Float32Array(), series[name].raw);

    const bed = await ask('bed', this.bed.rows);
    if (bed.x) {
      const { raw, from, to } = bed.y;
      const width = bed.x.raw.length;
      this.bed.x = bed.x.raw;
      this.bed.level = bed.head.level_m;
      bed.time.raw.forEach((t, n) => {
        this.bed.time.push(t);
        this.bed.lines.push(Float32Array.from(raw.subarray(n * width, (n + 1) * width), (y) => from + (y * (to - from)) / 65535));
      });
      this.bed.rows = bed.head.rows;
    }
    return fresh;
  }

  async readAnalysis() { this.analysis = decode(await this.#bytes(`${this.#prefix}analysis.json`)); }
  async readMotion() { this.motion = await this.#pack('motion'); }

  /// Frame k of head.frames, kept while it is among the last two dozen asked for.
  frame(k) {
    const { n } = this.head.frames[k];
    if (!this.#frames.has(n)) this.#frames.set(n, this.#pack(`frame/${n}`));
    const frame = this.#frames.get(n);
    this.#frames.delete(n);
    this.#frames.set(n, frame);
    if (this.#frames.size > 24) this.#frames.delete(this.#frames.keys().next().value);
    return frame;
  }

  /// Index of the frame and of the bed line nearest to a time.
  nearestFrame(t) { return nearest(this.head.frames.map((frame) => frame.t_s), t); }
  nearestLine(t) { return this.bed.lines[nearest(this.bed.time, t)]; }
}

function joined(a, b) {
  const all = new Float32Array(a.length + b.length);
  all.set(a);
  all.set(b, a.length);
  return all;
}

function nearest(values, s) {
  let best = 0;
  values.forEach((v, n) => { if (Math.abs(v - s) < Math.abs(values[best] - s)) best = n; });
  return best;
}
