// report.html and compare.html as a reader sees them.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { changes, close, folder, livebed, open, pixels, smallRun, until } from './harness.mjs';

const file = (name) => `file://${join(folder, name)}`;
let page;

before(async () => {
  livebed(...smallRun('first', 0.3));
  livebed('report', 'first');
  page = await open(file('first/report.html'));
  await until(page, () => document.querySelectorAll('.pictures svg').length > 0);
});
after(close);

const drawn = () => page.evaluate(() => [...document.querySelectorAll('figure')].filter((figure) => !figure.hidden && figure.querySelector('svg')).map((figure) => figure.querySelector('h3').textContent));

test('shows every figure, the numbers and the case, and complains of nothing', async () => {
  const titles = await drawn();
  for (const title of ['Scour depth in time', 'Scour depth over the time scale', 'Bed lines', 'The bed in space and time', 'Force on the pipe', 'Where the sand moves',
    'Shear stress at the bed', 'Amplification of the bed shear stress', 'Grain flux', 'Sand', 'Mass residual']) assert.ok(titles.includes(title), `${title} is not among ${titles}`);
  assert.match(await page.textContent('.cards'), /S\/D now/);
  assert.match(await page.textContent('body'), /livebed run first\/case\.resolved\.toml --out again/);
  assert.match(await page.textContent('pre:has-text("preset")'), /preset = "mbs2d"/);
  assert.deepEqual(page.complaints, []);
});

test('asks for nothing but itself', () => assert.deepEqual([...new Set(page.requests)], [file('first/report.html')]));

test('draws water above and sand below', async () => {
  const { colours: [water] } = await pixels(page, [[0.9, 0.95]]);
  assert.ok(water[1] > 150 && water[2] < 140, `fast water is green to yellow, not ${water}`);
  const { colours } = await pixels(page, Array.from({ length: 60 }, (_, n) => [0.1 + 0.013 * n, 0.05]));
  const grains = colours.filter(([r, g, b]) => r > 110 && r > g + 15 && g > b);  // from tan over orange to dark red
  assert.ok(grains.length > 35, `of 60 pixels in the bed only ${grains.length} are sand: ${colours.join(' ')}`);
});

test('moves in time, changes its quantity, zooms, hides grains, draws streamlines', async () => {
  await changes(page, 'the slider', () => page.locator('input[type=range]').fill('0'));
  assert.match(await page.textContent('output'), /t = 0 s/);
  for (const quantity of ['vorticity', 'pressure', 'solid', 'speed']) await changes(page, quantity, () => page.click(`[data-quantity=${quantity}]`));
  await changes(page, 'the grains', () => page.uncheck('[name=grains]'));
  await page.check('[name=grains]');
  await page.check('[name=streamlines]');
  await until(page, () => document.querySelector('.over path[style*="opacity:.75"]')?.getAttribute('d').length > 1000);
  await changes(page, 'the wheel', async () => {
    await page.hover('.plate');
    await page.mouse.wheel(0, -600);
  });
  await changes(page, 'dragging', async () => {
    await page.mouse.down();
    await page.mouse.move(500, 500, { steps: 4 });
    await page.mouse.up();
  });
  await changes(page, 'showing all', () => page.click('[name=all]'));
  await changes(page, 'playing', () => page.click('[name=play]'));
  await page.click('[name=play]');
});

test('saves figures as SVG and CSV that stand alone', async () => {
  const figure = page.locator('figure', { has: page.getByText('Force on the pipe', { exact: true }) });
  const saved = async (button) => {
    const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
    return [download.suggestedFilename(), readFileSync(await download.path(), 'utf8')];
  };
  const [name, svg] = await saved(figure.locator('button').first());
  assert.equal(name, 'force-on-the-pipe.svg');
  assert.ok(!svg.includes('var(--'), 'colours of the page are not known outside it');
  assert.equal(await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelectorAll('parsererror').length, svg), 0);
  const [table, csv] = await saved(figure.locator('button').nth(1));
  assert.equal(table, 'force-on-the-pipe.csv');
  const rows = csv.trim().split('\n');
  assert.equal(rows[0], 'curve,"t [s]","force [N/m]"');
  assert.ok(rows.length > 100 && /^"lift",0\.3\d*,-?[\d.e-]+$/.test(rows.at(-1)), rows.at(-1));
  const [, moment] = await saved(page.locator('.tools [name=svg]'));
  assert.match(moment, /<image href="data:image\/png/);
});

test('tells values under the pointer and zooms by dragging', async () => {
  const plot = page.locator('figure', { has: page.getByText('Scour depth in time', { exact: true }) }).locator('.plot');
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 80);
  assert.match(await plot.locator('.tell').textContent(), /t \[s\]: 0\.1.*this run: /);
  const before = await plot.locator('svg').innerHTML();
  await page.mouse.down();
  await page.mouse.move(box.x + 0.8 * box.width, box.y + 80);
  await page.mouse.up();
  assert.notEqual(await plot.locator('svg').innerHTML(), before);
});

test('fits a phone, in the dark', async () => {
  const phone = await open(file('first/report.html'), { width: 390, height: 844, scheme: 'dark' });
  await until(phone, () => document.querySelectorAll('.pictures svg').length > 0);
  const [wide, paper] = await phone.evaluate(() => [document.documentElement.scrollWidth, getComputedStyle(document.body).backgroundColor]);
  assert.ok(wide <= 390, `${wide} pixels wide`);
  assert.equal(paper, 'rgb(20, 23, 26)');
  assert.deepEqual(phone.complaints, []);
  await phone.close();
});

test('prints on paper', async () => {
  const pdf = await page.pdf({ format: 'A4' });
  assert.ok(pdf.length > 100000);
});

test('compares runs: their curves, their numbers, the keys in which they differ', async () => {
  livebed(...smallRun('second', 0.2, '--set', 'current.theta=0.25'));
  livebed('compare', 'first', 'second', '--out', 'both.html');
  const both = await open(file('both.html'));
  await until(both, () => document.querySelectorAll('figure svg').length > 4);
  assert.match(await both.textContent('figure .legend'), /firstsecond/);
  const keys = await both.locator('section', { hasText: 'In which the cases differ' }).locator('tbody').textContent();
  assert.match(keys, /current\.theta0\.330\.25/);
  assert.match(keys, /time\.end/);
  assert.doesNotMatch(keys, /mesh/);
  assert.deepEqual(both.complaints, []);
});
