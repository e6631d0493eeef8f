#!/usr/bin/env bash
# The project's commands. ./cairn.sh help lists them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

usage() {
  cat <<'END'
Cairn: collision detection that keeps its deadline.

  ./cairn.sh demo            build everything, make a sphere-tree of a real mesh, drop a hundred of them in Bullet,
                             print what a step costs with the tree and with GImpact, draw two pictures (out/demo/)
  ./cairn.sh test            what continuous integration runs: all tests in release, every third of those of the plugin with double
                             precision and under sanitizers, fuzzing, formatting, documents
  ./cairn.sh test whole      the same without leaving any out
  ./cairn.sh test fast       the release tests alone
  ./cairn.sh test sanitizers all of it but the demos under address and undefined-behaviour sanitizers, the builder too, which takes
                             most of the time
  ./cairn.sh build [PRESET]  configure and build one preset into build/PRESET (release, dev, asan, asan-plugin, double,
                             plugin, fuzz)
  ./cairn.sh bench           the heap of bunnies against Bullet's own shapes, as a table
  ./cairn.sh bench inside [MESH] [OPTIONS] queries per second of the inside tests on a mesh (default the bunny)
  ./cairn.sh bench traversal [TREE] [OPTIONS] sphere tests per second of whole traversals (default of generated trees),
                             beside the same blocks merely streamed, on every instruction set
  ./cairn.sh bench queries [TREE...] [OPTIONS] microseconds of rays and sweeps beside Bullet's mesh shapes (default of a
                             generated tree)
  ./cairn.sh bench still [OPTIONS] how flat and smooth bodies stand, slide and roll as sphere-trees, beside Bullet's own
                             shapes and the textbook
  ./cairn.sh bench matrix [OPTIONS] how sphere-trees rest, slide and roll with everything Bullet has, beside Bullet's own
                             shapes and the textbook
  ./cairn.sh scoreboard [--quick] [OPTIONS] what exact contacts gain and cost, contacts of meshes beside contacts of leaves in
                             one run, with what is asked of them (--help lists the options)
  ./cairn.sh bench fits FOLDER [OPTIONS] whether pieces that fit (meshes in FOLDER) go together, slide and hold as pieces do
  ./cairn.sh bench kernel TREE... [OPTIONS] what exact contacts of two bodies that touch cost, stage by stage
  ./cairn.sh bench textbook [OPTIONS] the textbook's experiments (falling, sliding, rolling, bouncing, colliding) with Bullet's own
                             shapes, hulls and trees of one to three levels: error and time of each
  ./cairn.sh bench laws [OPTIONS] the laws of rock-fall, measured over exact, from 10 kg to 100 t and from 1/60 to 1/1000 s
  ./cairn.sh bench effects [OPTIONS] what effects cost that are not listed, or listed with nothing to act on
  ./cairn.sh bench terrain [OPTIONS] rocks and rays on a terrain, beside Bullet's height field and mesh of the same points
  ./cairn.sh bench interrupted [TREE] what certified error traversals cut short are left with, in turn, worst first, in the best order there is
  ./cairn.sh bench covers MESH... [OPTIONS] what flat covers of 4 to 256 spheres prove and cost, objective by objective, beside a
                             tree's levels (--help lists the options)
  ./cairn.sh bench budgets [OPTIONS] what budgets of operations cost in accuracy and save in time, policy by policy, and what
                             several threads save, as tables and a figure (--help lists the options)
  ./cairn.sh bench volumes [MESH] [OPTIONS] spheres against spheres, capsules, slabs and boxes mixed, as nodes of a tree: volumes, error
                             and traversal time (default of rod, plate, beam, chair, ball, rock and the bunny; five minutes)
  ./cairn.sh bench worlds [OPTIONS] what thousands of bodies that lie still cost beside a hundred that move, time and bytes
  ./cairn.sh bench memory [TREE] bytes of a tree, its shapes, bodies and pairs, beside GImpact's (default a generated ball)
  ./cairn.sh bench moving [OPTIONS] what it costs a tree to follow a moving mesh, and how much wider its errors are than those of
                             a tree built anew
  ./cairn.sh bench builder [OPTIONS] [MESH...]
                             how long trees take to build, method by method, beside the thesis author's toolkit
                             (tests/bench/builder.sh --help lists the options)
  ./cairn.sh corpus [OPTIONS] try to build a tree of every mesh of Debian's test collections, list how each one ended
                             (tests/corpus/run.sh --help lists the options)
  ./cairn.sh tables [MESH...] build a tree of every mesh by every method and print fit and cost of each level, and the
                             thesis's tables 7.2 to 7.5 beside ours (tests/tables/run.sh --help lists the options)
  ./cairn.sh accuracy-cost [OPTIONS] the experiments of the thesis's chapter 7 again, as tables, figures and verdicts in out/accuracy-cost
                             (all of them, hours; --quick minutes; docs/accuracy.md)
  ./cairn.sh hard-cases [CASE...] [OPTIONS] the hard cases of builder and plugin as a table: criterion, measured, Bullet's best
                             own shape, verdict (--quick: seconds each; --list; --json FILE; --strict)
  ./cairn.sh report [--quick] [-o DIR]
                             all of this as one page to be sent to a sceptic, out/report/index.html: experiments, conclusions, figures,
                             tables and gallery, each with its command (hours, goes on where it was stopped; --quick: ten minutes)
  ./cairn.sh results [--quick] [--only SECTIONS]
                             measure and write docs/results.md, the page of all tables, section by section (--help, --list)
  ./cairn.sh figures heap|converge|showdown
                             print a table of the README as measured now, as Markdown (showdown: of kept runs, where code is the same)
  ./cairn.sh check-figures [PAGE...]
                             compare the tables between <!-- figures: COMMAND --> and <!-- /figures --> (default README.md)
                             with what their commands print
  ./cairn.sh fuzz [TARGET] [SECONDS] fuzz tree_file, case_file, narrow_phase, builder or mesh_import (default: one after the
                             other) under address and undefined-behaviour sanitizers (default 600 seconds each)
  ./cairn.sh coverage        what the tests of core and plugin reach of their lines and branches, file by file; fails below
                             95 % of the lines or 85 % of the branches
  ./cairn.sh threads         build Bullet from Debian's sources, thread-safe, and test the plugin with several threads under
                             ThreadSanitizer
  ./cairn.sh platforms [NAME...] build the library for WebAssembly, ARM64, Windows and Clang's library, run its tests there and
                             compare bits: one table (--help lists platforms and options; hours)
  ./cairn.sh docs            build the site of documents and public headers into out/docs; fails where a link leads nowhere,
                             a page is not in the navigation or a public symbol is not documented
  ./cairn.sh docs serve [PORT] build it and show it on http://localhost:8000 (or PORT) until Ctrl-C
  ./cairn.sh docs check [PAGE...] words, sentences and numbers of each page, and what breaks the limits
                             (tools/check_documents.py --help)
  ./cairn.sh wasm            build the npm package cairn-collision, core, plugin and Bullet as WebAssembly (out/wasm/cairn-collision)
  ./cairn.sh wasm test       the same, and test it under Node: bits of the native library, with and without vectors
  ./cairn.sh wasm ratio [TREE [BODIES [STEPS [ROUNDS]]]] time a heap natively and by the package, and print the ratio
  ./cairn.sh showdown [OPTIONS] Cairn, Rapier, Jolt and Havok on the same scenes in Node, judged by one exact check: tables and a
                             figure in out/showdown (--help lists the options; half an hour)
  ./cairn.sh web [--build | --test | --measure] [--port N]
                             build the page that compares Cairn with Rapier, Jolt and Havok in a browser (out/web/page, for any web
                             server) and show it on http://localhost:8080 until Ctrl-C; --build only builds it, --test opens it in
                             Chromium, --measure prints what 300 bodies cost there
  ./cairn.sh format          format the sources
  ./cairn.sh lint            check formatting, include arrows and the documents

