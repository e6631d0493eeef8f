#!/usr/bin/env python3
"""What covers of so many spheres prove and cost, objective by objective, beside a level of a tree.

A row a mesh, number and objective: the certified pair (a: spheres stick out of the solid at most, b: surface left out at
most), the sampled protrusion, all in percent of the mesh's diagonal; volume ratio (union over solid); volume outside in
percent of the solid's; CPU seconds. `tree` is the same figure of the naive set: the spheres of the level of a tree
(`--method combined`) with no more spheres than asked for; shrunk by half of its error for balanced, its inner balls for
inner. `gain` is how many times better the cover's error is (volume: the volume outside).
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile


def run(tool, *arguments):
    done = subprocess.run([tool, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"covers.py: {' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


class NaiveSets:
    """Spheres of a tree's levels, and what becomes of them for each objective."""

    def __init__(self, tool, mesh, folder):
        self.tool, self.mesh, self.folder = tool, mesh, folder
        tree = folder / "tree.cairn"
        run(tool, "build", mesh, "-o", tree, "--no-evaluate")
        run(tool, "export", tree, "--to", "spheres", "-o", folder / "tree.txt")
        self.levels = {}
        for line in (folder / "tree.txt").read_text().splitlines():
            level, x, y, z, r, _ = line.split()
            self.levels.setdefault(int(level), []).append([float(x), float(y), float(z), float(r)])

    def certified(self, spheres):
        text = self.folder / "naive.txt"
        text.write_text("".join(" ".join(map(repr, s)) + "\n" for s in spheres))
        return json.loads(run(self.tool, "certify", self.mesh, text, "--json", "-"))

    def inner(self, spheres):
        """The balls around the same centres that lie in the solid: what a sphere protrudes by at its radius is at
        least its excess over that, so shrinking by the certified protrusion until nothing sticks out."""
        kept = []
        for s in spheres:
            radius = s[3]
            for _ in range(12):
                out = self.certified([[*s[:3], radius]])["certified"]["sticks_out"]["at_most"]
                if out == 0 or radius <= out:
                    break
                radius -= out
            if out == 0:
                kept.append([*s[:3], radius])
        return kept

    def error(self, count, objective):
        level = max((l for l in self.levels if len(self.levels[l]) <= count), default=0)
        spheres = self.levels[level]
        proof = self.certified(spheres)
        a = proof["certified"]["sticks_out"]["at_most_fraction"]
        if objective == "outer":
            return a
        if objective == "volume":
            return proof["volume_ratio"]
        if objective == "balanced":
            shrink = a * proof["diagonal"] / 2
            proof = self.certified([[*s[:3], s[3] - shrink] for s in spheres if s[3] > shrink])
            return max(proof["certified"][k]["at_most_fraction"] for k in ("sticks_out", "leaves_out_surface"))
        kept = self.inner(spheres)
        return self.certified(kept)["certified"]["leaves_out_surface"]["at_most_fraction"] if kept else math.inf


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--tool", default="build/release/bin/cairn")
    parser.add_argument("--spheres", default="4,8,20,64,256")
    parser.add_argument("--objectives", default="outer,balanced,inner,volume")
    parser.add_argument("--no-naive", action="store_true", help="leave out the tree's figures")
    parser.add_argument("--json", type=pathlib.Path, help="write the rows as JSON too")
    options = parser.parse_args()
    rows = []
    print("mesh             N  objective   a %      b %      sampled %  volume ratio  outside %  CPU s   tree     gain", flush=True)
    for mesh in options.meshes:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            naive = None if options.no_naive else NaiveSets(options.tool, mesh, folder)
            for count in map(int, options.spheres.split(",")):
                for objective in options.objectives.split(","):
                    rows.append(row(options.tool, mesh, count, objective, folder, naive))
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


def row(tool, mesh, count, objective, folder, naive):
    report = json.loads(run(tool, "cover", mesh, "--spheres", count, "--objective", objective, "-o", folder / "c.txt",
                            "--json", "-"))
    lines = len((folder / "c.txt").read_text().splitlines())
    if lines != count or report["spheres"] != count:
        sys.exit(f"covers.py: {mesh}: {lines} spheres where {count} were asked for")
    certified, sampled = report["certified"], report["sampled"]
    a, b = (100 * certified[k]["at_most_fraction"] for k in ("sticks_out", "leaves_out_surface"))
    r = {"mesh": mesh.name, "spheres": count, "objective": objective, "sticks_out_percent": a,
         "leaves_out_surface_percent": b, "sampled_sticks_out_percent": 100 * sampled["sticks_out_fraction"],
         "volume_ratio": report["volume_ratio"], "outside_percent": 100 * sampled["excess_volume_fraction"],
         "cpu_s": report["cover_cpu_s"]}
    tree, gain = "", ""
    if naive:
        other = naive.error(count, objective)
        if objective == "volume":
            # The surface is covered and, but for hollows, the inside too: what is above 1 lies outside.
            r["tree"], ours = 100 * (other - 1), 100 * (report["volume_ratio"] - 1)
        else:
            r["tree"], ours = 100 * other, 100 * report["certified_error_fraction"]
        r["gain"] = r["tree"] / ours if ours > 0 else math.inf
        tree, gain = f"{r['tree']:.3f}", f"{r['gain']:.2f}"
    print(f"{mesh.name:<15}{count:>4}  {objective:<9}{a:7.3f}  {b:7.3f}  {r['sampled_sticks_out_percent']:9.3f}  "
          f"{r['volume_ratio']:12.4f}  {r['outside_percent']:9.2f}  {r['cpu_s']:6.1f}  {tree:>7}  {gain:>5}", flush=True)
    return r


if __name__ == "__main__":
    main()
