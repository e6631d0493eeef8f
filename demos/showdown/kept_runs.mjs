// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs that an earlier, stopped call finished.
import { existsSync, readFileSync, renameSync, writeFileSync } from 'node:fs';

function read(file) {
  try {
    return JSON.parse(readFileSync(file, 'utf8'));
  } catch {
    return null; // cut short: as if it were not there
  }
}

/// The figures of a file, where it is of the same fingerprint and may be taken; else those of `measure`, which are put there.
export function keptOr(file, fingerprint, isResumed, measure) {
  const kept = isResumed && existsSync(file) ? read(file) : null;
  if (kept?.fingerprint === fingerprint && kept.figures) return kept.figures;
  const figures = measure();
  writeFileSync(`${file}.new`, JSON.stringify({ fingerprint, figures }));
  renameSync(`${file}.new`, file);
  return figures;
}
