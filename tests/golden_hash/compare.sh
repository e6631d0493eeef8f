#!/usr/bin/env bash
# Builds core, plugin and the golden heap with every compiler that is installed, at several levels of optimisation, and
# compares how the heap ends: the same bits in all of them, or this fails. Usage: compare.sh [FOLDER-FOR-BUILDS]
# CAIRN_COMPILERS and CAIRN_LEVELS choose others than g++ and clang++ at -O0 and -O2.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${1:-$root/build/golden}
read -r -a compilers <<< "${CAIRN_COMPILERS:-g++ clang++}"
read -r -a levels <<< "${CAIRN_LEVELS:--O0 -O2}"
expected='' built=0 failed=0

for compiler in "${compilers[@]}"; do
  if ! command -v "$compiler" > /dev/null; then
    echo "$compiler: not installed, left out"
    continue
  fi
  for level in "${levels[@]}"; do
    build="$folder/$compiler$level"
    mkdir -p "$build"
    # Assertions on below -O2: they must not change a bit either.
    flags=$level
    [[ $level == -O[23] ]] && flags+=" -DNDEBUG"
    if ! { cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=None \
                 -DCMAKE_CXX_FLAGS="$flags" -DCAIRN_BUILDER=OFF -DCAIRN_DEMOS=OFF -DCAIRN_BENCHMARKS=OFF \
                 -DCAIRN_CHECK_HEADERS=OFF &&
           cmake --build "$build" --target golden_hash; } > "$build/log" 2>&1; then
      echo "$compiler $level: did not build, see $build/log"
      failed=1
      continue
    fi
    hash=$("$build/bin/golden_hash") || failed=1
    echo "$compiler $("$compiler" -dumpversion) $flags: ${hash:-no hash}"
    built=$((built + 1))
    [[ -z $expected ]] && expected=$hash
    [[ $hash == "$expected" ]] || failed=1
  done
done
((built > 1)) || { echo "fewer than two builds: nothing was compared"; exit 1; }
((failed == 0)) || { echo "not the same bits, or not the golden ones"; exit 1; }
echo "$built builds, the same bits"
