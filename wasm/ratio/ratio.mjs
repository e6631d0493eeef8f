// SPDX-License-Identifier: Zlib
//
// Times a heap natively and by the npm package, in turn, and prints the ratio as Markdown. Fails unless all end in the same bits.
//   node ratio.mjs HEAP_TIME PACKAGE TREE [BODIES [STEPS [ROUNDS]]]
import { execFileSync } from 'node:child_process';
import { resolve } from 'node:path';

const [program, folder, tree, bodies = '100', steps = '400', rounds = '3'] = process.argv.slice(2);
const script = resolve(import.meta.dirname, 'heap_time.mjs');
const kinds = {
  native: [program, []],
  'WebAssembly, vectors': [process.execPath, ['--no-liftoff', script, folder, 'vectors']],
  'WebAssembly, plain': [process.execPath, ['--no-liftoff', script, folder, 'plain']],
};

const quantile = (list, part) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(part * list.length))];
const median = (list) => quantile(list, 0.5);
const sum = (list) => list.reduce((total, value) => total + value, 0);
// Of a run: what the table shows.
const figuresOf = ({ cpuMs }) => [median(cpuMs), quantile(cpuMs, 0.99), sum(cpuMs) / 1000];

let failed = false;
console.log(`A heap of ${bodies} bodies of ${tree}, ${steps} steps; medians of ${rounds} runs in turn.\n`);
console.log('| budget, operations | build | step, CPU ms: median | 99 % | all steps, CPU s | of native | bits |');
console.log('| --: | --- | --: | --: | --: | --: | --- |');
for (const operations of ['0', '20000']) {
  const runs = Object.fromEntries(Object.keys(kinds).map((kind) => [kind, []]));
  for (let round = 0; round < Number(rounds); ++round)
    for (const [kind, [command, before]] of Object.entries(kinds)) {
      const words = [...before, tree, bodies, steps, operations];
      runs[kind].push(JSON.parse(execFileSync(command, words, { maxBuffer: 1 << 26, encoding: 'utf8' })));
    }
  const hash = runs.native[0].hash;
  const figures = Object.fromEntries(Object.entries(runs).map(([kind, list]) => {
    const all = list.map(figuresOf);
    return [kind, all[0].map((_, column) => median(all.map((row) => row[column])))];
  }));
  for (const [kind, row] of Object.entries(figures)) {
    const same = runs[kind].every((run) => run.hash === hash);
    failed ||= !same;
    const ratio = row[2] / figures.native[2];
    console.log(`| ${operations === '0' ? 'none' : operations} | ${kind} | ${row.map((value) => value.toFixed(2)).join(' | ')} | ${ratio.toFixed(2)} | ${same ? hash : 'NOT THE SAME'} |`);
  }
}
if (failed) {
  console.error('ratio: the builds do not end in the same bits.');
  process.exitCode = 1;
}