Every command first installs what it needs from Debian's packages (cmake/packages-debian.txt); that needs root or sudo.
On other systems it prints the list and goes on.
END
}

say() { printf '\n== %s\n' "$*"; }

# Prints the names of the installed packages, and of what they provide: newer packages of Node.js, for one, provide npm.
installed_packages() {
  dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides}\n' |
    awk '$1 == "installed" { $1 = ""; gsub(/ \([^)]*\)|,/, ""); for (i = 1; i <= NF; ++i) print $i }'
}

# Prints the packages of the given folders that are not installed, one "package<TAB>why" a line.
missing_packages() {
  local room package why wanted installed
  installed=$(installed_packages)
  while read -r room package why; do
    [[ -z $room || $room == \#* ]] && continue
    for wanted in "$@"; do
      [[ $wanted == "$room" ]] || continue
      grep -qxF -- "$package" <<< "$installed" || printf '%s\t%s\n' "$package" "$why"
    done
  done < cmake/packages-debian.txt
}

as_root() {
  if [[ $(id -u) == 0 ]]; then "$@"; else sudo "$@"; fi
}

# Installs what the given folders need. Fails when something is missing and cannot be installed.
need() {
  if ! command -v apt-get > /dev/null || ! command -v dpkg-query > /dev/null; then
    [[ -n ${CAIRN_TOLD_PACKAGES:-} ]] && return 0
    export CAIRN_TOLD_PACKAGES=1
    say "This is not Debian: please see to these yourself (Debian's names)"
    grep -v '^#' cmake/packages-debian.txt
    return 0
  fi
  local missing
  missing=$(missing_packages "$@")
  [[ -z $missing ]] && return 0
  say "Installing what is missing"
  printf '%s\n' "$missing" | awk -F '\t' '{ printf "  %-24s %s\n", $1, $2 }'
  if [[ $(id -u) != 0 ]] && ! command -v sudo > /dev/null; then
    echo "cairn.sh: installing packages needs root or sudo; install the packages above and run this again." >&2
    return 1
  fi
  local names
  mapfile -t names < <(printf '%s\n' "$missing" | cut -f 1)
  as_root apt-get update -q > /dev/null
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${names[@]}" > /dev/null
}

everything=(build core plugin builder)

configure_and_build() {
  local preset=$1
  shift
  cmake --preset "$preset" > "/dev/null"
  cmake --build --preset "$preset" "$@"
}

build() {
  local preset=${1:-release}
  case $preset in
    plugin | double | asan-plugin | threads) need build core plugin tests ;;
    fuzz) need build core plugin builder tests fuzz ;;
    *) need "${everything[@]}" tests rockfall ;;
  esac
  say "Building $preset"
  configure_and_build "$preset"
}

