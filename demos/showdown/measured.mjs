// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is kept of a run.

export const quantile = (list, part) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(part * list.length))];
export const median = (list) => quantile(list, 0.5);
export const sum = (list) => list.reduce((total, value) => total + value, 0);

const timesOf = (list) => (list.length ? { median: median(list), p99: quantile(list, 0.99), mean: sum(list) / list.length } : null);

/// `measured` as run.mjs prints it, `judged` as the judge does, a frame each. Who was nowhere in any frame is lost.
export function figuresOf(measured, judged) {
  const { cpuMs, wallMs, narrowPhaseMs, missedMs, frames, lost, ...rest } = measured;
  // Engines tell the time that passed. Of a step that lost the processor it is a share of the step all the same.
  const narrowCpuMs = narrowPhaseMs.map((passed, k) => cpuMs[k] * Math.min(1, passed / wallMs[k]));
  return {
    ...rest,
    lost: Math.max(lost, ...judged.map(({ nowhere }) => nowhere)),
    stepCpuMs: timesOf(cpuMs),
    stepWallMs: timesOf(wallMs),
    narrowPhaseCpuMs: timesOf(narrowCpuMs),
    missedMs: missedMs.length ? Math.max(...missedMs) : null,
    judged: judged.map((frame, k) => ({ step: frames[k].step, ...frame })),
  };
}

/// Tells when a contestant is too slow to go on: when at least three steps took longer than `longest` and together ten times
/// as long. Three of 300 are its slowest per cent, so what it would have to show is longer than that, too.
export function makePatience(longest) {
  let [slow, whole] = [0, 0];
  return (milliseconds) => {
    if (milliseconds > longest) [slow, whole] = [slow + 1, whole + milliseconds];
    return slow < 3 || whole < 10 * longest;
  };
}
