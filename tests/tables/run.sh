#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds a tree of every mesh by every method the tool has, and prints how well each level fits beside what it cost; then
# the ratios of the thesis's tables 7.2 to 7.5 beside its own. A run stopped by Ctrl-C goes on where it was: a build is
# done again only when the tool, the mesh or an option changed. Ends with 1 when a build failed, with 130 when cancelled.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")

usage() {
  cat <<'END'
run.sh [OPTIONS] [MESH...] [-- BUILD OPTIONS]
  --tool PROGRAM   the cairn program (default build/release/bin/cairn)
  --methods LIST   separated by commas (default: all of `cairn build --help`)
  --threads N      of each build (default 1, so that CPU seconds mean one core)
  --seconds N      for each build and its evaluation (default 1200)
  --out FOLDER     where the finished builds' reports are kept (default out/tables)
  --json FILE      write everything there too; - is standard output, instead of the tables
  --csv FILE       write one line per mesh, method and level there too
  --markdown FILE  write the tables as Markdown there too, as on docs/results.md
Meshes named bunny, dragon, s-shape and ellipsoid are compared with the thesis's tables. Without any, stand-ins for the
thesis's five models are made by accuracy_cost, which stands beside the tool, of Debian's libcgal-demo (--archive FILE,
its data.tar.gz).
END
}

tool=build/release/bin/cairn methods='' threads=1 seconds=1200 out=out/tables archive=/usr/share/doc/libcgal-dev/data.tar.gz json='' csv='' markdown='' meshes=() build_options=()
while (($#)); do
  case $1 in
    --tool | --methods | --threads | --seconds | --out | --archive | --json | --csv | --markdown)
      (($# > 1)) || { usage >&2; exit 2; }
      declare "${1#--}=$2"; shift 2 ;;
    --) shift; build_options=("$@"); break ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 2 ;;
    *) meshes+=("$1"); shift ;;
  esac
done
if ((${#meshes[@]} == 0)); then
  for name in bunny dragon cow s-shape ellipsoid; do
    if mesh=$("$(dirname "$tool")/accuracy_cost" models "$name" --archive "$archive" -o "$out/meshes"); then
      meshes+=("$mesh")
    else
      echo "run.sh: going on without $name" >&2
    fi
  done
fi
for mesh in "${meshes[@]}"; do
  [[ -r $mesh ]] || { echo "run.sh: $mesh cannot be read; name a mesh" >&2; exit 2; }
done

twice=$(printf "%s\n" "${meshes[@]}" | sed "s,.*/,,; s,\.[^.]*$,," | sort | uniq -d | head -n 1)
[[ -z $twice ]] || { echo "run.sh: two meshes are called $twice; rename one" >&2; exit 2; }

if [[ -z $methods ]]; then
  methods=$("$tool" build --help | sed -n 's/^ *--method [A-Z]*:{\([^}]*\)}.*/\1/p')
  [[ -n $methods ]] || { echo "run.sh: $tool build --help names no methods; give them with --methods" >&2; exit 1; }
fi
IFS=, read -r -a methods <<< "$methods"
mkdir -p "$out"
report=$(mktemp)
trap 'rm -f "$report" "$report".*' EXIT

# Name of a finished build's report: everything its figures depend on is in it.
record_of() {
  local stamp
  stamp=$(sha256sum <<< "$tool_sum $mesh_sum $threads ${build_options[*]}" | cut -c 1-16)
  printf '%s/%s.%s.%s.json' "$out" "$name" "$method" "$stamp"
}

build_one() {
  local record=$1 code=0
  # In the foreground, so that Ctrl-C reaches the tool.
  timeout --foreground -k 5 "$seconds" "$tool" build "$mesh" -o "$report.tree" --method "$method" --threads "$threads" \
    --json "$report.new" "${build_options[@]}" > /dev/null 2> "$report.err" < /dev/null || code=$?
  case $code in
    0)
      # One finished report per build, moved in whole.
      jq --arg model "$name" '{model: $model} + .' "$report.new" > "$record.part" && mv "$record.part" "$record" ;;
    130) echo "run.sh: cancelled; run it again to go on" >&2; exit 130 ;;
    124 | 137) failures+=("$name, $method: not done after $seconds s") ;;
    *) failures+=("$name, $method: $(tail -n 1 "$report.err")") ;;
  esac
}
trap 'echo "run.sh: cancelled; run it again to go on" >&2; exit 130' INT TERM

tool_sum=$(sha256sum < "$tool") failures=() records=() done_count=0 all=$((${#meshes[@]} * ${#methods[@]}))
for mesh in "${meshes[@]}"; do
  name=$(basename "${mesh%.*}") mesh_sum=$(sha256sum < "$mesh")
  for method in "${methods[@]}"; do
    done_count=$((done_count + 1))
    record=$(record_of)
    if [[ ! -s $record ]]; then
      printf '[%d/%d] %s, %s; %d s so far\n' "$done_count" "$all" "$name" "$method" "$SECONDS" >&2
      build_one "$record"
    fi
    [[ ! -s $record ]] || records+=("$record")
  done
done

((${#records[@]} == 0)) || cat "${records[@]}" > "$report"
jq -s --rawfile thesis "$here/thesis.tsv" -f "$here/tables.jq" "$report" > "$report.json"
[[ -z $csv ]] || jq -r -f "$here/csv.jq" "$report.json" > "$csv"
[[ -z $markdown ]] || jq -r -f "$here/markdown.jq" "$report.json" > "$markdown"
if [[ $json == - ]]; then
  cat "$report.json"
else
  [[ -z $json ]] || cp "$report.json" "$json"
  jq -r -f "$here/text.jq" "$report.json"
fi
((${#failures[@]} == 0)) || { printf 'run.sh: failed: %s\n' "${failures[@]}" >&2; exit 1; }
