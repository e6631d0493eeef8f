#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# Programs on an installed Cairn that are compiled otherwise than Cairn was: without run-time type information and
# exceptions, as C++17, with other flags of the linker.
# Usage: roads.sh PREFIX COMPILER [SUFFIX]   PREFIX: where Cairn is installed; SUFFIX: "-float64" for double precision
set -euo pipefail
prefix=$1 compiler=$2 suffix=${3:-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$here/../data/rock.cairn
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "roads: $*" >&2; exit 1; }
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name "cairn$suffix.pc")")
export PKG_CONFIG_PATH
read -ra flags <<< "$(pkg-config --cflags --libs "cairn-effects$suffix")"

# A tree in a game without run-time type information and exceptions.
for linked in "-pie -fPIE" "-no-pie -fno-pie"; do
  read -ra how <<< "$linked"
  "$compiler" -std=c++20 -O1 -fno-rtti -fno-exceptions "${how[@]}" "$here/no_rtti.cpp" "${flags[@]}" -o "$scratch/no_rtti" > "$scratch/log" 2>&1 ||
    fail "a game without type information does not build: $(cat "$scratch/log")"
  "$scratch/no_rtti" "$tree" || fail "a game without type information ($linked) does not run"
done

# No standard is forced on who wants a newer one, and an older one is told in one sentence.
[[ " ${flags[*]} " != *" -std="* ]] || fail "pkg-config forces a standard: ${flags[*]}"
for header in bullet/dispatcher.h bullet/sphere_tree_shape.h bullet/install.h bullet/terrain_shape.h core/tree_file.h core/result.h \
  core/sphere_tree.h effects/effect_set.h; do
  printf '#include <cairn/%s>\nint main() {}\n' "$header" > "$scratch/old.cpp"
  ! "$compiler" -std=c++17 -fsyntax-only "$scratch/old.cpp" "${flags[@]}" > "$scratch/log" 2>&1 || fail "$header is taken as C++17"
  grep -q 'error.*Cairn needs C++20: compile with -std=c++20' "$scratch/log" || fail "$header says as C++17: $(cat "$scratch/log")"
  (($(grep -c ' error: ' "$scratch/log") <= 2)) || fail "$header says more than a sentence as C++17: $(cat "$scratch/log")"
done
# A game in plain C.
read -ra c_flags <<< "$(pkg-config --cflags --libs "cairn-c$suffix")"
cc -std=c99 -O1 -Wall -Wextra -Wpedantic -Werror "$here/game.c" "${c_flags[@]}" -o "$scratch/c_game" > "$scratch/log" 2>&1 ||
  fail "a game in C does not build: $(cat "$scratch/log")"
heights=$("$scratch/c_game" "$tree") || fail "a game in C does not run"
[[ $(awk '$1 > 0 && $1 < 10' <<< "$heights" | wc -l) == 10 ]] || fail "rocks of a game in C end at $heights"

# A game that includes everything reads at most three fifths more lines than one that includes Bullet alone: of these
# nine tenths are the standard library's.
lines() { printf '#include <%s>\n' btBulletDynamicsCommon.h "$@" | "$compiler" -std=c++20 -E -P -x c++ - "${flags[@]}" | grep -c .; }
alone=$(lines cstddef) game=$(lines cairn/bullet/dispatcher.h) all=$(lines cairn/bullet.h)
echo "lines of headers: Bullet $alone, with the dispatcher $game, with all of cairn/bullet.h $all"
((5 * all <= 8 * alone)) || fail "headers have grown: $alone, $game, $all"
"$compiler" -std=c++2b -fsyntax-only "$here/rocks_tree.cpp" "${flags[@]}" || fail "not taken as C++23"
