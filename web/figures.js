// The figures of a run: from its data to the specs that chart.js draws.

import { escaped, told } from './chart.js';
import { gradient, heatUrl } from './colour.js';
import { Figure } from './figure.js';

const divided = (values, by) => values.map((v) => v / by);
const bar = (name, from, to, map) => `<div class="bar"><span>${escaped(name)}</span><b>${told(from, 2)}</b><i style="background:${gradient(map)}"></i><b>${told(to, 2)}</b></div>`;

/// A number with its interval.
const within = (v, half, unit = '') => `${told(v, 3)} ± ${told(half, 2)}${unit}`;

export function depthFigures(run) {
  const stages = (by) => (run.analysis.stages ?? []).map((s) => ({ x: s.t_s / by, name: s.name }));
  const formula = () => (run.analysis.formulas ?? []).find((f) => f.S_eq_over_D);
  const bands = () => {
    const f = formula();
    return f?.scatter ? [{ from: f.S_eq_over_D - f.scatter, to: f.S_eq_over_D + f.scatter, name: f.name }] : [];
  };
  const fitted = (t, T) => {
    const { fit } = run.analysis;
    return fit ? [{ name: `fit: S_eq/D = ${within(fit.S_eq_over_D, fit.S_eq_half_width)}`, x: divided(t, T), y: t.map((s) => fit.S_eq_over_D * (1 - Math.exp(-s / fit.T_s))), colour: 2, dashed: true }] : [];
  };
  const inTime = () => {
    const { time_s: t, S_over_D: S, depth_under_pipe_over_D: under } = run.series;
    if (!run.head.pipe || !run.bed.lines.length || !t?.length) return null;
    return { x: { name: 't [s]', from: 0 }, y: { name: 'S/D' }, marks: stages(1),
      curves: [{ name: 'this run', x: t, y: S, colour: 0 }, { name: "under the pipe's centre", x: t, y: under, colour: 1 }, ...fitted(t, 1)],
      note: 'S: largest depth of the bed within one D of the pipe. The fit is S_eq (1 − exp(−t/T)); intervals hold 95 % and count how long the residuals remember.' };
  };
  const inScale = () => {
    const { time_s: t, S_over_D: S } = run.series, { T_s: T, measured } = run.head;
    if (!run.head.pipe || !T || !run.bed.lines.length || !t?.length) return null;
    const curves = [{ name: 'this run', x: divided(t, T), y: S, colour: 0 }];
    if (measured) curves.push({ name: measured.name, x: measured.t_s.map((s) => s / measured.T_s), y: measured.S_over_D, colour: 3, dots: true });
    const near = (run.analysis.comparisons ?? [])[0];
    return { x: { name: 't/T', from: 0 }, y: { name: 'S/D', from: Math.min(0, ...S) }, curves, bands: bands(), marks: stages(T),
      note: `T = D² θ^(−5/3) / (50 √(g(s−1)d³)) = ${told(T, 3)} s here. Coarser grains dig faster, so only this chart compares runs with other sand.`
        + (near ? ` Against the ${near.points} measured points: rms ${told(near.rms, 2)}, mean ${told(near.bias, 2)}, Brier skill ${told(near.skill, 2)} (1 perfect, 0 no better than a flat bed). They are digitised second-hand, good to about 0.02; the same experiment's profiles lie up to 0.1 deeper.` : '') };
  };
  return [new Figure('Scour depth in time', inTime), new Figure('Scour depth over the time scale', inScale)];
}

const circle = (run) => (px, py) => {
  const { pipe } = run.head, y = (pipe.y_m - run.bed.level) / pipe.D_m;
  return `<circle cx="${px(0)}" cy="${py(y)}" r="${px(0.5) - px(0)}" style="fill:var(--rule);stroke:var(--dim)"/>`;
};