# A mesh to show things with, in the folder $1: the bunny of Debian's libcgal-demo with as many triangles as a game would
# carry, or a generated rock when it cannot be had. Sets `mesh`.
fetch_mesh() {
  local archive=/usr/share/doc/libcgal-dev/data.tar.gz bin=build/release/bin
  need demo || echo "cairn.sh: going on without the demo's packages." >&2
  if [[ -r $archive ]] && tar -xzf "$archive" -O data/meshes/bunny00.off > "$1/bunny00.off" && [[ -s $1/bunny00.off ]]; then
    mesh=$1/bunny.obj
    "$bin/cairn" simplify "$1/bunny00.off" --triangles 1500 -o "$mesh"
  else
    say "No bunny: libcgal-demo could not be had. A generated rock stands in for it"
    mesh=$1/rock.obj
    "$bin/make_rock" --seed 1 -o "$mesh"
  fi
}

# The heap of the README, of the tree $1, into out/demo/heap.json.
heap_of_demo() {
  build/release/bin/frame_budget --scene heap --tree "$1" --bodies 100 --shape tree,tree+leaves,gimpact --json out/demo/heap.json "${@:2}"
}

demo() {
  need "${everything[@]}"
  local out=out/demo bin=build/release/bin mesh name
  mkdir -p "$out"
  say "Building"
  # Tests need more packages: a build that has them keeps them, a new one does without.
  local tests=OFF
  grep -qs '^CAIRN_TESTS:BOOL=ON' build/release/CMakeCache.txt && tests=ON
  cmake --preset release -DCAIRN_TESTS=$tests > /dev/null
  cmake --build --preset release --target cairn frame_budget make_rock tree_picture
  fetch_mesh "$out"
  name=$(basename "${mesh%.*}")
  say "A certified sphere-tree of $mesh"
  "$bin/cairn" build "$mesh" -o "$out/$name.cairn" --json "$out/$name.json"
  say "A hundred of them in Bullet, with the tree, with contacts at its leaves and with GImpact"
  heap_of_demo "$out/$name.cairn" --csv "$out/heap.csv" --picture "$out/heap.png"
  say "The tree's levels"
  "$bin/tree_picture" "$out/$name.cairn" -o "$out/levels.png"
  say "The README's table, as measured now"
  python3 demos/report/figures.py heap "$out/heap.json"
  say "Done in $SECONDS s: look at $out/levels.png and $out/heap.png; figures in $out/heap.json, per step in $out/heap.csv"
}

