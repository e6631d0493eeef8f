#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Many runs of a small case: the merged hash of 1, 2 and 7 workers, and of a folder whose workers were killed outright and
started again. Prints time and memory of each; exit code 1 if a hash differs or no kill came in the middle.

  workers.py BIN RUNS   BIN: the folder of the program rockfall
"""
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CASE = {
    'case': 'small', 'seed': 7, 'step_s': 0.01, 'duration_s': 2, 'materials': ['stone', 'soil'],
    'terrain': {'generated': 'plane', 'length_m': 40, 'width_m': 20, 'slope_deg': 35, 'material': 'soil', 'roughness_m': 0.05},
    'rocks': [{'count': 1, 'make': {'kind': 'angular'}, 'sieve_m': {'sizes': [[0.4, 0], [0.8, 1]]}, 'tree_depth': 1,
               'density_kg_per_m3': 2600, 'material': 'stone', 'release': {'box_m': [[3, -3], [6, 3]], 'above_ground_m': 1}}],
    'effects': [{'effect': 'friction', 'default': 0.5},
                {'effect': 'restitution', 'law': 'constant', 'default': 0.3}],
    'collectors': [{'name': 'toe', 'line_m': [[12, -10], [12, 0], [13, 10]]}],
    'outputs': {'raster_cell_m': 1},
}
POLL_SECONDS = 0.02


class Ensemble:
  def __init__(self, programs, runs, folder):
    self.program, self.runs, self.folder = str(Path(programs).resolve() / 'rockfall'), runs, Path(folder)
    (self.folder / 'small.json').write_text(json.dumps(CASE))

  def command(self, name, jobs):
    return [self.program, 'run', str(self.folder / 'small.json'), '--runs', f'0:{self.runs}', '--jobs', str(jobs),
            '--cache', str(self.folder / 'trees'), '-o', str(self.folder / name)]

  def done(self, name):
    folder = self.folder / name
    return sum(1 for entry in os.scandir(folder) if entry.name.startswith('run-')) if folder.exists() else 0

  def measured(self, command):
    """Seconds, greatest memory of one process in MiB, and what it printed."""
    begin = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    output = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
      sys.exit(f'{" ".join(command)} ended with status {status}')
    return time.monotonic() - begin, usage.ru_maxrss / 1024, output

  def compute(self, name, jobs):
    seconds, memory, _ = self.measured(self.command(name, jobs))
    return seconds, memory

  def merge(self, name):
    seconds, memory, output = self.measured([self.program, 'merge', str(self.folder / name), '-o', str(self.folder / f'{name}-merged')])
    return seconds, memory, re.search(r'merged hash (\w+)', output)[1]

  def kill_in_the_middle(self, name, jobs):
    """Kills the program and its workers, which are a group of their own; gives the number of runs that are there."""
    child = subprocess.Popen(self.command(name, jobs), stdout=subprocess.DEVNULL, start_new_session=True)
    while self.done(name) < self.runs // 3 and child.poll() is None:
      time.sleep(POLL_SECONDS)
    os.killpg(child.pid, signal.SIGKILL)
    child.wait()
    return self.done(name)


def main(programs, runs):
  with tempfile.TemporaryDirectory() as folder:
    ensemble = Ensemble(programs, int(runs), folder)
    hashes = {}
    print(f'{"workers":<22} {"run s":>8} {"MiB":>6} {"merge s":>8} {"MiB":>6}  merged hash')
    killed = ensemble.kill_in_the_middle('killed', 2)
    if not 0 < killed < ensemble.runs:
      print(f'{killed} of {runs} runs were there after the kill: it did not come in the middle')
      return 1
    for name, jobs in (('killed', 2), ('one', 1), ('two', 2), ('seven', 7)):
      seconds, memory = ensemble.compute(name, jobs)
      merge_seconds, merge_memory, hashes[name] = ensemble.merge(name)
      title = f'{jobs}, {killed} runs kept' if name == 'killed' else str(jobs)
      print(f'{title:<22} {seconds:8.1f} {memory:6.0f} {merge_seconds:8.1f} {merge_memory:6.0f}  {hashes[name][:16]}', flush=True)
    if len(set(hashes.values())) != 1:
      print('the hashes differ')
      return 1
    return 0


if __name__ == '__main__':
  sys.exit(main(*sys.argv[1:]))
