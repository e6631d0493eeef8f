#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a report: runs what is not there yet, then has the page written. ./cairn.sh report calls it."""
import argparse
import json
import os
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import keys
import machine
import parts

QUICK_SECONDS = 600  # what --quick may take
GRACE_SECONDS = 20  # for a part that was told to stop
PAGE_SECONDS = 15  # kept back for the page itself


class Cancelled(Exception):
    """Ctrl-C."""


def clock(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


class Measuring:
    """Runs the parts of a plan one after another, keeping those that are done."""

    def __init__(self, data, source, deadline, about, command):
        """`about`: what the machine and the checkout are now (machine.describe); `command`: of the report."""
        self.data, self.source, self.deadline = data, source, deadline
        self.about, self.command = about, command
        self.child = None
        self.cancelled = False
        signal.signal(signal.SIGINT, self._cancel)
        signal.signal(signal.SIGTERM, self._cancel)

    def _cancel(self, *_):
        self.cancelled = True
        if self.child:  # a child of the terminal hears of Ctrl-C by itself, others do not
            self.child.send_signal(signal.SIGINT)

    def _stamp(self, part):
        return self.data / "stamps" / f"{part.name}.json"

    def _key(self, part):
        return keys.key_of(part.command, part.programs + part.inputs, self.about)

    def _made(self):
        """When, of what and by what a part is made; it stays with what the part leaves."""
        return {"date": machine.now(), "commit": self.about["Commit"], "command": self.command, "cpu": self.about["CPU"],
                "load": "%.1f" % os.getloadavg()[0]}

    def kept(self, part):
        """What an earlier run left of a part, if its key is the same."""
        try:
            stamp = json.loads(self._stamp(part).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        same = stamp.get("key") == self._key(part) and "made" in stamp and all((self.data / o).exists() for o in part.outputs)
        return stamp if same else None

    def expected(self, part):
        """Seconds a part will take: what it took when it was last made, else about."""
        try:
            return float(json.loads(self._stamp(part).read_text(encoding="utf-8"))["seconds"])
        except (OSError, ValueError, KeyError):
            return part.seconds

    def _run(self, part):
        """Exit code and what the part said on standard error."""
        log = self.data / "logs" / f"{part.name}.log"
        out = self.data / (part.stdout or f"logs/{part.name}.out")
        with open(f"{out}.partial", "w", encoding="utf-8") as output, open(log, "w", encoding="utf-8") as errors:
            self.child = subprocess.Popen(part.command, stdout=output, stderr=errors, cwd=self.source)
            try:
                code = self.child.wait(None if self.deadline is None else max(1, self.deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                self.child.send_signal(signal.SIGINT)
                try:
                    self.child.wait(GRACE_SECONDS)
                except subprocess.TimeoutExpired:
                    self.child.kill()
                    self.child.wait()
                code = None
            finally:
                self.child = None
        if self.cancelled:
            os.remove(f"{out}.partial")
            raise Cancelled
        if code == 0:
            os.replace(f"{out}.partial", out)
        else:
            os.remove(f"{out}.partial")
        return code, log.read_text(encoding="utf-8", errors="replace").strip()

    def _forget(self, part):
        for output in part.outputs:
            (self.data / output).unlink(missing_ok=True)

    def make(self, part):
        """One part, whatever becomes of it: its state and why."""
        self._forget(part)  # what is there is of other programs or settings
        started, made = time.monotonic(), self._made()
        try:
            code, said = self._run(part)
        except Cancelled:
            self._forget(part)
            raise
        except OSError as failure:
            return {"state": "failed", "why": f"it could not be started: {failure.strerror}"}
        seconds = time.monotonic() - started
        there = all((self.data / o).exists() for o in part.outputs)
        if code != 0 or not there:
            self._forget(part)
        if code is None:
            return {"state": "left out", "why": f"it was stopped when the {QUICK_SECONDS // 60} minutes of --quick were over"}
        if there and code == 0:
            stamp = {"key": self._key(part), "seconds": seconds, "made": made}
            self._stamp(part).write_text(json.dumps(stamp), encoding="utf-8")
            return {"state": "done", "seconds": seconds, "kept": False, "made": made}
        why = said.splitlines()[-1] if said else f"it ended with exit code {code}"
        return {"state": "failed", "why": why, "seconds": seconds}

    def forget_other_models(self, program, archive):
        """The program keeps the meshes it makes: those of another archive or another program go."""
        stamp, key = self.data / "stamps/models.txt", keys.key_of([], [program, archive], {})
        if not stamp.exists() or stamp.read_text(encoding="utf-8") != key:
            for mesh in (self.data / "models").glob("*.obj"):
                mesh.unlink()
        stamp.write_text(key, encoding="utf-8")

    def blocked(self, part, records):
        """Why a part cannot be made now, or nothing."""
        for need in part.needs:
            if records.get(need, {}).get("state") != "done":
                return f"{need} is not there"
        if self.deadline is not None and time.monotonic() > self.deadline:
            return f"the {QUICK_SECONDS // 60} minutes of --quick were over; the same command goes on from here"
        return ""

    def all(self, plan, chosen):
        """Every part's record by its name."""
        records = {}
        waiting = [p for p in plan if not p.absent and not self.kept(p) and (not chosen or p.name in chosen)]
        for part in plan:
            if self.cancelled:
                raise Cancelled
            record = {"name": part.name, "title": part.title, "kind": part.kind, "outputs": part.outputs,
                      "command": parts.shown(part, self.source)}
            records[part.name] = record
            kept = self.kept(part)
            if part.absent:
                record |= {"state": "absent", "why": part.absent}
            elif kept:
                record |= {"state": "done", "seconds": kept["seconds"], "kept": True, "made": kept["made"]}
            elif chosen and part.name not in chosen:
                record |= {"state": "left out", "why": "it was not asked for (--only)"}
            elif why := self.blocked(part, records):
                record |= {"state": "left out", "why": why}
            else:
                left = sum(self.expected(p) for p in waiting)
                print(f"[{plan.index(part) + 1}/{len(plan)}] {part.name}, about {clock(self.expected(part))};"
                      f" about {clock(left)} left for all", flush=True)
                record |= self.make(part)
                if record["state"] != "done":
                    print(f"    {record['state']}: {record['why']}", flush=True)
            if part in waiting:
                waiting.remove(part)
        return records


def options():
    parser = argparse.ArgumentParser(
        prog="cairn.sh report", description="Runs the experiments and writes one page of all they found: DIR/index.html. "
        "What is there of the same options, programs and meshes is kept, and says so on the page: a run that was stopped goes on.")
    parser.add_argument("--quick", action="store_true", help=f"few models and coarse steps, at most {QUICK_SECONDS // 60} minutes")
    parser.add_argument("-o", "--output", default="out/report", metavar="DIR", help="default: out/report")
    parser.add_argument("--only", default="", metavar="PARTS", help="measure these alone, separated by commas")
    parser.add_argument("--models", default="", metavar="DIR", help="meshes for the experiments instead of the thesis's")
    parser.add_argument("--archive", default=parts.ARCHIVE, help="of meshes (libcgal-demo)")
    parser.add_argument("--programs", default="build/release/bin", metavar="DIR", help="default: build/release/bin")
    return parser.parse_args()


def main():
    begun = time.monotonic()
    asked = options()
    try:
        import page
    except ImportError:
        print("report: the page needs jinja2; install the package python3-jinja2", file=sys.stderr)
        return 1
    source = Path(__file__).resolve().parents[2]
    output, programs = Path(asked.output).resolve(), Path(asked.programs).resolve()
    data = output / ("data-quick" if asked.quick else "data")
    try:
        for folder in ("", "stamps", "logs", "gallery", "models"):
            (data / folder).mkdir(parents=True, exist_ok=True)
    except OSError as failure:
        print(f"report: {failure.filename}: {failure.strerror}; name another folder with -o", file=sys.stderr)
        return 1
    if not os.access(programs / "accuracy_cost", os.X_OK):
        print(f"report: there is no accuracy_cost in {programs}; ./cairn.sh report builds it first", file=sys.stderr)
        return 1
    plan = parts.Plan(source, programs, data, asked.quick, asked.models and str(Path(asked.models).resolve()), asked.archive).parts()
    chosen = {name for name in asked.only.split(",") if name}
    if asked.only and not chosen:
        print(f"report: --only names no part; they are {', '.join(p.name for p in plan)}", file=sys.stderr)
        return 2
    if unknown := chosen - {part.name for part in plan}:
        print(f"report: there is no part {sorted(unknown)[0]}; they are {', '.join(p.name for p in plan)}", file=sys.stderr)
        return 2
    about = machine.describe(source, programs.parent)
    command = shlex.join(["./cairn.sh", "report", *(["--quick"] if asked.quick else []),
                          *(["--only", asked.only] if asked.only else []),
                          *(["--models", Path(asked.models).name] if asked.models else [])])
    measuring = Measuring(data, source, begun + QUICK_SECONDS - GRACE_SECONDS - PAGE_SECONDS if asked.quick else None, about, command)
    measuring.forget_other_models(programs / "accuracy_cost", asked.archive)
    try:
        records = measuring.all(plan, chosen)
    except Cancelled:
        print("report: cancelled; the same command goes on from here.", file=sys.stderr)
        return 130
    run = {"quick": asked.quick, "command": command, "machine": about, "seconds": time.monotonic() - begun,
           "parts": list(records.values())}
    (data / "run.json").write_text(json.dumps(run, indent=1), encoding="utf-8")
    failed = [name for name in page.write(data, output / "index.html") if not chosen or name in chosen]
    print(f"{output / 'index.html'}, {clock(time.monotonic() - begun)}")
    if failed:
        print(f"report: not in it: {', '.join(failed)}; the page says why.", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
