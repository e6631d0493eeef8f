#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""What snippets.py takes for code, and what it refuses."""
import unittest

import snippets

PAGE = '''Text with `c++ -std=c++20 game.cpp $(pkg-config
--cflags --libs cairn)` in it.

<!-- with: int answer = 42; -->

```cpp
#include <cmath>
if (answer != 42) return 1;
```

<!-- goes on -->
```cpp
answer = 43;
```

<!-- not run: needs a server -->
```cpp
serve();
```
```
make  # nothing of ours
c++ game.cpp $(pkg-config --libs cairn)
```
'''


class Snippets(unittest.TestCase):
  def test_blocks_carry_their_markers_and_lines(self):
    first, second, third, shell = snippets.blocks_of('p.md', PAGE)
    self.assertEqual((first.line, first.given, first.language), (7, 'int answer = 42;\n', 'cpp'))
    self.assertTrue(second.goes_on)
    self.assertEqual(third.reason, 'needs a server')
    self.assertEqual(snippets.shell_commands(shell), [(22, 'c++ game.cpp $(pkg-config --libs cairn)')])

  def test_commands_in_sentences_are_found_over_line_ends(self):
    self.assertEqual(snippets.inline_commands('p.md', PAGE),
                     [(1, 'c++ -std=c++20 game.cpp $(pkg-config --cflags --libs cairn)')])

  def test_fragments_become_functions_with_the_pages_lines(self):
    blocks = snippets.blocks_of('p.md', PAGE)[:2]
    source, places = snippets.one_source(blocks)
    self.assertEqual(places, ['p.md:7'])
    self.assertIn('#line 7 "p.md"\n\nif (answer', source)
    self.assertLess(source.index('#include <cmath>'), source.index('fragment0'))
    self.assertLess(source.index('answer = 43'), source.index('return 0;'))

  def test_what_would_be_run_by_nobody_is_refused(self):
    for page in ('```\n#include <cairn/x.h>\n```\n', '```\ntarget_link_libraries(a b)\n```\n'):
      with self.assertRaises(snippets.BadPage):
        snippets.check_label(snippets.blocks_of('p.md', page)[0])
    for page in ('<!-- not run: -->\n```cpp\nx\n```\n', '<!-- goes on -->\ntext\n', '```cpp\nx\n'):
      with self.assertRaises(snippets.BadPage):
        snippets.blocks_of('p.md', page)
    with self.assertRaises(snippets.BadPage):
      snippets.one_source(snippets.blocks_of('p.md', '<!-- goes on -->\n```cpp\nx\n```\n'))

  def test_a_cmake_block_gets_what_it_lacks(self):
    whole = snippets.complete_cmake('target_link_libraries(game PRIVATE cairn::bullet)\n', 'cairn')
    self.assertLess(whole.index('find_package(cairn'), whole.index('add_executable(game'))
    self.assertNotIn('find_package', snippets.complete_cmake('add_subdirectory(cairn)\n', 'cairn'))


if __name__ == '__main__':
  unittest.main()