run_tests() {
  local preset=$1
  shift
  build "$preset"
  say "Testing $preset"
  ctest --preset "$preset" -j "$(nproc)" "$@"
}

test_all() {
  [[ ${1:-} == sanitizers ]] && { run_tests asan; return; }
  need "${everything[@]}" tests fuzz lint docs
  lint
  docs_site
  run_tests release
  [[ ${1:-} == fast ]] && { say "All fast tests passed in $SECONDS s"; return; }
  # Release has run them all. Rounding and memory are looked at in every third test; `whole` runs the rest too.
  local every=(-I "1,,3")
  [[ ${1:-} == whole ]] && every=()
  run_tests double "${every[@]}"
  run_tests asan-plugin "${every[@]}"
  build fuzz
  say "Fuzzing tree files, case files and the narrow phase for a short while"
  ctest --test-dir build/fuzz -R '^fuzz.(tree_file|case_file|narrow_phase)$' --output-on-failure
  say "All tests passed in $SECONDS s"
}

bench_builder() {
  need "${everything[@]}"
  configure_and_build release --target cairn
  local mesh
  if (($# == 0)); then
    mkdir -p out/bench
    fetch_mesh out/bench
    set -- "$mesh"
  fi
  tests/bench/builder.sh "$@"
}

bench_volumes() {
  local mesh
  need "${everything[@]}" tests
  configure_and_build release --target cairn make_rock volumes_bench > /dev/null
  if (($# == 0)) || [[ $1 == -* ]]; then
    mkdir -p out/bench
    fetch_mesh out/bench > /dev/null
    set -- "$mesh" "$@"
  fi
  build/release/bin/volumes_bench "$@"
}

bench_covers() {
  case " $* " in *' --help '* | *' -h '*) python3 tests/bench/covers.py --help; return ;; esac
  need "${everything[@]}"
  configure_and_build release --target cairn > /dev/null
  python3 tests/bench/covers.py "$@"
}

bench_budgets() {
  case " $* " in *' --help '* | *' -h '*) python3 tests/bench/budgets/run.py --help; return ;; esac
  need "${everything[@]}" accuracy
  configure_and_build release --target cairn frame_budget make_rock > /dev/null
  local mesh
  mkdir -p out/bench
  fetch_mesh out/bench > /dev/null
  case " $* " in *' --tree '* | *' --mesh '*) ;; *) set -- --mesh "$mesh" "$@" ;; esac
  python3 tests/bench/budgets/run.py "$@"
}

# A micro-benchmark by its name, with its options.
bench_program() {
  need "${everything[@]}" tests
  configure_and_build release --target "$1_bench"
  "build/release/bin/$1_bench" "${@:2}"
}

bench() {
  case ${1:-} in
    builder) bench_builder "${@:2}"; return ;;
    queries) bench_program query "${@:2}"; return ;;
    budgets) bench_budgets "${@:2}"; return ;;
    covers) bench_covers "${@:2}"; return ;;
    volumes) bench_volumes "${@:2}"; return ;;
    effects | fits | interrupted | kernel | laws | matrix | memory | moving | still | terrain | textbook | traversal | worlds) bench_program "$@"; return ;;
  esac
  build release
  local mesh
  mkdir -p out/bench
  if [[ ${1:-} == inside ]]; then
    shift
    (($#)) || { fetch_mesh out/bench; set -- "$mesh"; }
    build/release/bin/inside_bench "$@"
    return
  fi
  fetch_mesh out/bench
  build/release/bin/frame_budget --scene heap --mesh "$mesh" --bodies 100 --shape tree,hull,spheres,gimpact \
    --json out/bench/heap.json
}

corpus() {
  need "${everything[@]}" corpus
  configure_and_build release --target cairn
  tests/corpus/run.sh /usr/share/doc/libcgal-dev/data.tar.gz /usr/share/assimp/models "$@"
}

tables() {
  need "${everything[@]}" tables
  configure_and_build release --target cairn accuracy_cost > /dev/null
  tests/tables/run.sh "$@"
}

# With an experiment's name or a command first, that; else all.
accuracy_cost() {
  need "${everything[@]}" accuracy
  configure_and_build release --target accuracy_cost > /dev/null
  case ${1:-} in
    list | models | run) build/release/bin/accuracy_cost "$@" ;;
    '' | -*) build/release/bin/accuracy_cost run all -o out/accuracy-cost "$@" ;;
    *) build/release/bin/accuracy_cost run "$1" -o out/accuracy-cost "${@:2}" ;;
  esac
}

