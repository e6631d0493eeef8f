#!/usr/bin/env bash
# SPDX-License-Identifier: Zlib
# Bullet without run-time type information, as its own project builds it with MSVC, Cairn built for it, and a game without
# it and without exceptions that lives on both. Bullet comes from Debian's sources: minutes, so only when asked for.
# Usage: no_rtti.sh BUILD_FOLDER COMPILER TREE
set -euo pipefail
build=$1 compiler=$2 tree=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -G Ninja -S "$here/../.." -B "$build" -DCMAKE_CXX_COMPILER="$compiler" "${launcher[@]}" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_UNITY_BUILD=ON -DCAIRN_BULLET_WITHOUT_RTTI=ON \
  -DCAIRN_BUILDER=OFF -DCAIRN_DEMOS=OFF -DCAIRN_TESTS=OFF
cmake --build "$build" --target cairn_effects no_rtti_game
nm -C "$build/bin/no_rtti_game" | grep -E 'typeinfo for (bt|cairn)' && { echo "no_rtti: type information of Bullet or Cairn" >&2; exit 1; }
"$build/bin/no_rtti_game" "$tree"
