// The picture of a moment: the painter's canvas with pipe, bed line, streamlines and axes as SVG on top.  It can be
// zoomed, panned, moved in time and saved.

import { escaped, tickText, ticks, told } from './chart.js';
import { gradient } from './colour.js';
import { opened, quantities, scaleOf, streamlines } from './field.js';
import { save, saveButtons, standalone } from './figure.js';
import { Painter } from './painter.js';

/// The box, or of it what lies so many D before and behind the pipe, 3 D above its axis and below.
function around({ x, y, nx, ny }, pipe, [before, behind]) {
  const box = { x0: x[0], x1: x[nx], y0: y[0], y1: y[ny] };
  if (!pipe) return box;
  const { D_m: D, x_m, y_m } = pipe;
  return { x0: Math.max(box.x0, x_m - before * D), x1: Math.min(box.x1, x_m + behind * D), y0: Math.max(box.y0, y_m - 3 * D), y1: Math.min(box.y1, y_m + 3 * D) };
}

let overlays = 0;  // each overlay clips by its own name
const rim = { left: 40, right: 16, top: 8, bottom: 34 };

/// Pipe, lines and axes over a window of w x h pixels, as SVG text; lengths in D from the pipe and the original bed.
export function overlay(run, t, window, w, h, { lines = null } = {}) {
  const { pipe } = run.head, level = run.bed.level ?? (pipe ? pipe.y_m - pipe.D_m / 2 : 0);
  const unit = pipe?.D_m ?? 1, x0 = pipe?.x_m ?? 0;
  const px = (x) => rim.left + ((x - window.x0) / (window.x1 - window.x0)) * w;
  const py = (y) => rim.top + h - ((y - window.y0) / (window.y1 - window.y0)) * h;
  const at = (x, y) => `${px(x).toFixed(1)} ${py(y).toFixed(1)}`;
  const clip = `inside${++overlays}`;
  const parts = [`<clipPath id="${clip}"><rect x="${rim.left}" y="${rim.top}" width="${w}" height="${h}"/></clipPath><g clip-path="url(#${clip})">`];
  if (lines) parts.push(`<path d="${lines.map(([a, b, c, d]) => `M${at(a, b)}L${at(c, d)}`).join('')}" style="fill:none;stroke:#fff;stroke-width:1;opacity:.75"/>`);
  const line = run.bed.lines.length ? run.nearestLine(t) : null;
  if (line) {
    parts.push(`<path d="M${at(run.bed.x[0], level)}L${at(run.bed.x.at(-1), level)}" style="stroke:#6fe0ff;stroke-dasharray:7 5;stroke-width:1.4"/>`);
    parts.push(`<path d="M${Array.from(run.bed.x, (x, n) => at(x, line[n])).join('L')}" style="fill:none;stroke:#fff;stroke-width:2"/>`);
  }
  if (pipe) {
    const r = (0.5 * pipe.D_m / (window.x1 - window.x0)) * w;
    parts.push(`<circle cx="${px(pipe.x_m)}" cy="${py(pipe.y_m)}" r="${r}" style="fill:#dfe3e8;stroke:#1d2126;stroke-width:2"/>`);
  }
  const { measured, T_s } = run.head;
  for (const profile of (T_s && measured?.profiles) || [])
    if (Math.abs((t / T_s) * measured.T_s / profile.t_s - 1) < 0.15)
      profile.x_over_D.forEach((x, n) => parts.push(`<circle cx="${px(x0 + x * unit)}" cy="${py(level + profile.y_over_D[n] * unit)}" r="4" style="fill:#c22f4a;stroke:#fff"/>`));
  parts.push(`</g><rect x="${rim.left}" y="${rim.top}" width="${w}" height="${h}" style="fill:none;stroke:var(--dim)"/>`);
  const tx = ticks((window.x0 - x0) / unit, (window.x1 - x0) / unit, w / 80), ty = ticks((window.y0 - level) / unit, (window.y1 - level) / unit, h / 45);
  for (const s of tx.places) parts.push(`<path d="M${px(x0 + s * unit)} ${rim.top + h}v5" style="stroke:var(--dim)"/><text x="${px(x0 + s * unit)}" y="${rim.top + h + 17}" text-anchor="middle">${tickText(s, tx.step)}</text>`);
  for (const s of ty.places) parts.push(`<path d="M${rim.left} ${py(level + s * unit)}h-4" style="stroke:var(--dim)"/><text x="${rim.left - 6}" y="${py(level + s * unit) + 4}" text-anchor="end">${tickText(s, ty.step)}</text>`);
  parts.push(`<text x="${rim.left + w}" y="${rim.top + h + 31}" text-anchor="end" style="fill:var(--dim)">${pipe ? 'x/D from the pipe, y/D from the original bed' : 'x, y [m]'}</text>`);
  return parts.join('');
}

