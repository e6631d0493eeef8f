// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tables and the picture that are made of runs.
import { writeFileSync } from 'node:fs';
import { kContestants } from './contestants.mjs';
import { median, sum } from './measured.mjs';
import { kScenes } from './scenes.mjs';

/// Of the runs of several seeds: medians of times, means of what is counted at the end, the worst of depths in any frame.
export function summaryOf(runs) {
  const over = (pick, fold) => (runs.some((run) => pick(run) === null) ? null : fold(runs.map(pick)));
  const worst = (list) => Math.max(...list);
  const mean = (list) => sum(list) / list.length;
  const end = (run) => run.judged.at(-1);
  return {
    median: over((run) => run.stepCpuMs.median, median),
    p99: over((run) => run.stepCpuMs.p99, median),
    mean: over((run) => run.stepCpuMs.mean, median),
    narrowMedian: over((run) => run.narrowPhaseCpuMs && run.narrowPhaseCpuMs.median, median),
    narrowP99: over((run) => run.narrowPhaseCpuMs && run.narrowPhaseCpuMs.p99, median),
    depthMean: over((run) => end(run).depth.mean, mean),
    depthEnd: over((run) => end(run).depth.max, worst),
    depthEver: over((run) => Math.max(...run.judged.map((frame) => Math.max(frame.depth.max, frame.pitDepth.max))), worst),
    gapMean: over((run) => end(run).gap.mean, mean),
    asleep: over((run) => run.asleep, mean),
    lost: over((run) => run.lost, sum),
    apart: over((run) => run.apart, sum),
  };
}

const ms = (value) => (value === null ? '-' : value < 9.995 ? value.toFixed(2) : value.toFixed(1));
const percent = (fraction) => (100 * fraction).toFixed(2);
const kColumns = [
  ['step, CPU ms: median', (s) => ms(s.median)],
  ['99 %', (s) => ms(s.p99)],
  ['narrow phase, CPU ms: median', (s) => ms(s.narrowMedian)],
  ['99 %', (s) => ms(s.narrowP99)],
  ['depth, % of size: mean', (s) => percent(s.depthMean)],
  ['at the end', (s) => percent(s.depthEnd)],
  ['deepest seen', (s) => percent(s.depthEver)],
  ['gap, %', (s) => percent(s.gapMean)],
  ['asleep', (s) => s.asleep.toFixed(0)],
  ['lost', (s) => s.lost],
];

/// What stands in the place of figures: a failure, or that the contestant was stopped; null where there are figures.
function wordsOf({ failed, over, with: bodies }) {
  if (failed) return failed;
  if (over === undefined) return null;
  return `over ${over} ms${bodies ? ` already with ${bodies} bodies` : ''}`;
}

/// Markdown of one scene and number of bodies. `rows` maps contestants to summaries.
export function tableOf(scene, bodies, seeds, rows) {
  const columns = kScenes[scene].apart ? [...kColumns, ['apart', (s) => s.apart]] : kColumns;
  const lines = [
    `${bodies} bodies, ${kScenes[scene].title}; seeds ${seeds.join(', ')}`,
    '',
    `|  | ${columns.map(([title]) => title).join(' | ')} |`,
    `| --- | ${columns.map(() => '--:').join(' | ')} |`,
  ];
  for (const [name, summary] of Object.entries(rows)) {
    const words = wordsOf(summary);
    const cells = words ? [words, ...columns.slice(1).map(() => '')] : columns.map(([, cell]) => cell(summary));
    lines.push(`| ${kContestants[name].what} | ${cells.join(' | ')} |`);
  }
  return `${lines.join('\n')}\n`;
}

const kQuotedScenes = ['heap', 'hooks', 'chains', 'bowls'];

/// The short table of the README: one row an engine; cells go by scene, in the order above. `results` maps scenes to rows of one number of bodies.
export function quoteOf(names, results) {
  const listed = (pick, words) => (name) => kQuotedScenes.map((scene) => words(results[scene][name]) ?? pick(results[scene][name])).join(' / ');
  const over = ({ failed, over: limit }) => (failed ? 'failed' : limit === undefined ? null : `over ${limit}`);
  const none = ({ failed, over: limit }) => (failed || limit !== undefined ? '-' : null);
  const columns = [
    ['99 % of steps, CPU ms', listed((s) => s.p99.toFixed(1), over)],
    ['deepest at the end, % of size', listed((s) => percent(s.depthEnd), none)],
    ['deepest seen', listed((s) => percent(s.depthEver), none)],
    ['rings apart', (name) => none(results.chains[name]) ?? results.chains[name].apart],
  ];
  const rows = [['', ...columns.map(([title]) => title)], ['---', ...columns.map(() => '--:')]];
  for (const name of names) rows.push([kContestants[name].what, ...columns.map(([, cell]) => cell(name))]);
  return rows.map((cells) => `| ${cells.join(' | ')} |`).join('\n');
}

