#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What exact contacts gain and cost: one table, contacts of meshes beside contacts of leaves, measured in one run."""
import argparse
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "demos/report"))
import machine  # noqa: E402
BIN = ROOT / "build/release/bin"
SHAPES = {"tree": "meshes", "tree+leaves": "leaves"}
# How many bodies make a heap of each model.
BODIES = {"bunny": 100, "dragon": 30, "torus": 60, "cylinder": 60, "cube": 100, "block": 100, "s-shape": 60}
FALL, REST = slice(40, 160), slice(-100, None)  # steps


def fail(text):
    sys.exit(f"scoreboard: {text}")


def run(command):
    """Runs a program of ours; what it printed. Ends with its message where it fails."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{pathlib.Path(command[0]).name} failed: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def progress(text):
    print(f"  {text} ...", file=sys.stderr, flush=True)


class Table:
    """Rows of what is asked, what leaves give, what meshes give."""

    def __init__(self):
        self.rows = []

    def add(self, what, asked, leaves, meshes, holds=None):
        self.rows.append({"what": what, "asked": asked, "leaves": leaves, "meshes": meshes, "holds": holds})
        verdict = {True: "holds", False: "MISSES", None: ""}[holds]
        print(f"| {what} | {asked} | {leaves} | {meshes} | {verdict} |", flush=True)


def heap(tree, bodies, shape, seed, folder, *options):
    figures, steps = folder / "heap.json", folder / "heap.csv"
    run([BIN / "frame_budget", "--scene", "heap", "--tree", tree, "--bodies", bodies, "--shape", shape, "--seed", seed,
         "--json", figures, "--csv", steps, *options])
    result = json.loads(figures.read_text())
    with steps.open() as file:
        times = [float(row["narrow_phase_cpu_us"]) / 1e3 for row in csv.DictReader(file)]
    return result, times


def measure_heap(table, name, tree, seeds, folder):
    """A heap that may sleep tells how it lies, one kept awake what a step costs."""
    found = {}
    for shape in SHAPES:
        progress(f"heap of {name}, {SHAPES[shape]}")
        still = [heap(tree, BODIES[name], shape, seed, folder)[0] for seed in seeds]
        times = [heap(tree, BODIES[name], shape, seed, folder, "--no-sleeping")[1] for seed in seeds]
        found[shape] = {
            "deep": 100 * statistics.mean(r["penetration_end_fraction"]["mean"] for r in still),
            "deepest": 100 * max(r["penetration_end_fraction"]["max"] for r in still),
            "gap": 100 * statistics.mean(r["gap_end_fraction"]["mean"] for r in still),
            "asleep": sum(r["bodies_asleep"] == BODIES[name] for r in still),
            "fall": statistics.median(statistics.median(t[FALL]) for t in times),
            "rest": statistics.median(statistics.median(t[REST]) for t in times),
        }
    leaves, meshes = found["tree+leaves"], found["tree"]
    title = f"{BODIES[name]} of {name}, {len(seeds)} seeds"
    table.add(f"{title}: penetration mean / max, %", ".1 / 1", f"{leaves['deep']:.2f} / {leaves['deepest']:.2f}",
              f"{meshes['deep']:.2f} / {meshes['deepest']:.2f}", meshes["deep"] <= .1 and meshes["deepest"] <= 1)
    table.add(f"{title}: mean gap, %", ".02", f"{leaves['gap']:.3f}", f"{meshes['gap']:.3f}", meshes["gap"] <= .02)
    table.add(f"{title}: heaps asleep after 10 s", "all", leaves["asleep"], meshes["asleep"],
              meshes["asleep"] == len(seeds))
    table.add(f"{title}: ms a step in the fall", "1.25 x leaves", f"{leaves['fall']:.2f}",
              f"{meshes['fall']:.2f} ({meshes['fall'] / leaves['fall']:.2f} x)",
              meshes["fall"] <= 1.25 * leaves["fall"])
    table.add(f"{title}: ms a step at rest, kept awake", ".25 x leaves", f"{leaves['rest']:.2f}",
              f"{meshes['rest']:.2f} ({meshes['rest'] / leaves['rest']:.2f} x)", meshes["rest"] <= .25 * leaves["rest"])


def measure_fits(table, pieces):
    progress("pieces that fit")
    lines = run([BIN / "fits_bench", pieces]).splitlines()
    found = {}
    for line in lines:
        name, rest = line[:18].strip(), line[18:].split(maxsplit=2)
        found.setdefault(name, {})[rest[0]] = (rest[1] == "holds", rest[2])
    for name, shapes in found.items():
        table.add(name, "holds", shapes["tree+leaves"][1], shapes["tree"][1], shapes["tree"][0])


def measure_converge(table, tree, folder, runs):
    progress("bodies that fly to one point")
    figures = folder / "converge.json"
    run([BIN / "frame_budget", "--scene", "converge", "--tree", tree, "--runs", runs, "--shape",
         "tree,tree+leaves,gimpact,fcl", "--json", figures])
    found = {r["shape"]: r for r in json.loads(figures.read_text())}

    def time(shape, which):
        return found[shape]["narrow_phase_cpu_us"][which] / 1e3

    def times(shape):
        return f"{time(shape, 'median'):.2f} / {time(shape, 'p99'):.2f}"

    leaves, meshes = found["tree+leaves"], found["tree"]
    error = [100 * r["contact_error_fraction"]["mean"] for r in (leaves, meshes)]
    table.add("converge: contact error, %", ".1", f"{error[0]:.2f}", f"{error[1]:.2f}", error[1] <= .1)
    table.add("converge: contacts missed", 0, leaves["missed_pairs"], meshes["missed_pairs"],
              meshes["missed_pairs"] == 0)
    table.add("converge: ms median / 99 %", "1.5 x leaves", times("tree+leaves"), times("tree"),
              time("tree", "p99") <= 1.5 * time("tree+leaves", "p99"))
    ratio = min(time("fcl", which) / time("tree", which) for which in ("median", "p99"))
    table.add("converge: FCL takes", "8 x", f"{times('fcl')} ms", f"{ratio:.1f} x", ratio >= 8)


def measure_hard_cases(table, folder):
    progress("hard cases, as the tests run them")
    figures = folder / "hard.json"
    run([BIN / "hard_cases", "--quick", "--json", figures])
    cases = json.loads(figures.read_text())
    cases = cases["cases"] if isinstance(cases, dict) else cases
    holds = sum(case["verdict"] == "holds" for case in cases)
    table.add(f"hard cases that hold, of {len(cases)} (--quick)", 33, "-", holds, holds >= 33)


def measure_source(table):
    plugin = ROOT / "plugin"
    files = [f for f in plugin.rglob("*") if f.suffix in (".h", ".cpp") and not {"effects", "soft"} & set(f.parts)]
    lines = sum(len(f.read_text().splitlines()) for f in files)
    table.add("lines of the plugin without effects and soft bodies", 11000, "-", lines, lines <= 11000)
    tuning = (plugin / "kernel/contact_tuning.h").read_text()
    constants = tuning.count("inline constexpr")
    table.add("numbers that decide exact contacts", 25, "-", constants, constants <= 25)


def arguments():
    parser = argparse.ArgumentParser(
        prog="./cairn.sh scoreboard", description=__doc__,
        epilog="Examples: ./cairn.sh scoreboard --quick; ./cairn.sh scoreboard --models DIR --pieces DIR --seeds 8")
    parser.add_argument("--mesh", type=pathlib.Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--models", type=pathlib.Path,
                        help=f"folder of meshes to heap up besides the bunny: {', '.join(BODIES)}, each as .obj")
    parser.add_argument("--pieces", type=pathlib.Path, help="folder of the pieces that fit: see bench fits")
    parser.add_argument("--seeds", type=int, default=3, help="heaps of each kind (default 3)")
    parser.add_argument("--quick", action="store_true", help="one seed, no hard cases: about a minute")
    parser.add_argument("--json", type=pathlib.Path, help="write the table to this file")
    given = parser.parse_args()
    if given.seeds < 1:
        fail("--seeds: at least one heap of each kind is needed.")
    for folder in (given.models, given.pieces):
        if folder and not folder.is_dir():
            fail(f"{folder} is no folder: give one that holds meshes.")
    return given


def main():
    given = arguments()
    seeds = [1] if given.quick else list(range(1, given.seeds + 1))
    table = Table()
    described = machine.describe(ROOT, BIN.parent)
    print(*(f"{key}: {value}" for key, value in described.items() if value), sep="\n")
    print(f"seeds: {seeds[0]} to {seeds[-1]}\n\n| what | asked | leaves | meshes | |\n| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        meshes = {"bunny": given.mesh}
        if given.models:
            meshes |= {n: given.models / f"{n}.obj" for n in BODIES if (given.models / f"{n}.obj").is_file()}
        if given.pieces:
            measure_fits(table, given.pieces)
        for mesh_name, mesh in meshes.items():
            progress(f"tree of {mesh_name}")
            tree = folder / f"{mesh_name}.cairn"
            run([BIN / "cairn", "build", mesh, "-o", tree])
            measure_heap(table, mesh_name, tree, seeds, folder)
        measure_converge(table, folder / "bunny.cairn", folder, 1 if given.quick else 3)
        if not given.quick:
            measure_hard_cases(table, folder)
        measure_source(table)
    if given.json:
        given.json.write_text(json.dumps(table.rows, indent=1) + "\n")
    judged = [row["holds"] for row in table.rows if row["holds"] is not None]
    print(f"\n{sum(judged)} of {len(judged)} hold.")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        fail("stopped: the lines above are whole.")
