#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs, at a glance: one figure and three sentences, from the table of the experiment error-against-time.

Usage: glance.py TABLE.csv [-o PICTURE.png|PICTURE.svg] [--model NAME] [--scene heap|converge]
"""
import argparse
import csv
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

EXACT, LEAVES = "treeTriangles", "tree"
SERIES = {"tree + triangles by budget": EXACT}  # what starts with "tree of" and ends in "by budget" are leaves
NAMES = {"compound of hulls (HACD)": "hulls by HACD", "compound of the tree's leaf spheres": "Bullet's compound of the leaf spheres", "hull": "convex hull"}
WIDTH, HEIGHT, LETTER, LINE = 1080, 620, 9.1, 22  # pixels of the picture, of a letter and a line of its labels
LEFT, RIGHT, TOP, BOTTOM = 104, 24, 64, 80  # margins, pixels
FRAME = {"heap": "bodies of a heap", "converge": "bodies that fly to one point"}


class Unusable(Exception):
    """The table does not say what the figure needs; the text says why."""


@dataclass
class Point:
    label: str
    kind: str  # EXACT, LEAVES or "rival"
    error_cm: float  # mean error of a pair, of bodies 1 m across: the same number in per cent of the size
    time_us: float  # CPU time of the dispatch, a frame
    budget: int | None = None


def points_of(rows, model, scene):
    """Ours at each budget, and each rival at its margin of least error."""
    ours, rivals = [], {}
    for row in rows:
        if (row["model"], row["scene"]) != (model, scene):
            continue
        try:
            error, time = 100 * float(row["error_mean_fraction"]), float(row["time_us"])
        except ValueError as failure:
            raise Unusable(f"the row of {row['series']} has no error or time ({failure})") from failure
        if not (error > 0 and time > 0):
            raise Unusable(f"{row['series']} errs by {error} cm in {time} us, which no logarithmic axis can show")
        if row["side"] == "ours":
            kind = SERIES.get(row["series"]) or (LEAVES if row["series"].startswith("tree of") and row["series"].endswith("levels by budget") else None)
            budget = int(float(row["budget_operations"])) if row["budget_operations"] else None
            if kind == EXACT:
                ours.append(Point("Cairn, no budget" if budget is None else f"Cairn, {budget:,} operations", kind, error, time, budget))
            elif kind == LEAVES and budget is None:
                ours.append(Point("Cairn, contacts of leaves", kind, error, time))
        else:
            family = row["series"].split(" without margin")[0].split(" at a margin")[0]
            margin = float(row["margin_fraction"]) if row["margin_fraction"] else None
            label = NAMES.get(family, family) + (f", margin {100 * margin:g} %" if margin else "")
            point = Point(label, "rival", error, time)
            if family not in rivals or error < rivals[family].error_cm:
                rivals[family] = point
    if not any(p.kind == EXACT for p in ours) or not rivals:
        raise Unusable(f"the table has no sphere-trees beside rivals for {model}, {scene}")
    return ours + list(rivals.values())


def times(ratio):
    """A ratio in words: 2.3 times, half as."""
    return f"{ratio:.2g} times" if ratio < 9.5 else f"{ratio:.0f} times"


def length(error_cm):
    return f"{error_cm:.2g} cm" if error_cm >= 0.1 else f"{10 * error_cm:.2g} mm"


def duration(time_us):
    return f"{time_us / 1000:.2g} ms" if time_us >= 1000 else f"{time_us:.0f} µs"


def against_rivals(points):
    """Our point of least error, and the rival of least error."""
    least = lambda ours: min((p for p in points if (p.kind != "rival") == ours), key=lambda p: p.error_cm)
    return least(True), least(False)


def halved(points):
    """Of our points in at most 60 % of the time of exact contacts without a budget, the one of least error."""
    full = next((p for p in points if p.kind == EXACT and p.budget is None), None)
    cheaper = [p for p in points if p.kind != "rival" and full and p.time_us <= 0.6 * full.time_us]
    return (full, min(cheaper, key=lambda p: p.error_cm)) if cheaper else None


def title_of(points):
    """The finding, whoever wins."""
    best, rival = against_rivals(points)
    error, time = rival.error_cm / best.error_cm, rival.time_us / best.time_us
    errs = f"errs {times(error)} less" if error >= 1 else f"errs {times(1 / error)} more"
    takes = f"{times(time)} as fast" if time >= 1 else f"{times(1 / time)} as slow"
    return f"Cairn {errs} than the best other shape, and is {takes}"


def sentences_of(points, model, scene):
    best, rival = against_rivals(points)
    lines = [f"On a {model} one metre long, among {FRAME.get(scene, scene)}, Cairn's contacts err by {length(best.error_cm)} and take {duration(best.time_us)} a frame.",
             f"Of all rivals on the same poses {rival.label} errs least: {length(rival.error_cm)} in {duration(rival.time_us)}."]
    if cut := halved(points):
        full, cheap = cut
        how = "contacts of the leaves" if cheap.kind == LEAVES else "contacts of the meshes"
        budget = "without a budget" if cheap.budget is None else f"with {cheap.budget:,} operations"
        lines.append(f"{100 * cheap.time_us / full.time_us:.0f} % of the time costs you this: {how} {budget} err by {length(cheap.error_cm)}.")
    else:
        lines.append("No budget here takes less than 60 % of the time without one.")
    return lines


class Frame:
    """Where numbers are in the picture, and which boxes of pixels are taken."""

    def __init__(self, points):
        self.x = self.span([p.error_cm for p in points])
        self.y = self.span([p.time_us for p in points])
        self.taken = [self.box(*self.at(p), -8, -8, 16, 16) for p in points]
        line = sorted((p for p in points if p.kind == EXACT), key=lambda p: p.error_cm)
        for p, q in zip(line, line[1:]):
            (x, y), (u, v) = self.at(p), self.at(q)
            self.taken += [self.box(x + (u - x) * i / 40, y + (v - y) * i / 40, -3, -3, 6, 6) for i in range(41)]

    @staticmethod
    def span(values):
        low, high = min(values), max(values)
        room = max(1.25, (high / low) ** 0.08)
        return low / room, high * room

    @staticmethod
    def box(x, y, dx, dy, width, height):
        return x + dx, y + dy, x + dx + width, y + dy + height

    def at(self, point):
        """Pixels from the lower left corner."""
        part = lambda value, span: math.log(value / span[0]) / math.log(span[1] / span[0])
        return LEFT + part(point.error_cm, self.x) * (WIDTH - LEFT - RIGHT), BOTTOM + part(point.time_us, self.y) * (HEIGHT - TOP - BOTTOM)

    def place(self, point, text):
        """Where a label stands clear of all points and labels: left edge and middle, pixels."""
        x, y = self.at(point)
        width = LETTER * len(text)
        sides = [(10, -LINE / 2), (-10 - width, -LINE / 2), (-width / 2, 8), (-width / 2, -8 - LINE), (10, 6), (10, -6 - LINE), (-10 - width, 6), (-10 - width, -6 - LINE)]
        sides += [(dx, dy + step * LINE) for step in (1, -1, 2, -2) for dx, dy in sides[:2]]
        boxes = [self.box(x, y, dx, dy, width, LINE) for dx, dy in sides]
        inside = [b for b in boxes if b[0] >= LEFT + 3 and b[2] <= WIDTH - RIGHT - 3 and b[1] >= BOTTOM + 3 and b[3] <= HEIGHT - TOP - 3] or boxes
        overlap = lambda b: sum(max(0, min(b[2], t[2]) - max(b[0], t[0])) * max(0, min(b[3], t[3]) - max(b[1], t[1])) for t in self.taken)
        best = min(inside, key=overlap)
        self.taken.append(best)
        return best[0], (best[1] + best[3]) / 2


def tics(span):
    """Every 1, 2 and 5 of each decade in the span."""
    decades = range(math.floor(math.log10(span[0])), math.ceil(math.log10(span[1])) + 1)
    values = [m * 10.0**d for d in decades for m in (1, 2, 5)]
    return ", ".join(f"'{v:g}' {v:g}" for v in values if span[0] <= v <= span[1])


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


# By kind: colour (Okabe and Ito 2008), marker.
LOOKS = {EXACT: ("#0072B2", 7), LEAVES: ("#0072B2", 6), "rival": ("#D55E00", 5)}


def script_of(points, picture):
    frame = Frame(points)
    format_of = {".svg": f"svg size {WIDTH},{HEIGHT} noenhanced font 'sans,17'", ".png": f"pngcairo size {WIDTH},{HEIGHT} noenhanced font 'sans,12.5'"}
    lines = [f"set terminal {format_of[picture.suffix]} background 'white'", f"set output {quoted(str(picture))}", "set encoding utf8",
             "set logscale xy", f"set xrange [{frame.x[0]}:{frame.x[1]}]", f"set yrange [{frame.y[0]}:{frame.y[1]}]", f"set xtics ({tics(frame.x)})", f"set ytics ({tics(frame.y)})",
             "set grid lc rgb '#DDDDDD'", "set border 3 lc rgb '#555555'", "set tics nomirror", f"set label {quoted(title_of(points))} at screen 0.5,{1 - 30 / HEIGHT} center font 'sans,{22 if picture.suffix == '.svg' else 16}'",
             "set xlabel 'mean error of a pair: centimetres of a body one metre long, per cent of any'", "set ylabel 'time of a frame, µs' offset 1",
             f"set lmargin at screen {LEFT / WIDTH}", f"set rmargin at screen {1 - RIGHT / WIDTH}", f"set bmargin at screen {BOTTOM / HEIGHT}", f"set tmargin at screen {1 - TOP / HEIGHT}",
             "unset key"]
    for p in points:
        x, y = frame.place(p, p.label)
        lines.append(f"set label {quoted(p.label)} at screen {x / WIDTH},{y / HEIGHT} left front tc rgb '{LOOKS[p.kind][0]}'")
    plots = []
    for kind, (color, marker) in LOOKS.items():
        some = sorted((p for p in points if p.kind == kind), key=lambda p: p.error_cm)
        if not some:
            continue
        lines += [f"$data{marker} << END", *(f"{p.error_cm} {p.time_us}" for p in some), "END"]
        style = f"linespoints pt {marker} ps 1.6 lw 2" if kind == EXACT else f"points pt {marker} ps 1.6 lw 2"
        plots.append(f"$data{marker} with {style} lc rgb '{color}'")
    return "\n".join([*lines, "plot " + ", \\\n  ".join(plots)]) + "\n"


def draw(points, picture):
    done = subprocess.run(["gnuplot"], input=script_of(points, picture), capture_output=True, text=True, check=False)
    if done.returncode != 0 or done.stderr.strip():
        raise Unusable(f"gnuplot did not draw {picture}: {done.stderr.strip()}")


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    needed = {"model", "scene", "series", "side", "budget_operations", "margin_fraction", "error_mean_fraction", "time_us"}
    if not rows or not needed <= set(rows[0]):
        raise Unusable(f"{path} is no table of error-against-time; make it with `accuracy_cost run error-against-time`")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("table", type=Path)
    parser.add_argument("-o", "--output", type=Path, help="a .png or .svg; without it only the sentences are printed")
    parser.add_argument("--model", default="bunny")
    parser.add_argument("--scene", default="heap")
    arguments = parser.parse_args()
    if arguments.output and arguments.output.suffix not in (".png", ".svg"):
        parser.error(f"a picture's name ends in .png or .svg, not as {arguments.output}")
    try:
        points = points_of(read(arguments.table), arguments.model, arguments.scene)
        if arguments.output:
            draw(points, arguments.output)
        print("\n".join(sentences_of(points, arguments.model, arguments.scene)))
    except (Unusable, OSError) as failure:
        print(f"glance: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
