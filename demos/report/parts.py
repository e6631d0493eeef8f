# SPDX-License-Identifier: GPL-3.0-or-later
"""What a report is made of: its parts, the command of each, and about how long they take."""
import os
import shlex
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

ARCHIVE = "/usr/share/doc/libcgal-dev/data.tar.gz"  # accuracy_cost's own default
SHAPES = "tree,tree+leaves,hull,spheres,gimpact"
METHODS = "octree,grid,hubbard,merge,expand,combined,adaptive"
# After the thesis's appendix B: sphere sets of a whole solid, then trees.
SET_REDUCTIONS = "hubbard,merge,expand,burst"
GALLERY = {"quick": (["bunny"], ["hubbard", "octree", "combined"]),
           "full": (["bunny", "cow", "dragon"],
                    ["octree", "grid", "hybrid", "hubbard", "merge", "expand", "combined", "adaptive"])}


@dataclass
class Part:
    """One command of a report and the files it leaves in the folder of the data."""
    name: str
    title: str
    kind: str  # experiment, textbook, laws, heap, converge, builder, printed (as tables), hard-cases, sphere-sets, tree, model
    command: list
    outputs: list
    seconds: float  # about, on two cores, for the time left
    stdout: str = ""  # file its output goes to, relative to the data
    programs: list = field(default_factory=list)  # what it depends on beside the command,
    inputs: list = field(default_factory=list)  # files, or folders of files
    needs: list = field(default_factory=list)  # parts that must be done
    absent: str = ""  # why this version or machine cannot have it


