#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# Installs a build and lives on what was installed, as a game does: builds through find_package and through pkg-config,
# says what the game links, runs it on a rock where the build has a builder, and checks that docs/games.md tells the
# truth about the change from GImpact.
# Usage: run.sh BUILD_FOLDER COMPILER [SUFFIX]   SUFFIX: "-float64" for a build in double precision
set -euo pipefail
build=$1 compiler=$2 suffix=${3:-}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "consumer: $*" >&2; exit 1; }
quietly() { "$@" > "$scratch/log" 2>&1 || fail "$1 fails: $(cat "$scratch/log")"; }

# Lines of code that were taken away or added.
changes() { grep -E '^[-+]' | grep -vE '^(---|\+\+\+|[-+]//)' || true; }
told=$(sed -n '/^```diff/,/^```$/p' "$here/../../docs/games.md" | changes)
made=$({ diff -U0 "$here/rocks_gimpact.cpp" "$here/rocks_tree.cpp" || true; } | changes)
[[ $(sort <<< "$told") == "$(sort <<< "$made")" ]] || fail "docs/games.md does not show the change: $made"
(($(grep -c '^+' <<< "$made") <= 5)) || fail "more than five lines to write: $made"

quietly cmake --install "$build" --prefix "$scratch/usr"
quietly cmake -G Ninja -S "$here" -B "$scratch/cmake" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_PREFIX_PATH="$scratch/usr" -DCAIRN_PACKAGE="cairn$suffix"
quietly cmake --build "$scratch/cmake"

# A Bullet of the game's own, of this precision and of the other; the same folder again, once mended.
own=float other=double
[[ -z $suffix ]] || { own=double other=float; }
takes() {  # found|built HEADERS LIBRARY
  cmake -G Ninja -S "$here/precision" -B "$scratch/precision_$1" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_PREFIX_PATH="$scratch/usr" -DCAIRN_PACKAGE="cairn$suffix" -DOWN_BULLET="$1" -DOWN_HEADERS="$2" \
    -DOWN_LIBRARY="$3" ${4:+-U "$4"} > "$scratch/log" 2>&1
}
for kind in found built; do
  for pair in "$other $other" "$other $own" "$own $other"; do
    read -r headers library <<< "$pair"
    ! takes $kind "$headers" "$library" '*_found' || fail "a Bullet ($kind) of $pair is taken by cairn$suffix"
    tr -s '\n ' ' ' < "$scratch/log" | grep -q 'must not be mixed' || fail "$kind, $pair: $(cat "$scratch/log")"
  done
  takes $kind $own $own '*_found' || fail "a Bullet ($kind) of $own is refused: $(cat "$scratch/log")"
done

PKG_CONFIG_PATH=$(dirname "$(find "$scratch/usr" -name "cairn$suffix.pc")")
export PKG_CONFIG_PATH
read -ra flags <<< "$(pkg-config --cflags --libs "cairn$suffix")"
quietly "$compiler" -std=c++20 "$here/rocks_tree.cpp" "${flags[@]}" -o "$scratch/by_pkg_config"

# Nothing but Bullet, Highway and the C++ run-time.
needed=$(readelf -d "$scratch/cmake/rocks_tree" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')
heavy=$(grep -vE '^(libBullet|libLinearMath|libhwy|libstdc\+\+|libgcc_s|libm\.|libc\.|ld-linux)' <<< "$needed" || true)
[[ -z $heavy ]] || fail "the game needs $heavy"
strip "$scratch/cmake/rocks_tree" "$scratch/cmake/rocks_gimpact"
size() { stat -c %s "$scratch/cmake/$1"; }
echo "stripped: $(size rocks_tree) bytes with sphere-trees, $(size rocks_gimpact) with GImpact; needs" $needed

# Ten rocks a unit across, thrown apart enough to lie on the ground or on each other.
[[ -x $scratch/usr/bin/cairn && -x $build/bin/make_rock ]] || exit 0
quietly "$build/bin/make_rock" --seed 1 --subdivisions 2 -o "$scratch/rock.obj"
quietly "$scratch/usr/bin/cairn" build "$scratch/rock.obj" -o "$scratch/rock.cairn"
[[ ! -x $scratch/cmake/save_and_load ]] || quietly "$scratch/cmake/save_and_load" "$scratch/rock.cairn"
for game in cmake/rocks_gimpact cmake/rocks_tree by_pkg_config; do
  heights=$("$scratch/$game" "$scratch/rock.obj" "$scratch/rock.cairn") || fail "$game does not run"
  awk -v name="$game" '$1 < 0.1 || $1 > 5 { print name ": a rock ends at " $1; bad = 1 } END { exit bad }' <<< "$heights"
  (($(wc -l <<< "$heights") == 10)) || fail "$game says $heights"
done
