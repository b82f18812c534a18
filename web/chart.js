// Charts as SVG text: one drawing for the screen, for paper and for saving.  Colours are the page's CSS variables.

let charts = 0;  // each chart clips by its own name
const rim = { right: 14, top: 10, bottom: 40 };

/// Round numbers within [from, to], about `wanted` of them: {step, places}.
export function ticks(from, to, wanted) {
  if (!(to > from) || !Number.isFinite(to - from)) return { step: 1, places: [] };
  const rough = (to - from) / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  const lead = rough / power;
  const step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  const places = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k) places.push(k * step);
  return { step, places };
}

export function tickText(place, step) {
  if (Math.abs(place) < 1e-9 * step) return '0';
  const size = Math.max(Math.abs(place), step), decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (size < 1e5 && (decimals < 5 || (size >= 1e-3 && decimals < 8))) return place.toFixed(decimals);
  return place.toExponential(Math.max(0, Math.floor(Math.log10(size)) - Math.floor(Math.log10(step) + 1e-9))).replace('e+', 'e');
}

export const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/// A number for people: four digits.
export function told(v, digits = 4) {
  if (v === null || v === undefined || !Number.isFinite(v)) return '–';
  if (v === 0) return '0';
  const size = Math.abs(v);
  return size >= 1e5 || size < 1e-3 ? v.toExponential(digits - 2) : String(Number(v.toPrecision(digits)));
}

function range(axis, values, usable) {
  let from = Infinity, to = -Infinity;
  for (const list of values) for (const v of list) if (usable(v)) { if (v < from) from = v; if (v > to) to = v; }
  if (!(to >= from)) [from, to] = axis.log ? [1e-1, 1] : [0, 1];
  if (axis.log && to < 100 * from) [from, to] = [10 ** Math.floor(Math.log10(from)), 10 ** Math.ceil(Math.log10(1.001 * to))];
  if (axis.log) return [axis.from ?? from, axis.to ?? to];
  const slack = to > from ? 0.04 * (to - from) : 0.05 * Math.abs(to) || 0.5;
  return [axis.from ?? from - (axis.tight ? 0 : slack), axis.to ?? to + (axis.tight ? 0 : slack)];
}

/// Smallest and largest value in each column of pixels: what a long curve looks like, with no peak lost.
function thinned(points) {
  const kept = [];
  let column = null, group = [];
  const close = () => {
    if (group.length <= 4) return kept.push(...group);
    const ys = group.map((p) => p[1]);
    const low = ys.indexOf(Math.min(...ys)), high = ys.indexOf(Math.max(...ys));
    kept.push(...[...new Set([0, Math.min(low, high), Math.max(low, high), group.length - 1])].map((k) => group[k]));
  };
  for (const p of points) {
    if (Math.round(p[0]) !== column) { close(); column = Math.round(p[0]); group = []; }
    group.push(p);
  }
  close();
  return kept;
}

