#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of docs/rockfall.md that lead to a hazard map, in their order, on a small elevation model.

  rockfall_page.py ROOT BIN   BIN: the folder of the program rockfall

The lines are the page's own, but for the numbers of runs and processes. Exit code 77 where a program they need is missing.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

MARKER = '<!-- run as a whole: rockfall -->'
NEEDED = ('gdalwarp', 'gdaldem', 'gdal_translate', 'rsvg-convert')
# Fewer runs and processes than the page has: (pattern, what stands for it).
SHORTER = ((r'--runs 0:5\b', '--runs 0:2'), (r'--runs 0:20\b', '--runs 0:5 --halvings 1'), (r'--runs 0:1000\b', '--runs 0:4'), (r'--jobs 8\b', '--jobs 2'))
MOST_SECONDS = 300
WRITTEN = ('slope.tif', 'look/map.png', 'results/map.png', 'results/results.gpkg',
           'results/collectors_summary.csv', 'results/reach_probability.prj', 'hazard.tif', 'reached.tif')


def block_after(text, start):
  return re.search(r'```\n(.*?)```', text[text.index(start):], re.S)[1]


def commands(page):
  lines = [line.split(' #')[0].strip() for line in block_after(page, MARKER).splitlines()]
  return [line for line in lines if line]


def prepare(folder, root, page):
  (folder / 'demos').symlink_to(root / 'demos')
  subprocess.run(['gdal_translate', '-q', '-a_srs', 'EPSG:2056', root / 'demos/rockfall/examples/gully.asc', folder / 'dem.tif'],
                 check=True)
  (folder / 'classes.txt').write_text(re.search(r'```\n(nv .*?)```', page, re.S)[1])
  (folder / 'chances.txt').write_text('nv 0 0 0 0\n0 255 255 255\n1 0 0 0\n')


def name_own_maps(folder):
  """What the page leaves to the reader: the case names the terrain that was warped."""
  case = folder / 'maps.json'
  text = case.read_text()
  assert '"gully.asc"' in text
  case.write_text(text.replace('"gully.asc"', '"slope.tif"'))


def main(root, programs):
  root = Path(root).resolve()
  page = (root / 'docs' / 'rockfall.md').read_text()
  missing = [name for name in NEEDED if shutil.which(name) is None]
  if missing:
    print(f'skipped: {", ".join(missing)} not installed')
    return 77
  with tempfile.TemporaryDirectory() as scratch:
    folder = Path(scratch)
    prepare(folder, root, page)
    environment = dict(os.environ, PATH=f'{Path(programs).resolve()}:{os.environ["PATH"]}', XDG_CACHE_HOME=str(folder / 'cache'))
    lines = commands(page)
    for line in lines:
      for pattern, shorter in SHORTER:
        line = re.sub(pattern, shorter, line)
      done = subprocess.run(line, shell=True, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, timeout=MOST_SECONDS)
      print(f'$ {line}\n{done.stdout[-2000:]}', end='')
      if 'built without GDAL' in done.stdout:
        return 77
      if done.returncode != 0:
        print(f'FAILED with {done.returncode}: {line}')
        return 1
      if line.startswith('cp '):
        name_own_maps(folder)
    absent = [name for name in WRITTEN if not (folder / name).exists() or (folder / name).stat().st_size == 0]
    print(f'{len(lines)} commands run; missing or empty: {absent}')
    return 1 if absent or len(lines) != 10 else 0


if __name__ == '__main__':
  sys.exit(main(*sys.argv[1:]))