export function bedFigures(run) {
  const inD = (line) => [run.bed.x.map((x) => (x - run.head.pipe.x_m) / run.head.pipe.D_m), line.map((y) => (y - run.bed.level) / run.head.pipe.D_m)];
  const profiles = () => {
    if (!run.head.pipe || !run.bed.lines.length) return null;
    const last = run.bed.time.at(-1);
    const curves = [0, 0.05, 0.15, 0.4, 1].map((s, n) => {
      const [x, y] = inD(run.nearestLine(s * last));
      return { name: `t = ${told(s * last, 3)} s`, x, y, colour: [5, 4, 2, 1, 0][n] };
    });
    return { x: { name: 'x/D' }, y: { name: 'y/D', to: 1.2 }, curves, shapes: circle(run), equal: true };
  };
  const beside = (n) => () => {
    const { measured, T_s } = run.head, profile = measured?.profiles[n];
    if (!profile || !run.bed.lines.length) return null;
    const t = (profile.t_s / measured.T_s) * T_s;
    if (t > 1.02 * run.bed.time.at(-1)) return null;
    const [x, y] = inD(run.nearestLine(t)), near = (run.analysis.comparisons ?? [])[n + 1];
    return { x: { name: 'x/D', from: -4, to: 6 }, y: { name: 'y/D', to: 1.2 }, shapes: circle(run), equal: true,
      curves: [{ name: `this run, t = ${told(t, 3)} s`, x, y, colour: 0 }, { name: `${measured.name}, t/T = ${(profile.t_s / measured.T_s).toFixed(2)}`, x: profile.x_over_D, y: profile.y_over_D, dots: true, colour: 3 }],
      note: near ? `${near.points} points: rms ${told(near.rms, 2)}, mean ${told(near.bias, 2)}, Brier skill ${told(near.skill, 2)}.` : '' };
  };
  const spaceTime = () => {
    const { x, lines, time, level } = run.bed, { pipe } = run.head;
    if (lines.length < 3) return null;
    const unit = pipe?.D_m ?? 1, x0 = pipe?.x_m ?? 0, nx = x.length, values = new Float32Array(nx * lines.length);
    lines.forEach((line, n) => line.forEach((y, i) => { values[n * nx + i] = (y - level) / unit; }));
    const end = Math.min(2, values.reduce((most, v) => Math.max(most, Math.abs(v)), 1e-6));
    const half = (x[1] - x[0]) / 2, name = pipe ? 'y/D' : 'y [m]';
    return { x: { name: pipe ? 'x/D' : 'x [m]' }, y: { name: 't [s]', tight: true }, curves: [],
      image: { url: heatUrl(values, nx, lines.length, -end, end, 'balance'), x0: (x[0] - half - x0) / unit, x1: (x.at(-1) + half - x0) / unit, y0: time[0], y1: time.at(-1) },
      bar: bar(`height of the bed ${name}`, -end, end, 'balance'),
      csv: () => [`t_s,${Array.from(x, (s) => `y_at_${told(s, 6)}_m`)}`, ...lines.map((line, n) => `${told(time[n], 6)},${Array.from(line, (y) => told(y, 6))}`)].join('\n') };
  };
  return [new Figure('Bed lines', profiles, { wide: true }), new Figure("Bed beside the experiment's, early", beside(0)), new Figure("Bed beside the experiment's, late", beside(1)),
    new Figure('The bed in space and time', spaceTime)];
}

/// A chart of columns of the series in time.
function inTime(run, title, y, columns) {
  return new Figure(title, () => {
    const { time_s: t } = run.series;
    const curves = columns.filter(([column]) => run.series[column]).map(([column, name, colour]) => ({ name, x: t, y: run.series[column], colour }));
    const moved = curves.some((curve) => curve.y.some((v) => v !== 0));  // a run without grains has nothing to tell of them
    return t?.length && moved ? { x: { name: 't [s]', from: 0 }, y, curves, height: 210 } : null;
  });
}

export function forceFigures(run) {
  const spectrum = () => {
    const s = run.analysis.spectrum;
    if (!s) return null;
    const D = run.head.pipe.D_m, St = s.frequency_Hz.map((f) => (f * D) / s.speed_m_s);
    return { x: { name: 'St = f D / U', from: 0 }, y: { name: 'power [(N/m)² s]', log: true }, curves: [{ name: '', x: St, y: s.power }], height: 210,
      marks: [{ x: s.strouhal, name: `St = ${told(s.strouhal, 3)}` }],
      note: `Lift from t = ${told(s.from_s, 3)} s on, U = ${told(s.speed_m_s, 3)} m/s. Largest power at ${told(s.peak_Hz, 3)} Hz; within a fifth of it lie ${Math.round(100 * s.share_at_peak)} % of the variance${s.share_at_peak < 0.3 ? ': no clear shedding' : ''}.` };
  };
  return run.head.pipe ? [inTime(run, 'Force on the pipe', { name: 'force [N/m]' }, [['drag_N_m', 'drag', 0], ['lift_N_m', 'lift', 1]]), new Figure('Spectrum of the lift', spectrum)] : [];
}

