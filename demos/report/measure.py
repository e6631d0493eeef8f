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

import alone
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

    def __init__(self, data, source, deadline, about, command, lock=None):
        """`about`: what the machine and the checkout are now (machine.describe); `command`: of the report; `lock`: of the
        data, which children hold too."""
        self.data, self.source, self.deadline = data, source, deadline
        self.about, self.command, self.lock = about, command, lock
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

    def _left(self, part):
        """The stamp of a part, if it is one of the same key; the files it vouches for may be damaged or gone."""
        stamp = self._read_stamp(part)
        same = stamp.get("key") == self._key(part) and isinstance(stamp.get("made"), dict)
        return stamp if same and isinstance(stamp.get("files"), dict) and isinstance(stamp.get("seconds"), (int, float)) else None

    def _whole(self, stamp, names):
        """Whether these files are, to the byte, what the part left."""
        return all(digest and digest == stamp["files"].get(name) for name, digest in keys.digests_of(names, self.data).items())

    def kept(self, part):
        """What an earlier run left of a part, if its key is the same and every file it left, figures included."""
        stamp = self._left(part)
        return stamp if stamp and self._whole(stamp, [*part.outputs, *stamp["files"]]) else None

    def _undrawn(self, part):
        """The stamp of an experiment that lacks nothing but figures: it draws them anew without measuring."""
        stamp = self._left(part) if part.kind == "experiment" else None
        return stamp if stamp and self._whole(stamp, part.outputs) else None

    def _read_stamp(self, part):
        """What is no stamp is none."""
        try:
            stamp = json.loads(self._stamp(part).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return stamp if isinstance(stamp, dict) else {}

    def expected(self, part):
        """Seconds a part will take: what it took when it was last made, else about."""
        seconds = self._read_stamp(part).get("seconds")
        return float(seconds) if isinstance(seconds, (int, float)) else part.seconds

    def _run(self, part):
        """Exit code and what the part said on standard error."""
        log = self.data / "logs" / f"{part.name}.log"
        out = self.data / (part.stdout or f"logs/{part.name}.out")
        with open(f"{out}.partial", "w", encoding="utf-8") as output, open(log, "w", encoding="utf-8") as errors:
            self.child = alone.started(part.command, self.lock, stdout=output, stderr=errors, cwd=self.source)
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
        undrawn = self._undrawn(part)
        forget = (lambda _: None) if undrawn else self._forget
        forget(part)  # what is there is damaged, or of other programs or settings
        started, made = time.monotonic(), self._made()
        try:
            code, said = self._run(part)
        except Cancelled:
            forget(part)
            raise
        except OSError as failure:
            return {"state": "failed", "why": f"it could not be started: {failure.strerror}"}
        measured = {"seconds": time.monotonic() - started, "made": made}
        if code == 0 and all((self.data / o).exists() for o in part.outputs):
            if undrawn:  # times and day stay those of the measurement
                measured = {key: undrawn[key] for key in measured}
            stamp = {"key": self._key(part), "files": keys.digests_of(keys.left_by(part, self.data), self.data), **measured}
            keys.written_whole(self._stamp(part), json.dumps(stamp))
            return {"state": "done", "kept": bool(undrawn), **measured}
        forget(part)
        if code is None:
            return {"state": "left out", "why": f"it was stopped when the {QUICK_SECONDS // 60} minutes of --quick were over"}
        return {"state": "failed", "why": said.splitlines()[-1] if said else f"it ended with exit code {code}", "seconds": measured["seconds"]}

    def forget_other_models(self, program, archive):
        """The program keeps the meshes it makes: those of another archive or another program go."""
        stamp, key = self.data / "stamps/models.txt", keys.key_of([], [program, archive], {})
        if not stamp.exists() or stamp.read_bytes() != key.encode():
            for mesh in (self.data / "models").glob("*.obj"):
                mesh.unlink()
        keys.written_whole(stamp, key)

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
                      "command": parts.shown(part, self.source, self.data)}
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


def command_of(asked, source):
    """The report's own command, as somebody in the checkout would type it."""
    words = ["./cairn.sh", "report"] + (["--quick"] if asked.quick else []) + (["--only", asked.only] if asked.only else [])
    for name, value, default in (("--output", asked.output, "out/report"), ("--models", asked.models, ""), ("--archive", asked.archive, parts.ARCHIVE),
                                 ("--programs", asked.programs, "build/release/bin")):
        # Made absolute here: cairn.sh changes to the checkout first.
        path = value and parts.from_checkout(str(Path(value).resolve()), source)
        if path != parts.from_checkout(default, source):
            words += ["-o" if name == "--output" else name, path]
    return shlex.join(words)


def refusal(asked, output, data):
    """Why no report can be made with these options, or nothing. Makes the folders."""
    try:
        for folder in ("", "stamps", "logs", "gallery", "models"):
            (data / folder).mkdir(parents=True, exist_ok=True)
    except OSError as failure:
        return f"{failure.filename}: {failure.strerror}; name another folder with -o"
    if not os.access(Path(asked.programs) / "accuracy_cost", os.X_OK):
        return f"there is no accuracy_cost in {Path(asked.programs).resolve()}; ./cairn.sh report builds it first"
    return ""


def wrong_usage(asked, chosen, plan):
    names = [part.name for part in plan]
    if asked.only and not chosen:
        return f"--only names no part; they are {', '.join(names)}"
    if unknown := chosen - set(names):
        return f"there is no part {sorted(unknown)[0]}; they are {', '.join(names)}"
    return ""


def complain(why, code):
    print(f"report: {why}", file=sys.stderr)
    return code


def report(asked, source, output, data, lock, begun):
    """Measures and writes the page. The exit code."""
    import page
    programs = Path(asked.programs).resolve()
    plan = parts.Plan(source, programs, data, asked.quick, asked.models and str(Path(asked.models).resolve()), asked.archive).parts()
    chosen = {name for name in asked.only.split(",") if name}
    if why := wrong_usage(asked, chosen, plan):
        return complain(why, 2)
    about, command = machine.describe(source, programs.parent), command_of(asked, source)
    measuring = Measuring(data, source, begun + QUICK_SECONDS - GRACE_SECONDS - PAGE_SECONDS if asked.quick else None, about, command, lock)
    measuring.forget_other_models(programs / "accuracy_cost", asked.archive)
    try:
        records = measuring.all(plan, chosen)
    except Cancelled:
        return complain("cancelled; the same command goes on from here.", 130)
    run = {"quick": asked.quick, "command": command, "machine": about, "seconds": time.monotonic() - begun,
           "parts": list(records.values())}
    keys.written_whole(data / "run.json", json.dumps(run, indent=1))
    failed = [name for name in page.write(data, output / "index.html") if not chosen or name in chosen]
    print(f"{output / 'index.html'}, {clock(time.monotonic() - begun)}")
    if failed:
        complain(f"not in it: {', '.join(failed)}; the page says why.", 1)
    return 1 if failed else 0


def main():
    begun = time.monotonic()
    asked = options()
    try:
        import page  # noqa: F401
    except ImportError:
        return complain("the page needs jinja2; install the package python3-jinja2", 1)
    output = Path(asked.output).resolve()
    data = output / ("data-quick" if asked.quick else "data")
    if why := refusal(asked, output, data):
        return complain(why, 1)
    with alone.locked(data) as lock:
        if lock is None:
            return complain(f"another report, or an experiment one left running, is at work in {data}; wait for it, end it, or name another folder with -o", 1)
        return report(asked, Path(__file__).resolve().parents[2], output, data, lock, begun)


if __name__ == "__main__":
    sys.exit(main())
