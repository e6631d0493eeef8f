#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# Cairn built in the game's own project, as a game has it beside its sources or fetches it: add_subdirectory, FetchContent
# from a clone, as static and as shared libraries. The game is snippets/game.cpp with effects. Minutes.
# Usage: sources.sh COMPILER [WAY...]   WAY: subdirectory, fetched, shared; all of them unless named
set -euo pipefail
compiler=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "sources: $*" >&2; exit 1; }
(($#)) || set -- subdirectory fetched shared
launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

for way in "$@"; do
  game=$scratch/$way
  mkdir -p "$game"
  cp "$here/../snippets/game.cpp" "$here/../data/rock.cairn" "$game"
  case $way in
    fetched) bring="include(FetchContent)
FetchContent_Declare(cairn GIT_REPOSITORY file://$root GIT_TAG HEAD)
FetchContent_MakeAvailable(cairn)" ;;
    *) bring="add_subdirectory($root cairn)" ;;
  esac
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(Game LANGUAGES CXX)\n%s\nadd_executable(game game.cpp)\n%s\n%s\n' "$bring" \
    'target_compile_definitions(game PRIVATE WITH_EFFECTS)' 'target_link_libraries(game PRIVATE cairn::effects)' > "$game/CMakeLists.txt"
  shared=OFF
  [[ $way != shared ]] || shared=ON
  cmake -G Ninja -S "$game" -B "$game/build" -DCMAKE_CXX_COMPILER="$compiler" "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_UNITY_BUILD=ON -DBUILD_SHARED_LIBS=$shared > "$scratch/log" 2>&1 ||
    fail "$way is not configured: $(cat "$scratch/log")"
  ! ninja -C "$game/build" -t targets all | grep -qE '(^|/)(cairn_builder|plugin_tests|rockfall)' || fail "$way: the game builds more than it wants"
  cmake --build "$game/build" --target game cairn_c cairn_soft > "$scratch/log" 2>&1 || fail "$way is not built: $(tail -30 "$scratch/log")"
  (cd "$game" && build/game) || fail "$way does not run"
  if [[ $shared == ON ]]; then
    for library in core bullet effects soft c; do
      nm -DC --defined-only "$(find "$game/build" -name "libcairn_$library.so")" | awk '$2 ~ /[TBDRV]/ { $1 = $2 = ""; print substr($0, 3) }' |
        sed 's/(.*//' | grep -E "^cairn(::|[A-Z])" | sort -u > "$scratch/$library"
      diff "$here/exported/$library.txt" "$scratch/$library" || fail "libcairn_$library shows other symbols than tests/consumer/exported/$library.txt"
    done
  fi
done