class Plan:
    """All parts of a report, in the order they are made: what takes seconds first."""

    def __init__(self, source, programs, data, quick, models, archive):
        self.source, self.programs, self.data = source, programs, data
        self.quick, self.models, self.archive = quick, models, archive

    def _program(self, name):
        return str(self.programs / name)

    def _model(self, name):
        return str(self.data / "models" / f"{name}.obj")

    def _archive(self):
        return [] if self.archive == ARCHIVE else ["--archive", self.archive]

    def parts(self):
        result = [self._textbook(), *self._scans(), self._heap(), self._builder()]
        result += self._sets() + self._trees() + [self._hard_cases()] + self._experiments()
        return result

    def results(self):
        """The parts of the results page (results.py), which has tables and no pictures."""
        result = [*self._scans(), self._textbook(), self._laws(), self._heap(), self._converge(), self._budgets(), self._builder()]
        return result + [self._tables(), *self._hard_cases_twice(), *self._experiments()]

    def _textbook(self):
        return Part("textbook", "The textbook's experiments", "textbook",
                    [self._program("textbook_bench"), "--json", str(self.data / "textbook.json")], ["textbook.json"], 5,
                    programs=[self._program("textbook_bench")])

    def _scan_names(self):
        return GALLERY["quick" if self.quick else "full"][0]

    def _scans(self):
        """The meshes other parts take; one by one, so that one that cannot be had is no matter for the others."""
        program = self._program("accuracy_cost")
        return [Part(f"model-{name}", f"The mesh {name}", "model",
                     [program, "models", name, "-o", str(self.data / "models"), *self._archive()],
                     [f"models/{name}.obj"], 3, programs=[program], inputs=[self.archive]) for name in self._scan_names()]

    def _heap(self):
        size = ["--bodies", "30", "--steps", "300"] if self.quick else ["--bodies", "100", "--steps", "600"]
        program = self._program("frame_budget")
        return Part("heap", "A heap, beside Bullet's own shapes", "heap",
                    [program, "--scene", "heap", "--mesh", self._model("bunny"), *size, "--shape", SHAPES, "--json",
                     str(self.data / "heap.json")], ["heap.json"], 25 if self.quick else 150,
                    programs=[program], inputs=[self._model("bunny")], needs=["model-bunny"])

    def _builder(self):
        script = str(self.source / "tests/bench/builder.sh")
        return Part("builder", "How long trees take to build", "builder",
                    [script, "--tool", self._program("cairn"), "--runs", "1" if self.quick else "3", "--methods", METHODS,
                     *[self._model(name) for name in self._scan_names()]], ["builder.txt"],
                    20 if self.quick else 150, stdout="builder.txt", programs=[script, self._program("cairn")],
                    inputs=[str(self.source / "tests/bench/toolkit_cpu.tsv"), *map(self._model, self._scan_names())],
                    needs=[f"model-{name}" for name in self._scan_names()])

    def _sets(self):
        program = self._program("sphere_set_picture")
        counts = "8,32,100" if self.quick else "8,32,100,200"
        return [Part(f"sphere-sets-{model}", f"Sphere sets of the {model}", "sphere-sets",
                     [program, self._model(model), "--reductions", SET_REDUCTIONS, "--spheres", counts, "--width", "900",
                      "-o", str(self.data / f"gallery/{model}-sets.png")], [f"gallery/{model}-sets.png"], 30,
                     programs=[program], inputs=[self._model(model)], needs=[f"model-{model}"]) for model in self._scan_names()]

    def _trees(self):
        result = []
        tool, drawer = self._program("cairn"), self._program("tree_picture")
        models, methods = GALLERY["quick" if self.quick else "full"]
        for model in models:
            for method in methods:
                stem = f"gallery/{model}-{method}"
                tree, picture = str(self.data / f"{stem}.cairn"), str(self.data / f"{stem}.png")
                result.append(Part(f"tree-{model}-{method}", f"The {model}'s tree by {method}", "tree",
                                   ["sh", "-c", '"$1" build "$2" --method "$3" --no-evaluate -o "$4" && "$5" "$4" --width 1000 -o "$6"',
                                    "sh", tool, self._model(model), method, tree, drawer, picture],
                                   [f"{stem}.png"], 8, programs=[tool, drawer], inputs=[self._model(model)], needs=[f"model-{model}"]))
        return result

    def _hard_cases(self):
        program = self._program("hard_cases")
        part = Part("hard-cases", "Hard cases", "hard-cases",
                    [program, *(["--quick"] if self.quick else []), "--json", str(self.data / "hard-cases.json")],
                    ["hard-cases.json"], 90 if self.quick else 900, programs=[program])
        if not os.access(program, os.X_OK):
            part.absent = "this version has no program hard_cases"
        return part

    def _hard_cases_twice(self):
        """The short runs that the tests make, and, unless quick, the whole ones."""
        program = self._program("hard_cases")
        return [Part(name, title, "hard-cases", [program, *options, "--json", str(self.data / f"{name}.json")], [f"{name}.json"], seconds,
                     programs=[program], absent="" if os.access(program, os.X_OK) else "this version has no program hard_cases")
                for name, title, options, seconds in (("hard-cases", "Hard cases, short runs", ["--quick"], 90),
                                                      ("hard-cases-whole", "Hard cases, whole runs", [], 900))
                if options or not self.quick]

    def _laws(self):
        program = self._program("laws_bench")
        return Part("laws", "The laws of rock-fall", "laws", [program, "--json", str(self.data / "laws.json")], ["laws.json"], 2, programs=[program])

    def _converge(self):
        program = self._program("frame_budget")
        return Part("converge", "Bodies that fly to one point", "converge",
                    [program, "--scene", "converge", "--mesh", self._model("bunny"), "--shape", "tree,tree+leaves,gimpact,fcl",
                     "--runs", "1" if self.quick else "3", "--json", str(self.data / "converge.json")], ["converge.json"], 10 if self.quick else 30,
                    programs=[program], inputs=[self._model("bunny")], needs=["model-bunny"])

    def _budgets(self):
        script, program = str(self.source / "tests/bench/budgets/run.py"), self._program("frame_budget")
        return Part("budgets", "Budgets, deadlines and threads", "printed",
                    ["python3", script, "--mesh", self._model("bunny"), "--program", program, "-o", str(self.data), *(["--quick"] if self.quick else [])],
                    ["budgets.md"], 30 if self.quick else 420, stdout="budgets.md", programs=[script, program],
                    inputs=[self._model("bunny")], needs=["model-bunny"])

    def _tables(self):
        script = self.source / "tests/tables"
        models = [self._model(name) for name in self._scan_names()] if self.quick else []  # else its own five
        return Part("trees", "Every method on every level", "printed",
                    [str(script / "run.sh"), "--tool", self._program("cairn"), "--out", str(self.data / "tables"), "--archive", self.archive,
                     "--markdown", str(self.data / "trees.md"), *models], ["trees.md"], 60 if self.quick else 300,
                    programs=[str(script), self._program("cairn")], inputs=[self.archive], needs=["model-bunny"])

    def _experiments(self):
        """Those the program lists, so that a new one is in the report without a word here."""
        program = self._program("accuracy_cost")
        told = subprocess.run([program, "list"], capture_output=True, text=True, check=False).stdout
        result = []
        for line in told.splitlines():
            name, _, title = line.partition(" ")
            command = [program, "run", name, "-o", str(self.data), "--seed", "1"]
            command += ["--quick"] if self.quick else []
            command += ["--models", self.models] if self.models else self._archive()
            command += [] if shutil.which("gnuplot") else ["--no-figures"]
            result.append(Part(name, title.strip(), "experiment", command, [f"{name}.json", f"{name}.csv"],
                               45 if self.quick else 1200, programs=[program],
                               inputs=[self.models or self.archive]))
        return result


def from_checkout(word, source):
    """A path in the checkout as somebody in it would type it, any other word as it is."""
    return word.removeprefix(f"{Path(source)}/")


def shown(part, source, data):
    """The command as somebody in the checkout would type it, quoted for a shell."""
    words = part.command
    if words[:2] == ["sh", "-c"]:
        tool, mesh, method, tree, drawer, picture = words[4:]
        lines = [[tool, "build", mesh, "--method", method, "--no-evaluate", "-o", tree],
                 [drawer, tree, "--width", "1000", "-o", picture]]
    else:
        lines = [words]
    texts = [shlex.join(from_checkout(word, source) for word in line) for line in lines]
    if part.stdout:
        texts[-1] += f" > {shlex.quote(from_checkout(str(Path(data) / part.stdout), source))}"
    return " &&\n".join(texts)