/// spec: {x, y: {name, from, to, log (y), tight}, curves: [{name, x, y, colour, dots, dashed}], marks: [{x, name}],
/// bands: [{from, to, name}], image: {url, x0, x1, y0, y1}, shapes: SVG text made by a function of (px, py), height, equal}.
/// Returns {svg, px, py, invert, box}.
export function chart(spec, width) {
  const xs = spec.curves.map((c) => c.x), ys = spec.curves.map((c) => c.y);
  const [x0, x1] = range({ tight: true, ...spec.x }, spec.image ? [...xs, [spec.image.x0, spec.image.x1]] : xs, Number.isFinite);
  const inside = spec.curves.map((c) => Array.from(c.y).filter((_, n) => c.x[n] >= x0 && c.x[n] <= x1));
  const extra = [...(spec.bands ?? []).map((b) => [b.from, b.to]), ...(spec.image ? [[spec.image.y0, spec.image.y1]] : [])];
  const usable = (v) => Number.isFinite(v) && (!spec.y.log || v > 0);
  const [y0, y1] = range(spec.y, [...inside, ...extra], usable);
  const f = spec.y.log ? Math.log10 : (v) => v;
  const heightOf = (w) => (spec.equal ? Math.round((w * (y1 - y0)) / (x1 - x0)) : (spec.height ?? 250) - rim.top - rim.bottom);
  const ty = spec.y.log
    ? { places: Array.from({ length: Math.floor(f(y1) + 1e-9) - Math.ceil(f(y0) - 1e-9) + 1 }, (_, k) => 10 ** (Math.ceil(f(y0) - 1e-9) + k)) }
    : ticks(y0, y1, heightOf(width - 70) / 40);
  const names = ty.places.map((t) => (spec.y.log ? t.toExponential(0).replace('e+', 'e') : tickText(t, ty.step)));
  const margin = { ...rim, left: 32 + 6.6 * Math.max(2, ...names.map((name) => name.length)) };
  const w = Math.max(60, width - margin.left - margin.right), h = heightOf(w), height = h + margin.top + margin.bottom;
  const px = (x) => margin.left + ((x - x0) / (x1 - x0)) * w;
  const py = (y) => margin.top + h - ((f(y) - f(y0)) / (f(y1) - f(y0))) * h;
  const at = (x, y) => `${x.toFixed(1)} ${y.toFixed(1)}`;

  const parts = [];
  if (spec.image)
    parts.push(`<image href="${spec.image.url}" x="${px(spec.image.x0)}" y="${py(spec.image.y1)}" width="${px(spec.image.x1) - px(spec.image.x0)}"`
      + ` height="${py(spec.image.y0) - py(spec.image.y1)}" preserveAspectRatio="none"/>`);
  for (const band of spec.bands ?? [])
    parts.push(`<rect x="${margin.left}" y="${py(band.to)}" width="${w}" height="${Math.max(0, py(band.from) - py(band.to))}" style="fill:var(--c${band.colour ?? 3});opacity:.14"/>`);
  const tx = ticks(x0, x1, w / 75);
  const rule = spec.image ? 'stroke:none' : 'stroke:var(--rule)';
  for (const t of tx.places)
    parts.push(`<path d="M${at(px(t), margin.top)}V${margin.top + h}" style="${rule}"/><text x="${px(t).toFixed(1)}" y="${margin.top + h + 16}" text-anchor="middle">${tickText(t, tx.step)}</text>`);
  ty.places.forEach((t, n) => parts.push(`<path d="M${at(margin.left, py(t))}h${w}" style="${rule}"/><text x="${(margin.left - 6).toFixed(1)}" y="${(py(t) + 4).toFixed(1)}" text-anchor="end">${names[n]}</text>`));
  if (spec.y.from === undefined && !spec.y.log && y0 < 0 && y1 > 0 && !spec.image)
    parts.push(`<path d="M${at(margin.left, py(0))}h${w}" style="stroke:var(--dim)"/>`);
  const clip = `clip${++charts}`;
  parts.push(`<clipPath id="${clip}"><rect x="${margin.left}" y="${margin.top}" width="${w}" height="${h}"/></clipPath><g clip-path="url(#${clip})">`);
  if (spec.shapes) parts.push(spec.shapes(px, py));
  spec.curves.forEach((curve, n) => {
    const colour = `var(--c${curve.colour ?? n})`;
    const points = [];
    for (let k = 0; k < curve.x.length; ++k)
      points.push(Number.isFinite(curve.x[k]) && usable(curve.y[k]) ? [px(curve.x[k]), py(curve.y[k])] : null);
    if (curve.dots) {
      for (const p of points) if (p) parts.push(`<circle cx="${p[0].toFixed(1)}" cy="${p[1].toFixed(1)}" r="3.2" style="fill:${colour}"/>`);
      return;
    }
    let d = '', pen = [];
    const lift = () => { if (pen.length > 1) d += `M${thinned(pen).map((p) => at(...p)).join('L')}`; pen = []; };
    for (const p of points) if (p) pen.push(p); else lift();
    lift();
    parts.push(`<path d="${d}" style="fill:none;stroke:${colour};stroke-width:${curve.width ?? 1.6}${curve.dashed ? ';stroke-dasharray:6 4' : ''}"/>`);
  });
  parts.push('</g>');
  let free = 0;  // names beside their lines, next to each other where the lines are too close
  for (const mark of spec.marks ?? []) {
    if (mark.x < x0 || mark.x > x1) continue;
    const x = px(mark.x);
    free = Math.max(x, free) + 12;
    parts.push(`<path d="M${at(x, margin.top)}v${h}" style="stroke:var(--dim);stroke-dasharray:2 4"/>`
      + `<text transform="translate(${free.toFixed(1)} ${margin.top + h - 6}) rotate(-90)" style="fill:var(--dim);paint-order:stroke;stroke:var(--paper);stroke-width:3">${escaped(mark.name)}</text>`);
  }
  parts.push(`<rect x="${margin.left}" y="${margin.top}" width="${w}" height="${h}" style="fill:none;stroke:var(--dim)"/>`,
    `<text x="${margin.left + w / 2}" y="${height - 6}" text-anchor="middle">${escaped(spec.x.name)}</text>`,
    `<text transform="translate(13 ${margin.top + h / 2}) rotate(-90)" text-anchor="middle">${escaped(spec.y.name)}</text>`);
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" class="chart" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" font-family="system-ui, sans-serif" font-size="12" style="fill:var(--ink)">${parts.join('')}</svg>`;
  return { svg, px, py, invert: (p) => x0 + ((p - margin.left) / w) * (x1 - x0), box: { ...margin, w, h } };
}