hard_cases() {
  need "${everything[@]}" tests
  configure_and_build release --target hard_cases > /dev/null
  build/release/bin/hard_cases "$@"
}

scoreboard() {
  case " $* " in *' --help '* | *' -h '*) python3 tests/scoreboard/run.py --help; return ;; esac
  need "${everything[@]}" tests
  configure_and_build release --target cairn frame_budget fits_bench hard_cases make_rock > /dev/null
  local mesh
  mkdir -p out/scoreboard
  fetch_mesh out/scoreboard > /dev/null
  python3 tests/scoreboard/run.py --mesh "$mesh" "$@"
}

# What is left out of the page is said on it, so a missing optional package is no reason to stop.
report() {
  local programs=(cairn accuracy_cost frame_budget sphere_set_picture textbook_bench tree_picture)
  case " $* " in *' --help '* | *' -h '*) python3 demos/report/measure.py --help; return ;; esac
  need "${everything[@]}" accuracy demo report tests
  [[ -d tests/hard_cases ]] && programs+=(hard_cases)
  say "Building"
  configure_and_build release --target "${programs[@]}" > /dev/null
  local python=python3
  # Debian's package is of Debian's Python, whatever stands before it in the path.
  "$python" -c 'import jinja2' 2> /dev/null || python=/usr/bin/python3
  "$python" demos/report/measure.py "$@"
}

results() {
  case " $* " in *' --help '* | *' -h '*) python3 demos/report/results.py --help; return ;; esac
  need "${everything[@]}" accuracy demo tables tests
  say "Building"
  configure_and_build release --target cairn accuracy_cost frame_budget hard_cases laws_bench textbook_bench > /dev/null
  python3 demos/report/results.py "$@"
}

# A table of the README. Only the table goes to standard output.
figures() {
  local mesh name out=out/demo
  case ${1:-} in
    heap | converge) ;;
    showdown)
      showdown_parts >&2
      node demos/showdown/showdown.mjs --bunny "$mesh" --quote --resume
      return
      ;;
    *) echo "cairn.sh: figures prints heap, converge or showdown; name one of them." >&2; return 2 ;;
  esac
  {
    need "${everything[@]}" demo
    configure_and_build release --target cairn frame_budget make_rock
    mkdir -p "$out"
    fetch_mesh "$out"
    name=$out/$(basename "${mesh%.*}").cairn
    build/release/bin/cairn build "$mesh" -o "$name"
    if [[ $1 == heap ]]; then
      heap_of_demo "$name"
    else
      build/release/bin/frame_budget --scene converge --tree "$name" --shape tree,tree+leaves,gimpact,fcl --runs 3 --json "$out/converge.json"
    fi
  } >&2
  python3 demos/report/figures.py "$1" "$out/$1.json"
}

fuzz() {
  local targets=(tree_file case_file narrow_phase builder mesh_import) target
  local -A longest=([tree_file]=65536 [case_file]=32768 [narrow_phase]=512 [builder]=64 [mesh_import]=4096)
  if [[ -n ${1:-} && -n ${longest[$1]:-} ]]; then
    targets=("$1")
    shift
  fi
  need build core plugin builder tests fuzz
  for target in "${targets[@]}"; do
    say "Building and fuzzing $target"
    configure_and_build fuzz --target "${target}_fuzz"
    mkdir -p "out/fuzz/$target"
    local corpus=("out/fuzz/$target")
    [[ -d tests/data/fuzz/$target ]] && corpus+=("tests/data/fuzz/$target")
    [[ $target == case_file ]] && corpus+=(demos/rockfall/examples)
    "build/fuzz/bin/${target}_fuzz" -max_total_time="${1:-600}" -max_len="${longest[$target]}" -timeout=300 \
      -artifact_prefix="out/fuzz/$target-" "${corpus[@]}"
  done
}

threads() {
  need build core plugin tests
  say "Building Bullet thread-safe and the plugin, under ThreadSanitizer"
  configure_and_build threads
  say "Testing threads"
  TSAN_OPTIONS="suppressions=$PWD/tests/plugin/threads/bullet.supp" ctest --preset threads "$@"
}

