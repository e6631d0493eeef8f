#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""Compiles and runs the code of README.md and docs/ as it stands there (snippets.py says by which rules).

  check.py ROOT PREFIX COMPILER [SUFFIX]   PREFIX: where Cairn is installed; SUFFIX: -float64 for double precision
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import snippets

HERE = Path(__file__).resolve().parent
WARNINGS = ['-Wall', '-Werror', '-Wno-unused-variable', '-Wno-unused-but-set-variable']
MOST_SECONDS = 120


class Checker:
  def __init__(self, root, prefix, compiler, suffix, scratch):
    self.root, self.prefix, self.compiler, self.suffix = Path(root), Path(prefix), compiler, suffix
    self.scratch, self.failures, self.count = Path(scratch), [], 0
    folders = {str(pc.parent) for pc in self.prefix.rglob(f'cairn{suffix}.pc')}
    self.environment = dict(os.environ, PKG_CONFIG_PATH=':'.join(sorted(folders)))

  def run(self, place, command, folder):
    """One command that must end with 0; what it wrote is told where it does not."""
    done = subprocess.run(command, cwd=folder, env=self.environment, shell=isinstance(command, str), executable='/bin/bash' if isinstance(command, str) else None,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=MOST_SECONDS)
    if done.returncode != 0:
      self.failures.append(f'{place}: {command if isinstance(command, str) else " ".join(map(str, command))}\n  ended with '
                           f'{done.returncode}:\n{done.stdout[-3000:]}')
    return done.returncode == 0

  def folder(self, name):
    folder = self.scratch / re.sub(r'\W', '_', name)
    folder.mkdir(parents=True)
    shutil.copy(HERE.parent / 'data' / 'rock.cairn', folder)
    shutil.copy(HERE / 'game.cpp', folder)
    return folder

  def flags(self):
    names = [f'cairn-effects{self.suffix}']
    text = subprocess.run(['pkg-config', '--cflags', '--libs', *names], env=self.environment, check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    return text.split()

  def compile(self, place, source, folder):
    return self.run(place, [self.compiler, '-std=c++20', *WARNINGS, f'-I{HERE}', source, '-o', 'program', *self.flags()],
                    folder)

  def fragments(self, blocks):
    source, places = snippets.one_source(blocks)
    folder = self.folder('fragments')
    (folder / 'fragments.cpp').write_text(source)
    self.count += len(blocks)
    if self.compile('fragments', 'fragments.cpp', folder):
      for number, place in enumerate(places):
        self.run(place, ['./program', str(number)], folder)

  def program(self, block):
    folder = self.folder(block.place)
    (folder / 'page.cpp').write_text(f'#line {block.line} "{block.page}"\n{block.text}')
    self.count += 1
    if self.compile(block.place, 'page.cpp', folder):
      self.run(block.place, ['./program', 'rock.cairn'], folder)

  def cmake(self, block):
    folder = self.folder(block.place)
    (folder / 'CMakeLists.txt').write_text(snippets.complete_cmake(block.text, 'cairn'))
    for name in re.findall(r'add_subdirectory\(\s*([\w./-]+)', block.text):
      (folder / name).parent.mkdir(parents=True, exist_ok=True)
      (folder / name).symlink_to(self.root.resolve())
    isSource = 'FetchContent' in block.text or 'add_subdirectory' in block.text
    define = '-DWITH_EFFECTS' if 'cairn::effects' in block.text else ''
    self.count += 1
    configured = self.run(block.place, ['cmake', '-G', 'Ninja', '-S', '.', '-B', 'build', f'-DCMAKE_CXX_COMPILER={self.compiler}',
                                        f'-DCMAKE_PREFIX_PATH={self.prefix}', f'-DFETCHCONTENT_SOURCE_DIR_CAIRN={self.root.resolve()}',
                                        f'-DCMAKE_CXX_FLAGS={define}'], folder)
    # From source it takes minutes: tests/consumer/roads.sh does that.
    if configured and not isSource and self.run(block.place, ['cmake', '--build', 'build'], folder):
      self.run(block.place, ['build/game'], folder)

  def shell(self, place, command):
    folder = self.folder(place)
    self.count += 1
    if self.run(place, command.replace('cairn-effects', f'cairn-effects{self.suffix}'), folder) and (folder / 'a.out').exists():
      self.run(place, ['./a.out'], folder)

  def page(self, page):
    text = page.read_text()
    name = page.relative_to(self.root)
    fragments = []
    for block in snippets.blocks_of(name, text):
      snippets.check_label(block)
      if block.reason:
        print(f'{block.place}: not run: {block.reason}')
      elif block.language in snippets.CPP and 'int main(' in block.text:
        self.program(block)
      elif block.language in snippets.CPP:
        fragments.append(block)
      elif block.language == 'cmake':
        self.cmake(block)
      elif block.language in snippets.SHELL:
        for line, command in snippets.shell_commands(block):
          self.shell(f'{name}:{line}', command)
    for line, command in snippets.inline_commands(name, text):
      self.shell(f'{name}:{line}', command)
    return fragments


def main(arguments):
  root, prefix, compiler = arguments[:3]
  suffix = arguments[3] if len(arguments) > 3 else ''
  pages = [Path(root) / 'README.md', *sorted((Path(root) / 'docs').rglob('*.md'))]
  with tempfile.TemporaryDirectory() as scratch:
    checker = Checker(root, prefix, compiler, suffix, scratch)
    try:
      fragments = [block for page in pages for block in checker.page(page)]
      if fragments:
        checker.fragments(fragments)
    except snippets.BadPage as bad:
      checker.failures.append(str(bad))
    for failure in checker.failures:
      print(failure, file=sys.stderr)
    print(f'{checker.count} pieces of code on {len(pages)} pages, {len(checker.failures)} failures')
    return 1 if checker.failures or checker.count == 0 else 0


if __name__ == '__main__':
  sys.exit(main(sys.argv[1:]))
