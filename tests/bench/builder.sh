#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# How long the builder takes, as a table: the median of repeated runs in one thread, beside the CPU seconds of the thesis
# author's toolkit on models it was measured on (toolkit_cpu.tsv, by file name). With --growth also how time and memory
# grow with the number of triangles, on a mesh subdivided to a million.
set -euo pipefail

usage() {
  cat <<'END'
builder.sh [OPTIONS] MESH...
  --tool PROGRAM   the cairn program (default build/release/bin/cairn)
  --runs N         of each line, the median counts (default 3)
  --methods LIST   separated by commas (default octree,grid,hubbard,merge,expand,combined,adaptive)
  --threads N      (default 1; CPU seconds are those of all threads)
  --growth MESH    simplify this mesh to 62500 triangles, subdivide that to 250000 and 1000000, build all three on all
                   cores with the default method; it needs more triangles than the first
END
}

tool=build/release/bin/cairn runs=3 methods=octree,grid,hubbard,merge,expand,combined,adaptive threads=1 growth='' meshes=()
while (($#)); do
  case $1 in
    --tool) tool=$2; shift 2 ;;
    --runs) runs=$2; shift 2 ;;
    --methods) methods=$2; shift 2 ;;
    --threads) threads=$2; shift 2 ;;
    --growth) growth=$2; shift 2 ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 2 ;;
    *) meshes+=("$1"); shift ;;
  esac
done
((${#meshes[@]})) || [[ -n $growth ]] || { usage >&2; exit 2; }

here=$(dirname "${BASH_SOURCE[0]}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A value of the last report.
value() { sed -n 's/.*"'"$1"'": *"\{0,1\}\([^",]*\).*/\1/p' "$work/report.json" | head -n 1; }

# Builds $1 by method $2 with $3 threads $4 times. Sets cpu, least, most, wall, memory and hash.
measure() {
  local i
  : > "$work/runs"
  for ((i = 0; i < $4; i++)); do
    "$tool" build "$1" -o "$work/tree.cairn" --method "$2" --threads "$3" --no-evaluate --json "$work/report.json" > /dev/null 2> "$work/errors" ||
      { cat "$work/errors" >&2; return 1; }
    echo "$(value build_cpu_s) $(value build_wall_s) $(value peak_rss_mb)" >> "$work/runs"
  done
  read -r cpu least most < <(sort -g "$work/runs" | awk '{ t[NR] = $1 } END { print t[int((NR + 1) / 2)], t[1], t[NR] }')
  read -r wall memory < <(sort -g -k 2 "$work/runs" | awk '{ t[NR] = $2; m = m > $3 ? m : $3 } END { print t[int((NR + 1) / 2)], m }')
  hash=$(value tree_sha256)
}

compare() {
  local mesh name method toolkit
  printf '%-14s %-12s %8s %15s %8s %6s %9s %7s  %s\n' mesh method 'CPU s' 'least-most' 'wall s' MB 'toolkit s' ratio tree
  for mesh in "${meshes[@]}"; do
    name=$(basename "${mesh%.*}")
    for method in ${methods//,/ }; do
      measure "$mesh" "$method" "$threads" "$runs" || { printf '%-14s %-12s failed\n' "$name" "$method"; continue; }
      toolkit=$(awk -F '\t' -v n="$name" -v m="$method" '$1 == n && $2 == m { print $3 }' "$here/toolkit_cpu.tsv")
      awk -v n="$name" -v m="$method" -v c="$cpu" -v l="$least" -v h="$most" -v w="$wall" -v r="$memory" -v t="$toolkit" -v s="$hash" 'BEGIN {
        printf "%-14s %-12s %8.2f %7.2f-%-7.2f %8.2f %6.0f %9s %7s  %s\n", n, m, c, l, h, w, r, t == "" ? "-" : t,
          t == "" ? "-" : sprintf("1/%.0f", t / c), substr(s, 1, 12) }'
    done
  done
}

grow() {
  local last='' lastCpu='' triangles file=$work/0.obj
  "$tool" simplify "$growth" --triangles 62500 -o "$file" > /dev/null
  printf '\n%-10s %8s %8s %6s %7s  %s\n' triangles 'CPU s' 'wall s' MB growth tree
  for triangles in 62500 250000 1000000; do
    if [[ -n $last ]]; then
      awk -f "$here/subdivide.awk" "$file" > "$work/next.obj"
      mv "$work/next.obj" "$file"
    fi
    measure "$file" combined 0 1
    awk -v n="$triangles" -v c="$cpu" -v w="$wall" -v r="$memory" -v s="$hash" -v l="$last" -v k="$lastCpu" 'BEGIN {
      printf "%-10d %8.2f %8.2f %6.0f %7s  %s\n", n, c, w, r, l == "" ? "-" : sprintf("n^%.2f", log(c / k) / log(n / l)), substr(s, 1, 12) }'
    last=$triangles lastCpu=$cpu
  done
}

((${#meshes[@]} == 0)) || compare
[[ -z $growth ]] || grow