# The packages of each platform are a group of their own.
platforms() {
  case " $* " in *' --help '* | *' -h '*) python3 tests/platforms/run.py --help; return ;; esac
  local groups
  groups=$(python3 tests/platforms/run.py --packages "$@") || return
  # shellcheck disable=SC2086  # words
  need build core plugin tests platforms $groups
  python3 tests/platforms/run.py "$@"
}

sources() { git ls-files -co --exclude-standard -- '*.h' '*.cpp'; }

# GCC counts a branch for every call that may throw; those are left out, as nothing here throws.
coverage() {
  need build core plugin tests coverage
  say "Building core and plugin with counters"
  configure_and_build coverage
  find build/coverage -name '*.gcda' -delete
  say "Testing"
  ctest --preset coverage -j "$(nproc)" -E '^consumer$'
  mkdir -p out/coverage
  gcovr --root . --object-directory build/coverage --filter core/ --filter plugin/ --exclude-throw-branches \
    --exclude-unreachable-branches --html-self-contained --html-details out/coverage/index.html --txt out/coverage/lines.txt \
    --json-summary-pretty --json-summary out/coverage/summary.json --print-summary --fail-under-line 95 --fail-under-branch 85
  say "Lines that no test reaches"
  grep -E '[0-9]%' out/coverage/lines.txt | grep -v '100%' || true
  echo "Line by line: out/coverage/index.html"
}

# The site. All of it is built and checked before this fails, so that it can be looked at all the same.
docs_site() {
  need docs
  local site=out/docs log=out/docs.log failed=0
  mkdir -p out
  say "Building the site"
  mkdocs build --strict --site-dir "$site" > "$log" 2>&1 || failed=1
  sed 's/\x1b\[[0-9;]*m//g' "$log" | grep -E 'WARNING|ERROR|Error|Aborted' || true
  say "Building the pages of the public headers"
  doxygen tools/site/Doxyfile || failed=1
  say "Following the site's links"
  tools/site/check_site.py "$site" || failed=1
  if ((failed)); then
    echo "cairn.sh: the site has faults, listed above; $site/index.html shows it as it is." >&2
    return 1
  fi
  say "Done: $site/index.html"
}

docs() {
  case ${1:-} in
    '') docs_site ;;
    check) tools/check_documents.py --strict "${@:2}" ;;
    serve)
      docs_site || true
      say "http://localhost:${2:-8000} (Ctrl-C ends it)"
      python3 -m http.server --bind 127.0.0.1 --directory out/docs "${2:-8000}"
      ;;
    *)
      echo "cairn.sh: docs knows 'serve' and 'check', not '$1'." >&2
      return 2
      ;;
  esac
}

