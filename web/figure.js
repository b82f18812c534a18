// A figure: title, chart, legend, note, and buttons that save it as SVG and CSV.

import { chart, escaped, told } from './chart.js';

const paper = { ink: '#1d2126', dim: '#667080', rule: '#d5dae0', paper: '#fff',
  c0: '#2a78c2', c1: '#d9732e', c2: '#3a9a5b', c3: '#c22f4a', c4: '#8a5bb5', c5: '#8a8f98' };

export function save(name, text, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/// SVG that needs no page: variables become the colours of paper.
export const standalone = (svg) => `<?xml version="1.0" encoding="UTF-8"?>\n${svg.replace(/var\(--(\w+)\)/g, (_, name) => paper[name])}\n`;

const fileName = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');

/// A table of all curves, one row a point.
function csvOf(spec) {
  const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
  const number = (v) => (Number.isFinite(v) ? told(v, 7) : '');
  const lines = [`curve,${quoted(spec.x.name)},${quoted(spec.y.name)}`];
  spec.curves.forEach((curve) => curve.x.forEach((x, n) => lines.push(`${quoted(curve.name || spec.y.name)},${number(x)},${number(curve.y[n])}`)));
  return `${lines.join('\n')}\n`;
}

function legend(spec) {
  const item = (kind, colour, name) => `<span><i class="${kind}" style="--c:var(--c${colour})"></i>${escaped(name)}</span>`;
  return spec.curves.map((c, n) => (c.name ? item(c.dots ? 'dot' : c.dashed ? 'dash' : 'line', c.colour ?? n, c.name) : '')).join('')
    + (spec.bands ?? []).map((b) => item('band', b.colour ?? 3, b.name)).join('');
}

export const saveButtons = '<span class="save"><button type="button" title="save this figure as SVG">SVG</button><button type="button" title="save its numbers as CSV">CSV</button></span>';

export class Figure {
  #zoom = null;

  /// build: returns the spec of the chart (chart.js, and note, csv: a function) or null when there is nothing to show yet.
  constructor(title, build, { wide = false } = {}) {
    this.title = title;
    this.build = build;
    this.element = document.createElement('figure');
    if (wide) this.element.className = 'wide';
    this.element.innerHTML = `<figcaption><h3>${escaped(title)}</h3>${saveButtons}</figcaption>`
      + '<div class="plot"></div><div class="legend"></div><p class="note"></p>';
    const [svg, csv] = this.element.querySelectorAll('button');
    svg.onclick = () => save(`${fileName(title)}.svg`, standalone(this.drawn.svg), 'image/svg+xml');
    csv.onclick = () => save(`${fileName(title)}.csv`, this.spec.csv ? this.spec.csv() : csvOf(this.spec), 'text/csv');
    this.plot = this.element.querySelector('.plot');
    this.#listen();
  }

  /// Takes the data as they are now; draw() shows them.
  refresh() {
    this.spec = this.build();
    this.element.hidden = !this.spec;
  }

  draw() {
    if (!this.spec || !this.plot.clientWidth) return;
    const spec = this.#zoom ? { ...this.spec, x: { ...this.spec.x, from: this.#zoom[0], to: this.#zoom[1] } } : this.spec;
    this.drawn = chart(spec, this.plot.clientWidth);
    this.plot.innerHTML = this.drawn.svg;
    this.element.querySelector('.legend').innerHTML = legend(this.spec) + (this.spec.bar ?? '');
    const note = this.element.querySelector('.note');
    note.textContent = this.spec.note ?? '';
    note.hidden = !this.spec.note;
  }

  /// Moving tells values, dragging zooms along x, a double click shows all.
  #listen() {
    let from = null;
    const place = (event) => event.clientX - this.plot.getBoundingClientRect().left;
    this.plot.onpointerdown = (event) => { if (event.pointerType === 'mouse') from = place(event); };
    this.plot.onpointerup = (event) => {
      if (from !== null && Math.abs(place(event) - from) > 8) {
        this.#zoom = [from, place(event)].sort((a, b) => a - b).map(this.drawn.invert);
        this.draw();
      }
      from = null;
    };
    this.plot.ondblclick = () => { this.#zoom = null; this.draw(); };
    this.plot.onpointermove = (event) => this.#tell(place(event), from);
    this.plot.onpointerleave = () => this.plot.querySelector('.tell')?.remove();
  }

  #tell(p, from) {
    const svg = this.plot.querySelector('svg');
    if (!svg || !this.spec || this.spec.image) return;
    svg.querySelector('.tell')?.remove();
    const { box, invert, py } = this.drawn;
    if (p < box.left || p > box.left + box.w) return;
    const x = invert(p);
    const lines = [`${this.spec.x.name}: ${told(x, 3)}`];
    let dots = '';
    for (const [n, curve] of this.spec.curves.entries()) {
      if (!curve.name && this.spec.curves.length > 1) continue;
      let best = -1;
      for (let k = 0; k < curve.x.length; ++k)
        if (Number.isFinite(curve.y[k]) && (best < 0 || Math.abs(curve.x[k] - x) < Math.abs(curve.x[best] - x))) best = k;
      if (best < 0) continue;
      lines.push(`${curve.name || this.spec.y.name}: ${told(curve.y[best])}`);
      dots += `<circle cx="${this.drawn.px(curve.x[best])}" cy="${py(curve.y[best])}" r="4" style="fill:var(--c${curve.colour ?? n})"/>`;
    }
    const right = p > box.left + box.w / 2;
    const group = document.createElementNS('http://www.w3.org/2000/svg', 'g');
    group.setAttribute('class', 'tell');
    group.innerHTML = (from !== null ? `<rect x="${Math.min(from, p)}" y="${box.top}" width="${Math.abs(p - from)}" height="${box.h}" style="fill:var(--c0);opacity:.15"/>` : '')
      + `<path d="M${p} ${box.top}v${box.h}" style="stroke:var(--dim)"/>${dots}`
      + lines.map((text, k) => `<text x="${right ? p - 8 : p + 8}" y="${box.top + 16 + 15 * k}" text-anchor="${right ? 'end' : 'start'}" style="paint-order:stroke;stroke:var(--paper);stroke-width:4">${escaped(text)}</text>`).join('');
    svg.append(group);
  }
}