export function bedLoadFigures(run) {
  const shear = (title, name, pick) => new Figure(title, () => {
    const s = run.analysis.shear, { pipe } = run.head;
    if (!s) return null;
    const x = s.x_m.map((v) => (pipe ? (v - pipe.x_m) / pipe.D_m : v));
    const curves = pick(s).filter((c) => c.y.length).map((c) => ({ ...c, x, y: c.y.map((v) => v ?? NaN) }));
    return curves.length ? { x: { name: pipe ? 'x/D' : 'x [m]' }, y: { name }, curves, note: `Mean of ${s.frames} frames, t = ${told(s.from_s, 3)} to ${told(s.to_s, 3)} s. On the sand: force of the water on grains at the surface (three grains deep and above) per area; in the water: ρ (ν + ν_t) ∂u/∂y just above the bed line.` } : null;
  });
  const over = (values, by) => (by > 0 ? values.map((v) => (v === null ? null : v / by)) : []);
  const motion = () => {
    const pack = run.motion, { pipe } = run.head;
    if (!pack?.flux) return null;
    const { nx, ny, dx, dy } = pack.head, unit = pipe?.D_m ?? 1, x0 = pipe?.x_m ?? 0, y0 = pipe ? run.bed.level : 0;
    const logs = pack.flux.raw.map((v) => (v > 0 ? Math.log10(v) : NaN)), most = logs.reduce((m, v) => (v > m ? v : m), -Infinity);
    if (!Number.isFinite(most)) return null;
    // Of the rows those in which sand moves, and those around the pipe.
    const moves = (j) => logs.subarray(j * nx, (j + 1) * nx).some(Number.isFinite), [low, high] = pipe ? [pipe.y_m - 1.5 * pipe.D_m, pipe.y_m + pipe.D_m] : [Infinity, 0];
    let from = 0, to = ny;
    while ((from + 1) * dy < low && !moves(from)) ++from;
    while ((to - 1) * dy > high && !moves(to - 1)) --to;
    return { x: { name: pipe ? 'x/D' : 'x [m]' }, y: { name: pipe ? 'y/D' : 'y [m]', tight: true }, curves: [], equal: true,
      shapes: pipe ? circle(run) : undefined,
      image: { url: heatUrl(logs.subarray(from * nx, to * nx), nx, to - from, most - 4, most, 'sand'), x0: -x0 / unit, x1: (nx * dx - x0) / unit, y0: (from * dy - y0) / unit, y1: (to * dy - y0) / unit },
      bar: bar('log10 of the mean flux |u_p| φ [m/s]', most - 4, most, 'sand'),
      csv: () => ['x_m,y_m,flux_m_s', ...Array.from(pack.flux.raw, (v, n) => `${told(((n % nx) + 0.5) * dx, 5)},${told((Math.floor(n / nx) + 0.5) * dy, 5)},${told(v, 6)}`)].join('\n'),
      note: 'Mean over all frames after the release: what share of a cell is sand, times its speed. Blank: sand never moved there, or never was.' };
  };
  return [new Figure('Where the sand moves', motion, { wide: true }),
    shear('Shear stress at the bed', 'τ [Pa]', (s) => [{ name: 'on the sand', y: s.on_sand_Pa, colour: 1 }, { name: 'in the water', y: s.in_water_Pa, colour: 0 }]),
    shear('Amplification of the bed shear stress', 'τ / τ upstream', (s) => [{ name: 'on the sand', y: over(s.on_sand_Pa, s.upstream_on_sand_Pa), colour: 1 }, { name: 'in the water', y: over(s.in_water_Pa, s.upstream_in_water_Pa), colour: 0 }]),
    inTime(run, 'Grain flux', { name: 'q [m²/s]' }, [['grain_flux_m2_s', '', 0]]),
    inTime(run, 'Shields parameter', { name: 'θ' }, [['theta_measured', 'measured', 0]]),
    inTime(run, 'Speed of the grains', { name: '[m/s]' }, [['grain_mean_speed_m_s', 'mean', 0], ['grain_max_speed_m_s', 'largest', 1]]),
    ...(run.head.pipe && run.head.T_s ? [inTime(run, 'Hole and mound', { name: '[D]' }, [['hole_width_over_D', 'width of the hole', 0], ['mound_height_over_D', 'height of the mound', 1], ['mound_x_over_D', 'place of the mound', 2]])] : [])];
}

export function budgetFigures(run) {
  const sand = () => {
    const { sand: s } = run.analysis, unit = run.head.pipe ? 'D²' : 'm²';
    if (!s) return null;
    return { x: { name: 't [s]', from: 0 }, y: { name: `area [${unit}]` }, height: 210,
      curves: [{ name: 'dug out', x: s.time_s, y: s.eroded, colour: 0 }, { name: 'laid on', x: s.time_s, y: s.deposited, colour: 1 }, { name: 'carried off or in suspension', x: s.time_s, y: s.eroded.map((v, n) => v - s.deposited[n]), colour: 5, dashed: true }] };
  };
  return [new Figure('Sand', sand),
    inTime(run, 'Momentum along the current', { name: '[N s]' }, [['fluid_momentum_x_N_s', 'water', 0], ['grain_momentum_x_N_s', 'grains', 1]]),
    inTime(run, 'Impulse not yet handed over', { name: '[N s]' }, [['impulse_error_N_s', '', 0]]),
    inTime(run, 'Mass residual', { name: 'residual', log: true }, [['mass_residual', '', 0]]),
    inTime(run, 'Flow step', { name: '[s]' }, [['flow_step_s', '', 0]]),
    inTime(run, 'Courant number', { name: '[-]' }, [['courant', '', 0]]),
    inTime(run, 'Pressure iterations', { name: '[-]' }, [['pressure_iterations', '', 0]]),
    inTime(run, 'Contacts of a grain', { name: '[-]' }, [['contacts_per_grain', '', 0]]),
    inTime(run, 'Largest overlap', { name: 'overlap / d' }, [['overlap_max_over_d', '', 0]])];
}
