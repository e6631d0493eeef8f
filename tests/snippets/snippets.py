# SPDX-License-Identifier: Zlib
"""The code blocks of README.md and docs/, told apart by what has to be true of them.

What a page writes, and what becomes of it:

  ```cpp     With `int main` a program, else a fragment: it is put into a function where the names of harness.h are there
             (`world`, `dispatcher`, `shape`, `body`, `ground`, `tree`, `fail`), may hide them by its own, and may return an
             int. Its #include lines go to the top. Compiled without a warning, linked and run; it must end with 0.
  ```cmake   A CMakeLists.txt. What it lacks of project, add_executable(game game.cpp) and find_package(cairn) is put
             before it. Configured, built and run, with Cairn installed; with FetchContent or add_subdirectory configured.
  ```sh      and blocks without a language: their lines with pkg-config are run beside a game.cpp, and what they compile.
  `c++ ... pkg-config ...` in a sentence: the same.

A comment before a block says what differs:

  <!-- not run: REASON -->     it is shown only
  <!-- with: STATEMENTS -->    C++ that comes before a fragment, for what its page takes as given
  <!-- goes on -->             the fragment goes on where that before it on this page ended
"""
import re
from dataclasses import dataclass, field
from pathlib import Path

FENCE = re.compile(r'^(\s*)(```+)\s*([\w+-]*)\s*$')
MARKER = re.compile(r'^\s*<!--\s*(not run:|with:|goes on)\s*(.*?)\s*-->\s*$')
INLINE = re.compile(r'`((?:c\+\+|g\+\+|clang\+\+|cc|gcc|clang)\s[^`]*pkg-config\s+--[^`]*|pkg-config\s+--[^`]*)`')
CPP = {'cpp', 'c++', 'cxx'}
SHELL = {'', 'sh', 'bash', 'shell', 'console'}


@dataclass
class Block:
  page: Path
  line: int  # of its first line of code, from 1
  language: str
  text: str
  reason: str = ''  # why it is not run
  given: str = ''
  goes_on: bool = False
  lines: list = field(default_factory=list)

  @property
  def place(self):
    return f'{self.page}:{self.line}'


class BadPage(Exception):
  pass


def blocks_of(page, text):
  """Every fenced block of a page, with its markers. A marker that belongs to no block is an error."""
  blocks, markers, block, close = [], [], None, None
  for number, line in enumerate(text.split('\n'), 1):
    if block is not None:
      if line.strip() == close:
        block.text = '\n'.join(block.lines) + '\n'
        blocks.append(block)
        block = None
      else:
        block.lines.append(line[len(indent):] if line.startswith(indent) else line)
    elif fence := FENCE.match(line):
      indent, close = fence[1], fence[2]
      block = Block(page, number + 1, fence[3].lower(), '')
      for kind, what in markers:
        apply_marker(block, kind, what)
      markers = []
    elif marker := MARKER.match(line):
      markers.append((marker[1], marker[2]))
    elif line.strip() and markers:
      raise BadPage(f'{page}:{number}: a marker "{markers[-1][0]}" stands before no block')
  if block is not None:
    raise BadPage(f'{page}:{block.line}: the block does not end')
  return blocks


def apply_marker(block, kind, what):
  if kind == 'not run:':
    if not what:
      raise BadPage(f'{block.place}: "not run:" needs its reason')
    block.reason = what
  elif kind == 'with:':
    block.given += what + '\n'
  else:
    block.goes_on = True


def check_label(block):
  """Code that hides in a block without a language would be run by nobody."""
  if block.language:
    return
  if re.search(r'^\s*#include [<"]|^\s*cairn::|target_link_libraries\(', block.text, re.M):
    raise BadPage(f'{block.place}: the block is code, so say of which language: ```cpp or ```cmake')


def inline_commands(page, text):
  """(line, command) of commands with pkg-config in sentences."""
  outside = re.sub(r'^(\s*```+).*?^\1?\s*```+\s*$', lambda m: '\n' * m[0].count('\n'), text, flags=re.S | re.M)
  return [(outside.count('\n', 0, m.start()) + 1, ' '.join(m[1].split())) for m in INLINE.finditer(outside)]


def shell_commands(block):
  """(line, command) of the block's lines with pkg-config, without prompts."""
  found = []
  for offset, line in enumerate(block.text.split('\n')):
    if re.search(r'pkg-config\s+--', line.split(' #')[0]):
      found.append((block.line + offset, re.sub(r'^\s*\$ ', '', line).strip()))
  return found


def one_source(fragments):
  """One C++ file with every fragment as a function of its own, and a main that runs the one of a number. Messages name the
  page and its line."""
  includes, bodies = [], []
  for block in fragments:
    body = []
    for offset, line in enumerate(block.text.split('\n')):
      if re.match(r'^\s*#include\b', line):
        includes.append(line)
        line = ''
      body.append(line)
    code = f'{block.given}#line {block.line} "{block.page}"\n' + '\n'.join(body) + '\n'
    if block.goes_on:
      if not bodies or bodies[-1][0] != block.page:
        raise BadPage(f'{block.place}: "goes on" after no fragment of this page')
      bodies[-1][1].append(code)
    else:
      bodies.append((block.page, [code], block.place))
  source = ['#include "harness.h"'] + sorted(set(includes))
  for index, (_, codes, _) in enumerate(bodies):
    source.append(f'static int fragment{index}([[maybe_unused]] Given& given) {{\n  CAIRN_GIVEN_NAMES\n  {{')
    source += codes
    source.append('  }\n  return 0;\n}')
  calls = ', '.join(f'fragment{i}' for i in range(len(bodies)))
  source.append(f'int main(int argc, char** argv) {{ return runFragment(argc, argv, {{{calls}}}); }}\n')
  return '\n'.join(source), [place for _, _, place in bodies]


def complete_cmake(text, cairn):
  """The project a block of CMake belongs to."""
  before = []
  if 'cmake_minimum_required' not in text:
    before.append('cmake_minimum_required(VERSION 3.25)\nproject(Game LANGUAGES CXX)')
  if 'find_package(' + cairn not in text and 'FetchContent' not in text and 'add_subdirectory' not in text:
    before.append(f'find_package({cairn} REQUIRED)')
  if not re.search(r'add_executable\(\s*game\b', text):
    before.append('add_executable(game game.cpp)')
  if 'project(' in text and before:
    raise BadPage('a block with a project of its own has to be whole')
  return '\n'.join(before) + '\n' + text