# The npm package. Trees of the golden heap, for its tests, are written by the program whose heap they test.
wasm_package() {
  local package=out/wasm/cairn-collision
  need build core plugin wasm platforms
  say "Building WebAssembly, with and without vectors"
  configure_and_build wasm-plain --target cairn_module
  configure_and_build wasm --target cairn_module "$@"
  rm -rf "$package"
  mkdir -p "$package"
  cp wasm/js/* wasm/LICENSE build/wasm/bin/cairn.wasm "$package"
  cp build/wasm-plain/bin/cairn.wasm "$package/cairn-plain.wasm"
  say "The package is in $package"
}

wasm() {
  case ${1:-} in
    '') wasm_package ;;
    test)
      wasm_package golden_hash
      mkdir -p out/wasm/golden
      node --no-experimental-fetch build/wasm/bin/golden_hash.js --trees out/wasm/golden/round.cairn out/wasm/golden/square.cairn
      say "Testing the package"
      node --test tests/wasm/*.test.mjs
      ;;
    ratio)
      need "${everything[@]}"
      wasm_package
      configure_and_build release --target heap_time > /dev/null
      shift
      (($#)) || set -- tests/data/rock.cairn
      node wasm/ratio/ratio.mjs build/release/bin/heap_time out/wasm/cairn-collision "$@"
      ;;
    *)
      echo "cairn.sh: wasm knows 'test' and 'ratio', not '$1'." >&2
      return 2
      ;;
  esac
}

# What the comparison needs: package, programs, engines, and the bunny, whose name is in `mesh`.
showdown_parts() {
  need "${everything[@]}" web
  wasm_package
  configure_and_build release --target cairn make_rock showdown_judge
  mkdir -p out/showdown
  fetch_mesh out/showdown
  node_packages demos/engines
  ln -sfn "$PWD/out/wasm/cairn-collision" demos/engines/node_modules/cairn-collision
}

showdown() {
  local mesh
  case " $* " in *' --help '*) node demos/showdown/showdown.mjs --help; return ;; esac
  showdown_parts >&2
  node demos/showdown/showdown.mjs --bunny "$mesh" --json out/showdown/showdown.json --figure out/showdown/showdown.svg "$@"
}

# Packages of a folder as its package-lock.json pins them by checksum; their scripts are not run.
node_packages() {
  [[ $1/node_modules/.package-lock.json -nt $1/package-lock.json ]] && return
  (cd "$1" && npm ci --ignore-scripts --no-audit --no-fund --prefer-offline)
}

# Rocks down a slope, for the page's replay.
web_rocks() {
  [[ -s $1 ]] && return
  local bin=build/release/bin out=out/web/rocks
  "$bin/rockfall" run demos/rockfall/examples/stepped_slope.json --runs 0:1 -o "$out/runs"
  "$bin/rockfall" merge "$out/runs" -o "$out/merged" > /dev/null
  cp "$out/merged/trajectories.vtk" "$1"
}

build_web() {
  local models=out/web/public/models tests=OFF mesh
  mkdir -p "$models"
  say "Building the programs that make the models"
  grep -qs '^CAIRN_TESTS:BOOL=ON' build/release/CMakeCache.txt && tests=ON
  cmake --preset release -DCAIRN_TESTS=$tests > /dev/null
  cmake --build --preset release --target cairn make_rock rockfall
  [[ -n ${CAIRN_PACKAGE:-} ]] || wasm
  say "Fetching packages"
  node_packages demos/engines
  node_packages demos/web
  say "Making models: meshes, sphere-trees, convex parts for the others"
  fetch_mesh out/web
  web_rocks "$models/rocks.vtk"
  node demos/web/build_models.mjs build/release/bin/cairn "$models" "$mesh"
  say "Building the page"
  (cd demos/web && npx vite build --logLevel warn)
  node demos/web/page_size.mjs out/web/page
}

web() {
  local what=serve port=8080
  while (($#)); do
    case $1 in
      --build | --test | --measure) what=${1#--} ;;
      --port) port=${2:?a port is missing after --port}; shift ;;
      *) echo "cairn.sh: web knows --build, --test, --measure and --port N, not '$1'." >&2; return 2 ;;
    esac
    shift
  done
  need "${everything[@]}" web
  build_web
  case $what in
    build) say "Built in $SECONDS s: serve out/web/page with any web server" ;;
    test)
      node --test tests/engines/engines_test.mjs tests/engines/mass_test.mjs tests/web/files_test.mjs
      node tests/web/page_test.mjs out/web/page demos/web out/web/pictures
      ;;
    measure) node tests/web/measure.mjs out/web/page demos/web ;;
    serve)
      say "http://localhost:$port (Ctrl-C ends it)"
      (cd demos/web && npx vite preview --port "$port" --strictPort)
      ;;
  esac
}

format() {
  need lint
  sources | xargs clang-format -i
}

lint() {
  need build lint
  say "Checking formatting and include arrows"
  sources | xargs clang-format --dry-run --Werror
  cmake -DROOT="$PWD" -P cmake/CheckArrows.cmake
  say "Checking the documents"
  tools/check_documents.py --strict > /dev/null
}

command=${1:-help}
shift || true
case $command in
  demo) demo "$@" ;;
  test) test_all "$@" ;;
  build) build "$@" ;;
  bench) bench "$@" ;;
  corpus) corpus "$@" ;;
  tables) tables "$@" ;;
  accuracy-cost) accuracy_cost "$@" ;;
  hard-cases) hard_cases "$@" ;;
  report) report "$@" ;;
  scoreboard) scoreboard "$@" ;;
  results) results "$@" ;;
  figures) figures "$@" ;;
  check-figures) python3 tests/figures/check.py "$@" ;;
  fuzz) fuzz "$@" ;;
  coverage) coverage "$@" ;;
  docs) docs "$@" ;;
  threads) threads "$@" ;;
  platforms) platforms "$@" ;;
  wasm) wasm "$@" ;;
  showdown) showdown "$@" ;;
  web) web "$@" ;;
  format) format "$@" ;;
  lint) lint "$@" ;;
  help | -h | --help) usage ;;
  *)
    echo "cairn.sh: unknown command '$command'; './cairn.sh help' lists the commands." >&2
    exit 2
    ;;
esac
