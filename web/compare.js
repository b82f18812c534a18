// Several runs on top of each other (livebed compare).

import { escaped, told } from './chart.js';
import { Figure } from './figure.js';

/// Keys of two resolved cases in which they differ: [key, value, value, ...].
export function differences(cases) {
  const read = (text) => {
    const keys = new Map();
    let table = '';
    for (const line of text.split('\n')) {
      const [, name] = /^\[(.+)\]$/.exec(line) ?? [];
      if (name) table = name === 'derived' ? '' : `${name}.`;
      const [, key, value] = /^([\w.]+) = (.*?)(?:\s+#.*)?$/.exec(line) ?? [];
      if (key) keys.set(table + key, value);
    }
    return keys;
  };
  const all = cases.map(read);
  return [...new Set(all.flatMap((keys) => [...keys.keys()]))]
    .map((key) => [key, ...all.map((keys) => keys.get(key) ?? '–')])
    .filter(([key, first, ...others]) => key !== 'case.title' && others.some((value) => value !== first));
}

const table = (head, rows) => `<div class="scroll"><table><thead><tr>${head.map((h) => `<th>${escaped(h)}</th>`).join('')}</tr></thead><tbody>${rows
  .map((row) => `<tr>${row.map((cell, n) => (n ? `<td>${escaped(String(cell))}</td>` : `<th>${escaped(cell)}</th>`)).join('')}</tr>`).join('')}</tbody></table></div>`;

export function comparison(runs) {
  const names = runs.map((run) => run.head.folder);
  const overlaid = (title, x, y, curve, options) => new Figure(title, () => {
    const curves = runs.map((run, n) => ({ ...curve(run), name: names[n], colour: n % 6, dashed: n >= 6 })).filter((c) => c.x?.length);
    return curves.length ? { x, y, curves: [...curves, ...(options?.beside ?? [])], ...options } : null;
  });
  const column = (name) => (run) => ({ x: run.series.time_s, y: run.series[name] });
  const overT = (run) => (run.head.T_s ? { x: run.series.time_s?.map((t) => t / run.head.T_s), y: run.series.S_over_D } : {});
  const end = (run) => {
    const { pipe } = run.head, line = run.bed.lines.at(-1);
    return pipe && line ? { x: run.bed.x.map((x) => (x - pipe.x_m) / pipe.D_m), y: line.map((y) => (y - run.bed.level) / pipe.D_m) } : {};
  };
  const number = (path, digits = 3) => runs.map((run) => {
    const v = path.split('.').reduce((object, key) => object?.[key], { ...run.head.summary, analysis: run.analysis });
    return typeof v === 'number' ? told(v, digits) : v ?? '–';
  });
  const rows = [['S/D at the end', 'scour_depth_over_D'], ['S_eq/D, steady', 'analysis.S_eq_over_D'], ['S_eq/D of the fit', 'analysis.fit.S_eq_over_D'], ['± (95 %)', 'analysis.fit.S_eq_half_width'],
    ['T of the fit [s]', 'analysis.fit.T_s'], ['± (95 %) [s]', 'analysis.fit.T_half_width_s'], ['T of the formula [s]', 'time_scale_s'], ['θ measured', 'theta_measured'], ['wall time [s]', 'wall_s'], ['commit', 'commit']];
  const rounded = (value) => (/^-?\d+\.\d{6,}/.test(value) ? told(Number(value), 6) : value);
  const differing = differences(runs.map((run) => run.head.case));
  const text = `<section><h2>Numbers</h2>${table(['', ...names], rows.map(([name, path]) => [name, ...number(path)]))}</section>`
    + `<section><h2>In which the cases differ</h2>${differing.length ? table(['key', ...names], differing.map(([key, ...values]) => [key, ...values.map(rounded)])) : '<p>In nothing: they are the same case.</p>'}</section>`;
  // The experiment, where all runs are its case.
  const measured = runs.every((run) => run.head.measured) ? runs[0].head.measured : null;
  const beside = measured ? [{ name: measured.name, x: measured.t_s.map((t) => t / measured.T_s), y: measured.S_over_D, dots: true, colour: 5 }] : [];
  const depth = [overlaid('Scour depth in time', { name: 't [s]', from: 0 }, { name: 'S/D' }, column('S_over_D')), overlaid('Scour depth over the time scale', { name: 't/T', from: 0 }, { name: 'S/D' }, overT, { beside })];
  const others = [overlaid('Bed lines at the end', { name: 'x/D' }, { name: 'y/D' }, end, { equal: true }), overlaid('Drag', { name: 't [s]', from: 0 }, { name: 'drag [N/m]' }, column('drag_N_m')),
    overlaid('Lift', { name: 't [s]', from: 0 }, { name: 'lift [N/m]' }, column('lift_N_m')), overlaid('Grain flux', { name: 't [s]', from: 0 }, { name: 'q [m²/s]' }, column('grain_flux_m2_s')),
    overlaid('Shields parameter', { name: 't [s]', from: 0 }, { name: 'θ measured' }, column('theta_measured'))];
  return { depth, others, text };
}
