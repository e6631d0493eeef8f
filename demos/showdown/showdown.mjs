// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every engine on the same scenes, judged by one judge. Prints Markdown tables; what wins is what is printed.
import { mkdirSync, realpathSync, writeFileSync } from 'node:fs';
import { availableParallelism, cpus } from 'node:os';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { kContestants, kQuoted, kUsual } from './contestants.mjs';
import { drawFigure, quoteOf, summaryOf, tableOf } from './figures.mjs';
import { fingerprintOf } from './fingerprint.mjs';
import { keptOr } from './kept_runs.mjs';
import { prepareModel } from './models.mjs';
import { kFlags, runOnce } from './one_run.mjs';
import { kScenes } from './scenes.mjs';

const kUsage = `usage: ./cairn.sh showdown [OPTIONS]
  --bodies 60,100,300    numbers of bodies
  --seeds 1,2,3          of start poses
  --scenes NAMES         of ${Object.keys(kScenes).join(', ')}
  --contestants NAMES    of ${Object.keys(kContestants).join(', ')}
  --steps 300            of 1/60 s
  --json FILE            writes every run's figures
  --figure FILE.svg      draws depth against time, for the largest number of bodies
  --limit 3600           seconds that one run may take; longer ones are told as such
  --longest 100          milliseconds of CPU of a step: a contestant with several longer ones is stopped, and told as "over 100 ms";
                         its other seeds and larger numbers of bodies in this scene are not run
  --resume               takes runs that an earlier, stopped call finished, where neither engines, packages, scenes, judge, settings
                         nor machine have changed since
  --quote                prints the short table of the README instead: one row an engine, of the last number of bodies`;

const here = import.meta.dirname;
const root = resolve(here, '../..');

function optionsOf() {
  const text = { type: 'string' };
  const defaults = { bodies: '60,100,300', seeds: '1,2,3', scenes: Object.keys(kScenes).join(), contestants: kUsual.join(), steps: '300', limit: '3600', longest: '100' };
  const quoted = { bodies: '100', contestants: kQuoted.join() };
  const known = { bodies: text, seeds: text, scenes: text, contestants: text, steps: text, json: text, figure: text, limit: text, longest: text, cairn: text, judge: text, bunny: text, folder: text, resume: { type: 'boolean' }, quote: { type: 'boolean' }, help: { type: 'boolean' } };
  const { values } = parseArgs({ options: known });
  if (values.help) return null;
  const all = { cairn: `${root}/build/release/bin/cairn`, judge: `${root}/build/release/bin/showdown_judge`, bunny: `${root}/out/showdown/bunny.obj`, folder: `${root}/out/showdown`, ...defaults, ...(values.quote ? quoted : {}), ...values };
  const list = (name) => all[name].split(',');
  const numbers = (name) => {
    const read = list(name).map(Number);
    if (read.some((number) => !(Number.isInteger(number) && number > 0))) throw new Error(`--${name}: give whole numbers from 1 on, not ${all[name]}`);
    return read;
  };
  for (const [name, of] of [['scenes', kScenes], ['contestants', kContestants]]) {
    const unknown = list(name).find((one) => !of[one]);
    if (unknown) throw new Error(`--${name}: there is no ${unknown}; choose from ${Object.keys(of).join(', ')}`);
  }
  const [steps, limit, longest] = ['steps', 'limit', 'longest'].map((name) => numbers(name)[0]);
  const bodies = numbers('bodies').sort((a, b) => a - b); // who is too slow for few is not tried with more
  return { ...all, bodies, seeds: numbers('seeds'), scenes: list('scenes'), contestants: list('contestants'), steps, limit, longest };
}

const say = (words) => process.stderr.write(`  ${words}\n`);

/// A run from its file, where it is resumed; else measured, and put there.
function runOrRead(options, { scene, bodies, seed, contestant, model }) {
  const file = join(options.folder, 'runs', `${scene}-${bodies}-${seed}-${contestant}-${options.steps}.json`);
  const places = { showdown: here, engines: join(here, '../engines'), cairn: realpathSync(join(here, '../engines/node_modules/cairn-collision')), judge: options.judge };
  const { steps, longest, limit } = options;
  const settings = { scene, bodies, seed, steps, longest, limit, flags: kFlags, node: process.version, machine: cpus()[0].model };
  const fingerprint = fingerprintOf(places, kContestants[contestant], model, settings);
  return keptOr(file, fingerprint, options.resume, () => {
    say(`${scene}, ${bodies} bodies, seed ${seed}: ${kContestants[contestant].what}`);
    return runOnce(options, { scene, bodies, seed, contestant, model });
  });
}

/// One contestant with one seed. `slow` maps who was stopped to the number of bodies.
function turnOf(options, slow, { scene, bodies, seed, contestant, model }) {
  const stopped = slow.get(`${scene} ${contestant}`);
  if (stopped) return { seed, over: options.longest, with: stopped };
  try {
    const run = runOrRead(options, { scene, bodies, seed, contestant, model });
    if (run.stopped) slow.set(`${scene} ${contestant}`, bodies);
    return { seed, ...run };
  } catch (error) {
    return { seed, failed: error.message };
  }
}

/// Seed by seed, all contestants in turn, so that a loaded hour of the machine is nobody's alone.
async function runScene(options, slow, scene, bodies) {
  const model = await prepareModel(kScenes[scene].model, { ...options, folder: join(options.folder, 'models') });
  const runs = Object.fromEntries(options.contestants.map((name) => [name, []]));
  for (const seed of options.seeds)
    for (const contestant of options.contestants) runs[contestant].push(turnOf(options, slow, { scene, bodies, seed, contestant, model }));
  return runs;
}

/// The row of a contestant: figures of all its seeds, or why there are none.
function rowOf(runs, bodies) {
  const [failed, stopped] = [runs.find((run) => run.failed), runs.find((run) => run.over !== undefined)];
  if (failed) return { failed: failed.failed };
  if (stopped) return { over: stopped.over, ...(stopped.with && stopped.with < bodies ? { with: stopped.with } : {}) };
  return summaryOf(runs);
}

async function main() {
  const options = optionsOf();
  if (!options) return console.log(kUsage);
  mkdirSync(join(options.folder, 'runs'), { recursive: true });
  const all = { machine: cpus()[0].model, threads: availableParallelism(), node: process.version, steps: options.steps, longest: options.longest, results: [] };
  const slow = new Map();
  const scenesOfLargest = {};
  for (const bodies of options.bodies)
    for (const scene of options.scenes) {
      const runs = await runScene(options, slow, scene, bodies);
      const rows = Object.fromEntries(Object.entries(runs).map(([name, list]) => [name, rowOf(list, bodies)]));
      if (!options.quote) console.log(tableOf(scene, bodies, options.seeds, rows));
      all.results.push({ scene, bodies, rows, runs });
      if (bodies === Math.max(...options.bodies)) scenesOfLargest[scene] = rows;
      if (options.json) writeFileSync(options.json, `${JSON.stringify(all, null, 1)}\n`);
    }
  if (options.quote) console.log(quoteOf(options.contestants, scenesOfLargest));
  if (options.figure) drawFigure(options.figure, scenesOfLargest);
}

try {
  await main();
} catch (error) {
  console.error(`showdown: ${error.message}.`);
  process.exitCode = 2;
}