const kWidth = 420; // of a scene's part
const kHeight = 320;
const kMargin = { left: 60, right: 30, top: 30, bottom: 45 };
const kColors = { cairn: '#1b6f78', rapier: '#b5541c', jolt: '#5a4fa3', havok: '#8a8a1f' };

const decades = ([low, high]) => Array.from({ length: high - low + 1 }, (_, k) => low + k);
const rangeOf = (values) => [Math.floor(Math.log10(Math.min(...values))), Math.ceil(Math.log10(Math.max(...values)))];

const kLabel = { height: 10, letter: 5 }; // of a name beside its mark, and of one of its letters

/// Moves names down until none lies on another.
function apart(labels) {
  const placed = [];
  const hits = (a, b) => Math.abs(a.at[1] - b.at[1]) < kLabel.height && a.at[0] < b.at[0] + kLabel.letter * b.what.length && b.at[0] < a.at[0] + kLabel.letter * a.what.length;
  for (const label of [...labels].sort((a, b) => a.at[1] - b.at[1])) {
    while (placed.some((other) => hits(label, other))) label.at[1] += 1;
    placed.push(label);
  }
  return placed;
}

/// One scene: the deepest penetration ever against the 99 % step, both logarithmic. Lower left is better.
function partOf({ title, absent }, points, left) {
  const [xs, ys] = [rangeOf(points.map(({ x }) => x)), rangeOf(points.map(({ y }) => y))];
  const scale = (value, [low, high], from, to) => from + ((Math.log10(value) - low) / Math.max(high - low, 1)) * (to - from);
  const px = (x) => left + scale(x, xs, kMargin.left, kWidth - kMargin.right);
  const py = (y) => scale(y, ys, kHeight - kMargin.bottom, kMargin.top);
  const text = (x, y, words, anchor = 'middle', size = 11) => `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" font-size="${size}">${words}</text>`;
  const lines = [
    ...decades(xs).map((k) => `<path d="M${px(10 ** k)} ${kMargin.top}V${kHeight - kMargin.bottom}"/>`),
    ...decades(ys).map((k) => `<path d="M${px(10 ** xs[0])} ${py(10 ** k)}H${px(10 ** xs[1])}"/>`),
  ];
  const labels = [
    text(left + kWidth / 2, 16, title, 'middle', 13),
    text(left + kWidth / 2, 27, absent, 'middle', 8),
    ...decades(xs).map((k) => text(px(10 ** k), kHeight - kMargin.bottom + 15, 10 ** k)),
    ...decades(ys).map((k) => text(px(10 ** xs[0]) - 6, py(10 ** k) + 4, 10 ** k, 'end')),
    text(left + kWidth / 2, kHeight - 8, '99 % of steps, CPU ms'),
    `<text transform="translate(${left + 16} ${kHeight / 2}) rotate(-90)" text-anchor="middle" font-size="11">greatest depth, % of size</text>`,
  ];
  const marks = apart(points.map((point) => ({ ...point, at: [px(point.x) + 7, py(point.y) + 4] }))).map(
    ({ x, y, name, what, at }) => `<circle cx="${px(x).toFixed(1)}" cy="${py(y).toFixed(1)}" r="4.5" fill="${kColors[kContestants[name].engine]}"/>${text(...at, what, 'start', 9)}`,
  );
  return `<g stroke="#ddd" fill="none">${lines.join('')}</g>${labels.join('')}${marks.join('')}`;
}

/// Draws the summaries of one number of bodies, scene beside scene.
export function drawFigure(file, scenes) {
  const parts = Object.entries(scenes).map(([scene, rows], k) => {
    const points = Object.entries(rows)
      .filter(([, summary]) => !wordsOf(summary))
      .map(([name, summary]) => ({ name, what: kContestants[name].what, x: Math.max(summary.p99, 0.01), y: Math.max(100 * summary.depthEver, 0.01) }));
    const left = Object.entries(rows).filter(([, summary]) => summary.over !== undefined);
    const absent = left.length ? `over ${left[0][1].over} ms: ${left.map(([name]) => kContestants[name].what.replace(', ', ' ')).join(', ')}` : '';
    return points.length ? partOf({ title: kScenes[scene].title, absent }, points, k * kWidth) : '';
  });
  const width = kWidth * parts.length;
  writeFileSync(file, `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${kHeight}" font-family="sans-serif"><rect width="${width}" height="${kHeight}" fill="white"/>${parts.join('')}</svg>\n`);
}
