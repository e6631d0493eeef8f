#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a budget of operations costs in accuracy and saves in time, as tables and one figure."""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

OPERATIONS = ["2000", "4000", "8000", "16000", "32000", "none"]
POLICIES = ["guard", "repel", "ignore", "compensate"]
PROGRAM = "build/release/bin/frame_budget"

FIGURE = """
set terminal svg size 900,340 font 'sans,12' background '#ffffff'
set output '{figure}'
set datafile separator ' '
set multiplot layout 1,2
set logscale xy
set grid
set xlabel 'operations a step'
set title 'Twenty flying bodies: error of a contact, % of size'
plot '{flying}' using 1:2 with linespoints lw 2 pt 7 title 'guard (default)', '' using 1:3 with linespoints lw 2 pt 6 title 'repel'
set title 'A hundred bodies in a pit: narrow phase, ms (99 %)'
plot '{heap}' using 1:2 with linespoints lw 2 pt 7 title 'with a budget', '' using 1:3 with lines lw 2 dt 2 title 'without'
unset multiplot
"""


def measured(arguments):
    """The lines of a sweep, as frame_budget writes them."""
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "sweep.csv")
        subprocess.run([PROGRAM, *arguments, "--csv", table], check=True, stdout=subprocess.DEVNULL)
        with open(table, newline="") as file:
            return list(csv.DictReader(file))


def number(line, key, factor=1.0):
    return factor * float(line[key] or 0)


def flying(tree, runs):
    lines = measured([*tree, "--scene", "converge", "--runs", str(runs), "--budget-ops", ",".join(OPERATIONS),
                      "--unresolved", ",".join(POLICIES)])
    print("\nTwenty bodies that fly to one point, operations a step:\n")
    print("| operations | unresolved pairs | certified error, mean % | true error, mean % | pairs missed | deepest of these % |")
    print("| --: | --- | --: | --: | --: | --: |")
    for line in lines:
        print("| {} | {} | {:.2f} | {:.2f} | {} of {} | {:.1f} |".format(
            line["budget_ops"] or "none", line["unresolved"], number(line, "certified_error_fraction_mean", 100),
            number(line, "contact_error_fraction_mean", 100), line["missed_pairs"], line["true_pairs"],
            number(line, "missed_depth_fraction_max", 100)))
    return lines


def heap(tree, bodies, steps):
    operations = ["2000", "5000", "10000", "20000", "50000", "100000", "none"]
    lines = measured([*tree, "--bodies", str(bodies), "--steps", str(steps), "--budget-ops", ",".join(operations)])
    print(f"\n{bodies} bodies that fall into a pit, {steps / 60:.0f} s:\n")
    print("| operations | narrow phase ms, 50 / 99 % | gaps under load, mean / most % | deepest % | asleep |")
    print("| --: | --: | --: | --: | --: |")
    for line in lines:
        print("| {} | {:.2f} / {:.2f} | {:.2f} / {:.2f} | {:.2f} | {} |".format(
            line["budget_ops"] or "none", number(line, "narrow_phase_cpu_us_median", 1e-3),
            number(line, "narrow_phase_cpu_us_p99", 1e-3), number(line, "gap_end_fraction_mean", 100),
            number(line, "gap_end_fraction_max", 100), number(line, "penetration_end_fraction_max", 100),
            line["bodies_asleep"]))
    return lines


def deadlines(tree, part):
    print("\nDeadlines, bodies kept awake in a pit; of the elapsed time of all steps:\n")
    print("| bodies | microseconds | steps | 50 / 99.9 / 99.99 % ms | late steps % | gaps under load, mean / most % | certified error, mean % |")
    print("| --: | --: | --: | --: | --: | --: | --: |")
    for bodies, microseconds, steps in [(20, 100, 100000), (20, 300, 20000), (100, 500, 20000), (100, 1000, 20000),
                                        (200, 1000, 10000), (200, 2000, 10000), (1000, 6000, 3000)]:
        steps = int(steps * part)
        run = report([*tree, "--bodies", str(bodies), "--steps", str(steps), "--no-sleeping", "--budget-us",
                      str(microseconds)])
        took = run["deadline"]
        print("| {} | {} | {} | {:.2f} / {:.2f} / {:.2f} | {:.1f} | {:.2f} / {:.2f} | {:.1f} |".format(
            bodies, microseconds, steps, took["elapsed_us"]["median"] / 1e3, took["elapsed_us"]["p999"] / 1e3,
            took["elapsed_us"]["p9999"] / 1e3, 100 * took["late_steps"] / steps,
            100 * (run["gap_end_fraction"]["mean"] or 0), 100 * (run["gap_end_fraction"]["max"] or 0),
            100 * run["certified_error_fraction"]["mean"]), flush=True)


