#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Holds run.sh to what it promises, on a tetrahedron.   test.sh TOOL
set -euo pipefail
command -v jq > /dev/null || exit 77
tool=$1 run=$(dirname "${BASH_SOURCE[0]}")/run.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "test.sh: $1" >&2; exit 1; }

corners=$'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n'
printf '%sf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' "$corners" > "$work/bunny.obj"
printf '%sf 1 3 2\nf 1 2 4\n' "$corners" > "$work/open.obj"
tables() { "$run" --tool "$tool" --out "$work/out" "$@" -- --depth 2 --samples 100; }

tables "$work/bunny.obj" --methods octree,merge --csv "$work/fit.csv" --json "$work/all.json" > "$work/text" 2> "$work/progress"
[[ $(wc -l < "$work/fit.csv") == 5 ]] || fail 'two methods of two levels make four lines and a head'
[[ $(wc -l < "$work/progress") == 2 ]] || fail 'every build is announced'
grep -q '^== Thesis, table 7.2, bunny' "$work/text" || fail 'the bunny is compared with table 7.2'
jq -e '.builds | length == 2 and all(.[].levels[]; .certified_max_fraction >= .sampled_max_fraction)' "$work/all.json" \
  > /dev/null || fail 'the JSON holds both builds'
jq -e 'any(.ratios[]; .thesis_max == 1.56 and .sampled_max == null)' "$work/all.json" > /dev/null \
  || fail 'without hubbard there is no ratio beside the thesis one'

tables "$work/bunny.obj" --methods octree,merge > "$work/again" 2> "$work/progress"
cmp -s "$work/text" "$work/again" && [[ ! -s $work/progress ]] || fail 'a second run repeats no build'

tables "$work/bunny.obj" > "$work/text" 2> /dev/null
for method in $("$tool" build --help | sed -n 's/.*--method TEXT:{\([^}]*\)}.*/\1/p' | tr , ' '); do
  grep -q "^$method  *1 " "$work/text" || fail "$method is a method of the tool and missing"
done

code=0
tables "$work/open.obj" "$work/bunny.obj" --methods octree > "$work/text" 2> "$work/errors" || code=$?
[[ $code == 1 ]] && grep -q 'failed: open, octree: cairn: ' "$work/errors" || fail 'a failed build is named and fails the run'
grep -q '^== bunny' "$work/text" || fail 'the other builds are printed all the same'
code=0
tables "$work/nothing.obj" > /dev/null 2>&1 || code=$?
[[ $code == 2 ]] || fail 'a mesh that is not there is wrong usage'