/// What the cells of a frame hold.
function cellsCsv({ x, y, nx, ny, u, v, p, solid }) {
  const lines = ['x_m,y_m,u_m_s,v_m_s,p_Pa,solid'];
  for (let j = 0; j < ny; ++j)
    for (let i = 0; i < nx; ++i) {
      const n = j * nx + i;
      lines.push([0.5 * (x[i] + x[i + 1]), 0.5 * (y[j] + y[j + 1]), u[n], v[n], p?.[n] ?? NaN, solid?.[n] ?? NaN].map((s) => (Number.isFinite(s) ? told(s, 6) : '')).join(','));
    }
  return `${lines.join('\n')}\n`;
}

const svgOpen = (w, h) => `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${w} ${h}" width="${w}" height="${h}" font-family="system-ui, sans-serif" font-size="12" style="fill:var(--ink)">`;

export class View {
  #queued = false;
  #scales = new Map();
  #pointers = new Map();

  constructor(run) {
    this.run = run;
    this.k = -1;
    this.following = true;
    this.quantity = 'speed';
    this.element = document.createElement('section');
    this.element.className = 'view';
    this.element.innerHTML = `<div class="tools"><span class="choices">${Object.keys(quantities).map((q) => `<button type="button" data-quantity="${q}">${q}</button>`).join('')}</span>
      <label><input type="checkbox" name="grains" checked> grains</label><label><input type="checkbox" name="streamlines"> streamlines</label>
      <span class="grow"></span><button type="button" name="in" title="zoom in">+</button><button type="button" name="out" title="zoom out">−</button>
      <button type="button" name="all" title="show all around the pipe">all</button><span class="save"><button type="button" name="svg">SVG</button><button type="button" name="csv">CSV</button></span></div>
      <div class="plate"><canvas></canvas><div class="over"></div></div>
      <div class="time"><button type="button" name="play" title="play">▶</button><input type="range" min="0" value="0" step="1" aria-label="time"><output></output></div>
      <div class="bars"></div>`;
    const find = (name) => this.element.querySelector(`[name=${name}]`);
    [this.plate, this.canvas, this.over] = ['.plate', 'canvas', '.over'].map((s) => this.element.querySelector(s));
    this.slider = this.element.querySelector('input[type=range]');
    this.painter = new Painter(this.canvas);
    this.options = { grains: find('grains'), streamlines: find('streamlines') };
    for (const box of Object.values(this.options)) box.onchange = () => this.queue();
    for (const button of this.element.querySelectorAll('[data-quantity]')) button.onclick = () => this.choose(button.dataset.quantity);
    find('in').onclick = () => this.zoom(0.6);
    find('out').onclick = () => this.zoom(1 / 0.6);
    find('all').onclick = () => { this.window = null; this.queue(); };
    find('svg').onclick = () => save('moment.svg', this.svg(), 'image/svg+xml');
    find('csv').onclick = () => save('moment.csv', cellsCsv(this.frame), 'text/csv');
    find('play').onclick = () => this.play();
    this.slider.oninput = () => { this.stop(); this.following = Number(this.slider.value) === this.run.head.frames.length - 1; this.show(Number(this.slider.value)); };
    addEventListener('redraw', () => this.queue());
    this.#listen();
  }

  /// New frames may have come: stay at the end when that is where one was.
  async update() {
    const last = this.run.head.frames.length - 1;
    this.element.hidden = last < 0;
    if (last < 0) return;
    this.slider.max = last;
    this.slider.disabled = last === 0;
    if (this.following || this.k > last) await this.show(last);
  }

  async show(k) {
    this.k = k;
    this.slider.value = k;
    const pack = await this.run.frame(k);
    if (this.k !== k) return;  // the slider has gone on meanwhile
    if (this.frame?.pack !== pack) this.frame = opened(pack);
    this.#load();
  }

  choose(quantity) {
    this.quantity = quantity;
    if (this.frame) this.#load();
  }

