// The page: report.html, what a running program serves, and a comparison of runs are the same sections over the same data.

import './style.css';
import { escaped, told } from './chart.js';
import { comparison } from './compare.js';
import { bedFigures, bedLoadFigures, budgetFigures, depthFigures, forceFigures } from './figures.js';
import { Live } from './live.js';
import { Run } from './source.js';
import { stagePictures, View } from './view.js';

const settings = JSON.parse(document.getElementById('settings').textContent);
const main = document.getElementById('main');
const figures = [];

function section(title, ...children) {
  const element = document.createElement('section');
  element.innerHTML = `<h2>${escaped(title)}</h2>`;
  element.append(...children);
  main.append(element);
  return element;
}

function grid(list) {
  const element = document.createElement('div');
  element.className = 'grid';
  element.append(...list.map((figure) => figure.element));
  figures.push(...list);
  return element;
}

/// Draws all figures; a section that has nothing to show is not shown.
function refreshFigures() {
  for (const figure of figures) figure.refresh();
  for (const element of main.querySelectorAll('section')) {
    const inside = [...element.querySelectorAll('figure')];
    if (inside.length) element.hidden = inside.every((figure) => figure.hidden);
  }
  for (const figure of figures) figure.draw();  // now that it is known how many stand in a row
}

const card = (name, value, note = '') => `<div class="card"><b>${escaped(value)}</b><span>${escaped(name)}</span>${note ? `<small>${escaped(note)}</small>` : ''}</div>`;

/// What one wants to know first.
function cards(run) {
  const { summary, pipe, T_s, theta } = run.head, { fit, S_eq_over_D: steady, stages } = run.analysis, last = (name) => run.series[name]?.at(-1);
  const formula = (run.analysis.formulas ?? []).find((f) => f.S_eq_over_D);
  let out = '';
  if (pipe && run.bed.lines.length) {
    out += card('S/D now', told(last('S_over_D'), 3), `under the pipe's centre ${told(last('depth_under_pipe_over_D'), 3)}`);
    out += card('S_eq/D', steady ? told(steady, 3) : 'not reached', [fit ? `fit ${told(fit.S_eq_over_D, 3)} ± ${told(fit.S_eq_half_width, 2)} (95 %)` : '', formula ? `formula ${told(formula.S_eq_over_D, 2)}${formula.scatter ? ` ± ${formula.scatter}` : ''}` : ''].filter(Boolean).join('; '));
    out += card('time scale of S(t)', fit ? `${told(fit.T_s, 3)} s` : 'not yet', [fit ? `± ${told(fit.T_half_width_s, 2)} s (95 %)` : '', T_s ? `formula ${told(T_s, 3)} s` : ''].filter(Boolean).join('; '));
    const onset = (stages ?? [])[0];
    if (onset) out += card('undermined after', `${told(onset.t_s, 2)} s`, onset.rule);
  }
  if (run.rows) {
    out += card('θ measured', told(summary?.theta_measured ?? last('theta_measured'), 3), theta ? `nominal ${told(theta, 3)}` : '');
    out += card('simulated', `${told(last('time_s'), 3)} s`, T_s ? `t/T = ${told(last('time_s') / T_s, 3)}` : '');
  }
  if (summary?.wall_s) out += card('wall time', `${told(summary.wall_s, 3)} s`, Object.entries(summary.walls ?? {}).map(([name, s]) => `${name.replace(/_s$/, '')} ${told(s, 2)}`).join(', '));
  if (summary?.grains !== undefined) out += card('grains', String(summary.grains), `${told(summary.grain_steps_per_second / 1e6, 3)} million grain-steps/s`);
  if (summary?.cells) out += card('cells', String(summary.cells), `${told(summary.flow_ms_per_step, 3)} ms a flow step`);
  return out;
}

function stageTable(run) {
  const { stages } = run.analysis;
  if (!stages?.length) return '';
  return `<table class="stages"><thead><tr><th>stage</th><th>begins</th><th>rule</th></tr></thead><tbody>${stages
    .map((s) => `<tr><th>${escaped(s.name)}</th><td>${told(s.t_s, 3)} s${run.head.T_s ? ` = ${told(s.t_s / run.head.T_s, 2)} T` : ''}</td><td>${escaped(s.rule)}</td></tr>`).join('')}</tbody></table>`;
}

function provenance(run) {
  const { summary, folder, case: text, log, missing } = run.head;
  const fold = (title, body) => (body ? `<details><summary>${title}</summary><pre>${escaped(body)}</pre></details>` : '');
  const versions = summary ? `livebed ${summary.versions?.livebed ?? '?'}, commit ${summary.commit ?? '?'}, ${summary.versions?.compiler ?? ''}, case ${summary.case_hash ?? '?'}, seed ${summary.seed ?? '?'}` : '';
  return `${missing.length ? `<div class="missing"><b>Not everything is here</b><ul>${missing.map((m) => `<li>${escaped(m)}</li>`).join('')}</ul></div>` : ''}
    ${versions ? `<p>${escaped(versions)}</p>` : ''}<p>To get the same bits: take the resolved case below, the same version built for the same instruction set, and</p>
    <pre>livebed run ${escaped(folder)}/case.resolved.toml --out again</pre>
    ${fold('The resolved case', text)}${fold('summary.json', summary ? JSON.stringify(summary, null, 2) : '')}${fold('The end of the log', log)}`;
}