def report(arguments):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "run.json")
        subprocess.run([PROGRAM, *arguments, "--json", path], check=True, stdout=subprocess.DEVNULL)
        with open(path) as file:
            return json.load(file)


def threads(tree, bodies, steps, repeats):
    print(f"\n{bodies} bodies on several threads, {steps} steps, medians of {repeats} pairs of runs:\n")
    print("| operations | threads | whole run, times as fast | 99 % of steps, times as fast | same bits |")
    print("| --: | --: | --: | --: | --- |")
    for operations in ["none", "200000", "50000"]:
        for count in [2, 4]:
            ratios, slow, same = [], [], True
            for _ in range(repeats):
                alone, together = (elapsed(tree, bodies, steps, operations, t) for t in (1, count))
                ratios.append(alone[0] / together[0])
                slow.append(alone[1] / together[1])
                same = same and alone[2] == together[2]
            print("| {} | {} | {:.2f} | {:.2f} | {} |".format(operations, count, median(ratios), median(slow),
                                                             "yes" if same else "NO"), flush=True)


def elapsed(tree, bodies, steps, operations, count):
    with tempfile.TemporaryDirectory() as folder:
        table, report = os.path.join(folder, "steps.csv"), os.path.join(folder, "run.json")
        subprocess.run([PROGRAM, *tree, "--bodies", str(bodies), "--steps", str(steps), "--budget-ops", operations,
                        "--threads", str(count), "--csv", table, "--json", report], check=True,
                       stdout=subprocess.DEVNULL)
        with open(table, newline="") as file:
            times = sorted(float(line["elapsed_us"]) for line in csv.DictReader(file))
        with open(report) as file:
            return sum(times), times[int(0.99 * len(times))], json.load(file)["state_hash"]


def median(values):
    return sorted(values)[len(values) // 2]


def draw(folder, of_flying, of_heap):
    figure = os.path.join(folder, "budgets.svg")
    by = {(line["budget_ops"], line["unresolved"]): number(line, "contact_error_fraction_mean", 100) for line in of_flying}
    without = number(of_heap[-1], "narrow_phase_cpu_us_p99", 1e-3)
    with tempfile.TemporaryDirectory() as scratch:
        names = {"figure": figure, "flying": os.path.join(scratch, "flying"), "heap": os.path.join(scratch, "heap")}
        with open(names["flying"], "w") as file:
            for operations in OPERATIONS[:-1]:
                print(operations, by[operations, "guard"], by[operations, "repel"], file=file)
        with open(names["heap"], "w") as file:
            for line in of_heap[:-1]:
                print(line["budget_ops"], number(line, "narrow_phase_cpu_us_p99", 1e-3), without, file=file)
        subprocess.run(["gnuplot"], input=FIGURE.format(**names), text=True, check=True)
    print(f"\nThe figure: {figure}")


def main():
    global PROGRAM
    parser = argparse.ArgumentParser(prog="./cairn.sh bench budgets", description=__doc__)
    parser.add_argument("--tree", help="a .cairn file (default: made of the bunny)")
    parser.add_argument("--mesh", help="a mesh instead")
    parser.add_argument("--quick", action="store_true", help="less of everything, in half a minute")
    parser.add_argument("-o", "--output", default="out/bench", help="folder of the figure (default: %(default)s)")
    parser.add_argument("--program", default=PROGRAM, help="frame_budget (default: %(default)s)")
    options = parser.parse_args()
    PROGRAM = options.program
    tree = ["--tree", options.tree] if options.tree else ["--mesh", options.mesh]
    os.makedirs(options.output, exist_ok=True)
    try:
        of_flying = flying(tree, 1 if options.quick else 5)
        of_heap = heap(tree, 100, 300 if options.quick else 900)
        draw(options.output, of_flying, of_heap)
        deadlines(tree, 0.01 if options.quick else 1)
        threads(tree, 200, 60 if options.quick else 300, 1 if options.quick else 5)
    except FileNotFoundError as missing:
        sys.exit(f"bench budgets: {missing.filename} is missing: build the release, and install gnuplot for the figure")
    except subprocess.CalledProcessError as failed:
        sys.exit(f"bench budgets: {failed.cmd[0]} ended with {failed.returncode}; what it said is above")


if __name__ == "__main__":
    main()
