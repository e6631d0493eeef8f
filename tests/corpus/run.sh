#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds a tree from every file below the given folders and archives, and lists how each one ended. A file is tried as it
# is, then with --repair, then with --wrap, until one gives a certified tree. Every file should end as a tree or as a
# named error within the time; what does not is listed as TIMEOUT or CRASH. Ends with 1 after a crash, with --strict after
# a timeout too, and with 77 when a folder is missing.
set -euo pipefail

# Readers of third parties leak on broken files; what the tool itself leaks is found by its tests.
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0}

usage() {
  cat <<'END'
run.sh [OPTIONS] FOLDER|ARCHIVE.tar.gz... [-- BUILD OPTIONS]
  --tool PROGRAM   the cairn program (default build/release/bin/cairn)
  --seconds N      for each attempt (default 120)
  --memory KB      of address space for each attempt, or unlimited, which address sanitizers need (default 8388608)
  --modes LIST     of plain, repair and wrap, in order, separated by commas (default plain,repair,wrap)
  --smallest BYTES pass over files smaller than this
  --largest BYTES  pass over files larger than this
  --table FILE     also write the list there, separated by tabs: outcome, way, seconds, file, message
  --strict         a timeout is a failure too
Build options default to --no-evaluate.
END
}

tool=build/release/bin/cairn seconds=120 memory=8388608 modes=plain,repair,wrap smallest=0 largest='' table='' strict='' sources=()
build_options=(--no-evaluate)
while (($#)); do
  case $1 in
    --tool) tool=$2; shift 2 ;;
    --seconds) seconds=$2; shift 2 ;;
    --memory) memory=$2; shift 2 ;;
    --modes) modes=$2; shift 2 ;;
    --smallest) smallest=$2; shift 2 ;;
    --largest) largest=$2; shift 2 ;;
    --table) table=$2; shift 2 ;;
    --strict) strict=yes; shift ;;
    --) shift; build_options=("$@"); break ;;
    -h | --help) usage; exit 0 ;;
    -*) usage >&2; exit 2 ;;
    *) sources+=("$1"); shift ;;
  esac
done
((${#sources[@]})) || { usage >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
[[ -n $table ]] && : > "$table"

# Sets `outcome` and `message` for one attempt.
attempt() {
  local file=$1 way=$2 code=0 option=()
  [[ $way == plain ]] || option=("--$way")
  rm -f "$work/tree.cairn"
  # No mesh of these needs as much memory; a runaway must not take the machine with it. In the foreground, so that Ctrl-C
  # reaches the program too.
  (ulimit -v "$memory"; exec timeout --foreground -k 5 "$seconds" "$tool" build "$file" -o "$work/tree.cairn" \
    "${option[@]}" "${build_options[@]}") > "$work/out" 2> "$work/err" < /dev/null || code=$?
  message=$(grep -v ': left out ' "$work/err" | tail -n 1 | tr -cd '[:print:]' || true)
  case $code in
    0) if [[ -s $work/tree.cairn ]]; then outcome=tree message=''; else outcome=CRASH message='no tree was written'; fi ;;
    1) if [[ $message == 'cairn: '* && $message != *'unexpected failure'* ]]; then outcome=refused; else outcome=CRASH; fi ;;
    124 | 130 | 137) outcome=TIMEOUT message="not done after $seconds s" ;;
    *) outcome=CRASH message="exit code $code: $message" ;;
  esac
}

declare -A total=()
count() { total[$1]=$((${total[$1]:-0} + 1)); }

try_file() {
  local file=$1 name=$2 way start=$EPOCHREALTIME took
  for way in ${modes//,/ }; do
    attempt "$file" "$way"
    if [[ $message == *'is not the extension of a mesh format'* ]]; then count 'no mesh'; return; fi
    [[ $outcome == refused ]] || break
    # What cannot be read at all no repair can help.
    [[ $message == *' --wrap'* ]] || break
  done
  took=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
  count "$outcome, $way"
  printf '%-8s %-7s %7s s  %s%s\n' "$outcome" "$way" "$took" "$name" "${message:+  ($message)}"
  [[ -z $table ]] || printf '%s\t%s\t%s\t%s\t%s\n' "$outcome" "$way" "$took" "$name" "$message" >> "$table"
}

for source in "${sources[@]}"; do
  folder=$source
  if [[ -f $source ]]; then
    folder=$work/$(basename "$source").files
    mkdir "$folder"
    tar -xzf "$source" -C "$folder"
  fi
  [[ -d $folder ]] || { echo "run.sh: $source does not exist; install it or name another folder or archive" >&2; exit 77; }
  # Smallest first, so that a run cut short has seen the most files.
  while IFS=$'\t' read -r -d '' size file; do
    if ((size < smallest)); then count 'passed over as too small'; continue; fi
    if [[ -n $largest ]] && ((size > largest)); then count 'passed over as too large'; continue; fi
    try_file "$file" "${file#"$folder"/}"
  done < <(find "$folder" -type f -printf '%s\t%p\0' | sort -z -n)
done

echo
for key in "${!total[@]}"; do printf '%6d  %s\n' "${total[$key]}" "$key"; done | sort -k 2
[[ $(printf '%s\n' "${!total[@]}") != *CRASH* ]] || exit 1
[[ -z $strict || $(printf '%s\n' "${!total[@]}") != *TIMEOUT* ]] || exit 1