/// The page of one run; returns what is to be done when its data have changed.
async function runPage(run, live) {
  await run.readHead();
  main.innerHTML = `<header><h1>${escaped(run.head.title)}</h1></header>`;
  if (live) main.append(live.element);
  const numbers = document.createElement('div');
  numbers.className = 'cards';
  main.append(numbers);
  const view = new View(run);
  main.append(view.element);
  const depth = section('Scour depth', grid(depthFigures(run)));
  const stages = document.createElement('div');
  depth.append(stages);
  const pictures = document.createElement('div');
  pictures.className = 'grid pictures';
  section('The bed', pictures, grid(bedFigures(run)));
  const forces = forceFigures(run);
  if (forces.length) section('The pipe', grid(forces));
  section('At the bed', grid(bedLoadFigures(run)));
  section('Budgets and numerics', grid(budgetFigures(run)));
  const origin = document.createElement('div');
  section('What was run', origin);
  const showTexts = () => {
    numbers.innerHTML = cards(run);
    stages.innerHTML = stageTable(run);
    origin.innerHTML = provenance(run);
  };
  return {
    view, pictures,
    refresh() {
      showTexts();
      refreshFigures();
    },
  };
}

async function report() {
  const run = new Run(false);
  const page = await runPage(run, null);
  await Promise.all([run.readTables(), run.readAnalysis(), run.readMotion()]);
  page.refresh();
  await page.view.update();
  await showStages(run, page.pictures);
}

/// Pictures of the stages that the run has come to.
async function showStages(run, holder) {
  const { T_s, frames, measured } = run.head, last = frames.at(-1)?.t_s;
  if (last === undefined) return;
  // The stages of the paper's Fig. 11 in t/T, or five moments; and where the run is now.
  const wanted = measured ? [0, 11, 18, 25, 50].map((t) => (t / measured.T_s) * T_s).filter((t) => t < last) : [0, 0.05, 0.15, 0.3, 0.6].map((s) => s * last);
  await stagePictures(run, [...wanted, last], holder);
}

async function watch() {
  const run = new Run(true), live = new Live(settings.token);
  const page = await runPage(run, live);
  let analysed = 0;
  const parts = () => `${run.head.case !== ''} ${run.head.pipe !== null}`, built = parts();
  const look = async () => {
    const began = Date.now();
    try {
      await run.readHead();
      if (parts() !== built) return location.reload();  // the bed is packed: now there is a case, and a pipe
      if (run.head.server !== settings.server) return location.reload();  // another server: another token
      const fresh = await run.readTables();
      await page.view.update();
      if (fresh && Date.now() - analysed > 3000) {
        analysed = Date.now();
        await run.readAnalysis();
        await run.readMotion();
        analysed = Date.now();
      }
      live.show(run.head.status, run.head.summary, run.series.time_s?.at(-1));
      if (fresh || !page.shown) page.refresh();
      page.shown = true;
      const ended = !run.head.status.alive;
      if (ended && !page.pictured) await showStages(run, page.pictures);
      page.pictured = ended;
    } catch (error) {
      if (error instanceof TypeError) live.lost();  // what fetch throws when nobody answers
      else live.trouble(error.message);
    }
    setTimeout(look, Math.max(1000, 4 * (Date.now() - began)));  // large runs are looked at less often
  };
  await look();
}

async function compare() {
  const runs = Array.from({ length: settings.runs }, (_, n) => new Run(false, `${n}/`));
  await Promise.all(runs.flatMap((run) => [run.readHead(), run.readTables(), run.readAnalysis()]));
  main.innerHTML = `<header><h1>${escaped(document.title)}</h1></header>`;
  const { depth, others, text } = comparison(runs);
  section('Scour depth', grid(depth));
  main.insertAdjacentHTML('beforeend', text);
  section('Bed, forces, transport', grid(others));
  refreshFigures();
}

let width = innerWidth;
addEventListener('resize', () => {
  if (innerWidth === width) return;  // phones resize in height when bars come and go
  width = innerWidth;
  for (const figure of figures) figure.draw();
  window.dispatchEvent(new Event('redraw'));
});

// On paper nothing can be unfolded.
addEventListener('beforeprint', () => { for (const fold of document.querySelectorAll('details')) fold.open = true; });

({ report, live: watch, compare })[settings.mode]().catch((error) => {
  console.error(error);
  main.insertAdjacentHTML('afterbegin', `<div class="missing"><b>${escaped(error.message)}</b></div>`);
});
