// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of one contestant, measured and judged.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { figuresOf } from './measured.mjs';
import { halfWidthOf, pitFaces } from './scenes.mjs';

export const kFlags = ['--no-liftoff', '--max-old-space-size=2048']; // optimised code from the first call on, for everybody

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

/// Figures of a run, or at which step it was stopped for being too slow.
export function runOnce({ folder, steps, longest, limit, judge }, { scene, bodies, seed, contestant, model }) {
  const frames = [0.25, 0.5, 1].map((part) => Math.round(part * steps));
  const config = join(folder, 'run.json');
  writeFileSync(config, JSON.stringify({ scene, bodies, seed, contestant, model, steps, longest, frames }));
  const measured = jsonOf(process.execPath, [...kFlags, join(import.meta.dirname, 'run.mjs'), config], limit);
  if (measured.stopped) return measured;
  const { vertices, indices } = JSON.parse(readFileSync(model.mesh));
  const question = join(folder, 'frames.json');
  // A pose that is no number is null in JSON, by which the judge knows it.
  writeFileSync(question, JSON.stringify({ vertices, indices, faces: pitFaces(halfWidthOf(bodies)), frames: measured.frames.map(({ poses }) => poses), gapsFrom: measured.frames.length - 1 }));
  return figuresOf(measured, jsonOf(judge, [question], 3600));
}
