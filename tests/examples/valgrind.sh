#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# Examples under Valgrind: no invalid read or write, and nothing lost, to the end of `main` and after it.
# Usage: valgrind.sh TREE PROGRAM...   Each is run with TREE as its argument, for no longer than a second of its world.
set -euo pipefail
command -v valgrind > /dev/null || { echo "valgrind is not installed: skipped"; exit 77; }
# Some processors have instructions that Valgrind does not know; libraries that use them end before `main`.
valgrind --quiet "$2" --help > /dev/null 2>&1 || [[ $? != 132 ]] || { echo "Valgrind does not know this processor: skipped"; exit 77; }
tree=$1
shift
for program in "$@"; do
  valgrind --quiet --error-exitcode=99 --leak-check=full --errors-for-leak-kinds=definite,indirect "$program" "$tree" 1 > /dev/null
done