  /// Colours of the chosen quantity; its scale only grows, so that colours mean the same from frame to frame.
  #load() {
    const chosen = quantities[this.quantity], values = chosen.of(this.frame);
    if (!values) return this.choose('speed');
    const [from, to] = scaleOf(values, chosen), known = this.#scales.get(this.quantity) ?? [from, to];
    const scale = [Math.min(from, known[0]), Math.max(to, known[1])];
    this.#scales.set(this.quantity, scale);
    this.painter.load(this.frame, values, ...scale, chosen.map);
    const { grain_speed: speed } = this.frame.pack;
    this.grainEnd = Math.max(this.grainEnd ?? 0.01, speed ? 0.5 * speed.to : 0);
    const bar = (name, from_, to_, map) => `<div class="bar"><span>${escaped(name)}</span><b>${told(from_, 3)}</b><i style="background:${gradient(map)}"></i><b>${told(to_, 3)}</b></div>`;
    this.element.querySelector('.bars').innerHTML = bar(`${chosen.name} [${chosen.unit}]`, ...scale, chosen.map)
      + (this.frame.grains ? bar('speed of the grains [m/s]', 0, this.grainEnd, 'sand') : '');
    for (const button of this.element.querySelectorAll('[data-quantity]')) button.setAttribute('aria-pressed', button.dataset.quantity === this.quantity);
    const { T_s, frames } = this.run.head, t = frames[this.k].t_s;
    this.element.querySelector('output').textContent = `t = ${told(t, 4)} s${T_s ? `, t/T = ${(t / T_s).toFixed(2)}` : ''}`;
    this.lines = null;
    this.queue();
  }

  get #whole() {
    const { pipe } = this.run.head, { x, nx } = this.frame;
    return around(this.frame, pipe, pipe && x[nx] - x[0] < 12 * pipe.D_m ? [Infinity, Infinity] : [4, 8]);
  }

  zoom(factor, sx = 0.5, sy = 0.5) {
    const w = this.shown;
    const length = Math.min((w.x1 - w.x0) * factor, 4 * (this.frame.x[this.frame.nx] - this.frame.x[0])), height = (length * this.h) / this.w;
    const x = w.x0 + sx * (w.x1 - w.x0), y = w.y0 + sy * (w.y1 - w.y0);
    this.window = { x0: x - sx * length, x1: x + (1 - sx) * length, y0: y - sy * height, y1: y + (1 - sy) * height };
    this.queue();
  }

  pan(dx, dy) {
    const w = this.shown, sx = ((w.x1 - w.x0) * dx) / this.w, sy = ((w.y1 - w.y0) * dy) / this.h;
    this.window = { x0: w.x0 - sx, x1: w.x1 - sx, y0: w.y0 + sy, y1: w.y1 + sy };
    this.queue();
  }

  queue() {
    if (this.#queued) return;
    this.#queued = true;
    requestAnimationFrame(() => { this.#queued = false; this.draw(); });
  }

  draw() {
    const width = this.plate.clientWidth;
    if (!this.frame || !width) return;
    const whole = this.#whole;
    this.w = Math.max(50, width - rim.left - rim.right);
    this.h = Math.round(Math.min((this.w * (whole.y1 - whole.y0)) / (whole.x1 - whole.x0), 0.75 * innerHeight));
    const length = whole.x1 - whole.x0, height = (length * this.h) / this.w;
    this.shown = this.window ?? { ...whole, y1: whole.y0 + height };
    if (this.window) this.shown.y1 = this.shown.y0 + ((this.shown.x1 - this.shown.x0) * this.h) / this.w;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    Object.assign(this.canvas.style, { left: `${rim.left}px`, top: `${rim.top}px`, width: `${this.w}px`, height: `${this.h}px` });
    const [pw, ph] = [Math.round(this.w * ratio), Math.round(this.h * ratio)];
    if (this.canvas.width !== pw || this.canvas.height !== ph) Object.assign(this.canvas, { width: pw, height: ph });
    this.plate.style.height = `${this.h + rim.top + rim.bottom}px`;
    this.painter.draw(this.shown, { grains: this.options.grains.checked, grainEnd: this.grainEnd, paper: paperColour() });
    if (this.options.streamlines.checked) this.lines ??= streamlines(this.frame, this.run.head.pipe);
    this.overlay = overlay(this.run, this.frame.time, this.shown, this.w, this.h, { lines: this.options.streamlines.checked ? this.lines : null });
    this.over.innerHTML = `${svgOpen(this.w + rim.left + rim.right, this.h + rim.top + rim.bottom)}${this.overlay}</svg>`;
  }

  svg() {
    this.draw();
    const image = `<image href="${this.canvas.toDataURL()}" x="${rim.left}" y="${rim.top}" width="${this.w}" height="${this.h}"/>`;
    return standalone(`${svgOpen(this.w + rim.left + rim.right, this.h + rim.top + rim.bottom)}${image}${this.overlay}</svg>`);
  }

  play() {
    if (this.playing) return this.stop();
    const button = this.element.querySelector('[name=play]');
    button.textContent = '❚❚';
    this.following = false;
    const next = async () => {
      const last = this.run.head.frames.length - 1;
      await this.show(this.k >= last ? 0 : this.k + 1);
      if (this.playing) this.playing = setTimeout(next, 120);
    };
    this.playing = setTimeout(next, 0);
  }

  stop() {
    clearTimeout(this.playing);
    this.playing = null;
    this.element.querySelector('[name=play]').textContent = '▶';
  }

  /// Wheel and pinch zoom, dragging pans, a double click shows all.
  #listen() {
    const { plate } = this;
    const place = (event) => { const box = plate.getBoundingClientRect(); return [event.clientX - box.left - rim.left, event.clientY - box.top - rim.top]; };
    plate.addEventListener('wheel', (event) => {
      if (!this.frame) return;
      event.preventDefault();
      const [x, y] = place(event);
      this.zoom(1.0015 ** event.deltaY, x / this.w, 1 - y / this.h);
    }, { passive: false });
    plate.onpointerdown = (event) => { this.#pointers.set(event.pointerId, place(event)); plate.setPointerCapture(event.pointerId); };
    plate.onpointermove = (event) => {
      if (!this.frame || !this.#pointers.has(event.pointerId)) return;
      const before = [...this.#pointers.values()], now = place(event), was = this.#pointers.get(event.pointerId);
      this.#pointers.set(event.pointerId, now);
      if (before.length === 1) return this.pan(now[0] - was[0], now[1] - was[1]);
      const [a, b] = before, [c, d] = [...this.#pointers.values()], apart = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) || 1;
      this.zoom(apart(a, b) / apart(c, d), (c[0] + d[0]) / 2 / this.w, 1 - (c[1] + d[1]) / 2 / this.h);
    };
    plate.onpointerup = plate.onpointercancel = (event) => this.#pointers.delete(event.pointerId);
    plate.ondblclick = () => { this.window = null; this.queue(); };
  }
}

function paperColour() {
  return (getComputedStyle(document.body).backgroundColor.match(/[\d.]+/g) ?? [255, 255, 255]).slice(0, 3).map(Number);
}

/// Small pictures of chosen moments, all on one scale, the last with streamlines.
export async function stagePictures(run, times, holder) {
  const { pipe } = run.head;
  const ks = [...new Set(times.map((t) => run.nearestFrame(t)))];
  const frames = await Promise.all(ks.map(async (k) => opened(await run.frame(k))));
  const end = Math.max(...frames.map((frame) => scaleOf(quantities.speed.of(frame), quantities.speed)[1]));
  const grainEnd = Math.max(0.01, ...frames.map((frame) => 0.5 * (frame.pack.grain_speed?.to ?? 0)));
  const w = 520, painter = new Painter(document.createElement('canvas'));
  holder.innerHTML = '';
  for (const [n, frame] of frames.entries()) {
    const box = around(frame, pipe, [3, 5]);
    const h = Math.round((w * (box.y1 - box.y0)) / (box.x1 - box.x0));
    Object.assign(painter.canvas, { width: 2 * w, height: 2 * h });
    painter.load(frame, quantities.speed.of(frame), 0, end, 'viridis');
    painter.draw(box, { grainEnd });
    const t = run.head.frames[ks[n]].t_s;
    const lines = n === frames.length - 1 ? streamlines(frame, pipe) : null;
    const svg = `${svgOpen(w + rim.left + rim.right, h + rim.top + rim.bottom)}<image href="${painter.canvas.toDataURL('image/jpeg', 0.85)}" x="${rim.left}" y="${rim.top}" width="${w}" height="${h}"/>${overlay(run, t, box, w, h, { lines })}</svg>`;
    const figure = document.createElement('figure');
    figure.innerHTML = `<figcaption><h3>t = ${told(t, 3)} s${run.head.T_s ? `, t/T = ${(t / run.head.T_s).toFixed(2)}` : ''}${lines ? ', with streamlines' : ''}</h3>${saveButtons}</figcaption>${svg}`;
    const [asSvg, asCsv] = figure.querySelectorAll('button');
    asSvg.onclick = () => save(`moment-${told(t, 3)}-s.svg`, standalone(svg), 'image/svg+xml');
    asCsv.onclick = () => save(`moment-${told(t, 3)}-s.csv`, cellsCsv(frame), 'text/csv');
    holder.append(figure);
  }
}
