// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every engine on the same scenes, judged by one judge. Prints Markdown tables; what wins is what is printed.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { availableParallelism, cpus } from 'node:os';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { kContestants } from './contestants.mjs';
import { drawFigure, figuresOf, summaryOf, tableOf } from './figures.mjs';
import { prepareModel } from './models.mjs';
import { halfWidthOf, kScenes, pitFaces } from './scenes.mjs';

const kUsage = `usage: ./cairn.sh showdown [OPTIONS]
  --bodies 60,100        numbers of bodies
  --seeds 1,2,3          of start poses
  --scenes NAMES         of ${Object.keys(kScenes).join(', ')}
  --contestants NAMES    of ${Object.keys(kContestants).join(', ')}
  --steps 300            of 1/60 s
  --json FILE            writes every run's figures
  --figure FILE.svg      draws depth against time, for the largest number of bodies
  --limit 3600           seconds that one run may take; longer ones are told as such
  --resume               takes runs that an earlier, stopped call finished, instead of running them again`;

const kFlags = ['--no-liftoff', '--max-old-space-size=2048']; // optimised code from the first call on, for everybody
const here = import.meta.dirname;
const root = resolve(here, '../..');

function optionsOf() {
  const text = { type: 'string' };
  const defaults = { bodies: '60,100', seeds: '1,2,3', scenes: Object.keys(kScenes).join(), contestants: Object.keys(kContestants).join(), steps: '300', limit: '3600' };
  const known = { bodies: text, seeds: text, scenes: text, contestants: text, steps: text, json: text, figure: text, limit: text, cairn: text, judge: text, bunny: text, folder: text, resume: { type: 'boolean' }, help: { type: 'boolean' } };
  const { values } = parseArgs({ options: known });
  if (values.help) return null;
  const all = { cairn: `${root}/build/release/bin/cairn`, judge: `${root}/build/release/bin/showdown_judge`, bunny: `${root}/out/showdown/bunny.obj`, folder: `${root}/out/showdown`, ...defaults, ...values };
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
  return { ...all, bodies: numbers('bodies'), seeds: numbers('seeds'), scenes: list('scenes'), contestants: list('contestants'), steps: numbers('steps')[0], limit: numbers('limit')[0] };
}

const say = (words) => process.stderr.write(`  ${words}\n`);

/// Runs `command` and reads the JSON it prints; its last line of complaint is the error.
function jsonOf(command, words, seconds) {
  try {
    return JSON.parse(execFileSync(command, words, { encoding: 'utf8', maxBuffer: 1 << 28, timeout: 1000 * seconds, stdio: ['ignore', 'pipe', 'pipe'] }));
  } catch (error) {
    if (error.code === 'ETIMEDOUT') throw new Error(`not done in ${seconds} s`);
    const complaint = String(error.stderr ?? error).trim().split('\n').find((line) => /Error|:/.test(line));
    throw new Error(complaint ?? error.message);
  }
}

function runOnce(options, scene, bodies, seed, contestant, model) {
  const frames = [0.25, 0.5, 1].map((part) => Math.round(part * options.steps));
  const config = join(options.folder, 'run.json');
  writeFileSync(config, JSON.stringify({ scene, bodies, seed, contestant, model, steps: options.steps, frames }));
  const measured = jsonOf(process.execPath, [...kFlags, join(here, 'run.mjs'), config], options.limit);
  const { vertices, indices } = JSON.parse(readFileSync(model.mesh));
  const question = join(options.folder, 'frames.json');
  writeFileSync(question, JSON.stringify({ vertices, indices, faces: pitFaces(halfWidthOf(bodies)), frames: measured.frames.map(({ poses }) => poses) }));
  return figuresOf(measured, jsonOf(options.judge, [question], 3600));
}

/// A run from its file, where it is resumed; else measured, and put there.
function runOrRead(options, scene, bodies, seed, contestant, model) {
  const file = join(options.folder, 'runs', `${scene}-${bodies}-${seed}-${contestant}-${options.steps}.json`);
  if (options.resume && existsSync(file)) return JSON.parse(readFileSync(file, 'utf8'));
  say(`${scene}, ${bodies} bodies, seed ${seed}: ${kContestants[contestant].what}`);
  const figures = runOnce(options, scene, bodies, seed, contestant, model);
  writeFileSync(file, JSON.stringify(figures));
  return figures;
}

/// Seed by seed, all contestants in turn, so that a loaded hour of the machine is nobody's alone.
async function runScene(options, scene, bodies) {
  const model = await prepareModel(kScenes[scene].model, { ...options, folder: join(options.folder, 'models') });
  const runs = Object.fromEntries(options.contestants.map((name) => [name, []]));
  for (const seed of options.seeds)
    for (const name of options.contestants) {
      try {
        runs[name].push({ seed, ...runOrRead(options, scene, bodies, seed, name, model) });
      } catch (error) {
        runs[name].push({ seed, failed: error.message });
      }
    }
  return runs;
}

const rowOf = (runs) => {
  const failed = runs.find((run) => run.failed);
  return failed ? { failed: failed.failed } : summaryOf(runs);
};

async function main() {
  const options = optionsOf();
  if (!options) return console.log(kUsage);
  mkdirSync(join(options.folder, 'runs'), { recursive: true });
  const all = { machine: cpus()[0].model, threads: availableParallelism(), node: process.version, steps: options.steps, results: [] };
  const scenesOfLargest = {};
  for (const bodies of options.bodies)
    for (const scene of options.scenes) {
      const runs = await runScene(options, scene, bodies);
      const rows = Object.fromEntries(Object.entries(runs).map(([name, list]) => [name, rowOf(list)]));
      console.log(tableOf(scene, bodies, options.seeds, rows));
      all.results.push({ scene, bodies, rows, runs });
      if (bodies === Math.max(...options.bodies)) scenesOfLargest[scene] = rows;
      if (options.json) writeFileSync(options.json, `${JSON.stringify(all, null, 1)}\n`);
    }
  if (options.figure) drawFigure(options.figure, scenesOfLargest);
}

try {
  await main();
} catch (error) {
  console.error(`showdown: ${error.message}.`);
  process.exitCode = 2;
}
