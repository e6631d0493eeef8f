# SPDX-License-Identifier: GPL-3.0-or-later
"""The conclusions of the thesis's section 8.1 beside what the experiments found. Nothing here is a judgement of its own:
a point holds when the claim of an experiment it names does, or by a rule that stands beside it on the page."""
from dataclasses import dataclass, field

REPRODUCED, IN_PART, NOT, UNKNOWN = "reproduced", "reproduced in part", "not reproduced", "not measured"
UNDECIDED = "not decided"  # by what was measured; the rest could turn it
HOLDS, HOLDS_IN_PART, HOLDS_NOT = "holds", "holds in part", "does not hold"  # in part: on what was measured, which is not all it is about


def told(standings, noun):
    """How points or claims stand, in words."""
    words = {HOLDS: "{n} hold{s}", HOLDS_IN_PART: "{n} hold{s} on what was measured", HOLDS_NOT: "{n} do{es} not hold", UNDECIDED: "{n} {is} not decided",
             UNKNOWN: "{n} {is} not measured"}
    counts = [(standings.count(standing), word) for standing, word in words.items() if standing in standings]
    said = ", ".join(word.format(n=n, s="s" if n == 1 else "", es="es" if n == 1 else "", **{"is": "is" if n == 1 else "are"}) for n, word in counts)
    return f"of {len(standings)} {noun}{'' if len(standings) == 1 else 's'} {said}"


@dataclass
class Point:
    """One thing a conclusion says."""
    says: str
    experiment: str
    claim: str = ""  # text of the experiment's claim that decides it
    judge: object = None  # else: rows of its table -> (holds, what was found), or nothing
    rule: str = ""
    models: tuple = ()  # those `judge` is about; none: all of the experiment's
    of_every: bool = False  # `judge` is of each of them: one is enough to refute it
    own: bool = False  # about what the thesis has not; it does not count towards the verdict
    standing: str = UNKNOWN
    found: str = ""  # or, of what was not measured, why not


@dataclass
class Conclusion:
    number: int
    title: str
    thesis: str  # the thesis's own words
    points: list = field(default_factory=list)
    verdict: str = UNKNOWN

    def told(self):
        return told([p.standing for p in self.points if not p.own], "point")


# As in the experiments: the scans the thesis draws conclusions from, and what counts as "about the same" error.
SCANS, ABOUT_THE_SAME = ("bunny", "dragon"), 1.25


def _number(row, column):
    try:
        return float(row[column])
    except (KeyError, TypeError, ValueError):
        return float("nan")


def _least(rows, column, constructions):
    """The least value of a column by model, with construction and interruption; completion is none."""
    best = {}
    for row in rows:
        value = _number(row, column)
        if row.get("construction") in constructions and row.get("interruption") != "completion" and value == value:
            model = row["model"]
            if model not in best or value < best[model][0]:
                best[model] = (value, row["construction"], row["interruption"])
    return best


def _told(best):
    return ", ".join(f"{model} {100 * value:.0f} % ({construction}, after {at})" for model, (value, construction, at) in best.items())


def _in_part(lacking, found):
    return f"not measured on {' and '.join(lacking)}, which it names (--quick and missing archives leave models out); measured: {found}"


def own_interrupted(rows):
    best = _least(rows, "hubbard_worst_ratio", ("cairn adaptive",))
    if not best:
        return None
    return max(value for value, _, _ in best.values()) <= 0.5, f"worst error of our adaptive trees, of Hubbard's: {_told(best)}"


def own_second_level(rows):
    """Our methods' second level against Hubbard's third, by the rule of the experiment's claim about merge."""
    worst = {(r["model"], r["construction"], r["level"]): _number(r, "sampled_max_fraction") for r in rows}
    found, holds = [], []
    for model in [m for m in dict.fromkeys(r["model"] for r in rows) if m in SCANS]:
        third = worst.get((model, "hubbard", "3"))
        ours = {c: worst.get((model, c, "2")) for c in ("cairn combined", "cairn adaptive")}
        ours = {c: v for c, v in ours.items() if v is not None}
        if not third or not ours:
            continue
        construction = min(ours, key=ours.get)
        found.append(f"{model} {ours[construction] / third:.2f} ({construction})")
        holds.append(ours[construction] <= ABOUT_THE_SAME * third)
    if not holds:
        return None
    return all(holds), f"worst error of our level 2 over that of Hubbard's level 3: {', '.join(found)}"


def early_gain(rows):
    """Optimised over plain combined, at the first interruption and at completion."""
    at = {(r["model"], r["construction"], r["interruption"]): _number(r, "hubbard_worst_ratio") for r in rows}
    first = min((int(r["interruption"]) for r in rows if r["interruption"].isdigit()), default=None)
    found, holds = [], []
    for model in dict.fromkeys(r["model"] for r in rows):
        ratios = []
        for when in (str(first), "completion"):
            plain, lean = (at.get((model, c, when)) for c in ("combined", "combined optimised"))
            if not plain or not lean:
                break
            ratios.append(lean / plain)
        if len(ratios) == 2:
            found.append(f"{model} {ratios[0]:.2f} after {first} operations, {ratios[1]:.2f} at completion")
            holds.append(ratios[0] < ratios[1])
    if not holds:
        return None
    return sum(holds) * 2 > len(holds), f"worst error with spheres dropped over that without: {'; '.join(found)}"


def all_conclusions():
    return [
        Conclusion(1, "The adaptive medial axis covers, and evens out the error",
                   "The use of the adaptive medial axis approximation algorithm provides noticeable improvements. This algorithm "
                   "allows a medial axis approximation to be constructed which guarantees to cover the surface. While the initial "
                   "approximation is sometimes not as tight fitting as previous algorithms, the approximation quickly improves. The "
                   "resulting sets of spheres produce tighter fitting approximations and more evenly distribute the error between them.",
                   [Point("It covers the surface", "sampling", "the adaptive algorithm covers the whole surface, where regular sampling leaves some of it out"),
                    Point("Its sets fit tighter", "sampling", "the adaptive algorithm generally has the lower worst error at equal samples"),
                    Point("It spreads the error more evenly", "sampling", "the adaptive algorithm often has the lower variance")]),
        Conclusion(2, "Better enclosing balls and measures of fit help",
                   "The use of more accurate bounding sphere algorithms and sphere fit metrics provides benefits when reducing the "
                   "number of spheres in an approximation. [...] Also, the approximations often exhibit a higher level of consistency. "
                   "The Expand algorithm produces approximations with near zero variance across the entire region being approximated.",
                   [Point("Merge errs less than Hubbard's merging", "reductions", "merge has a lower worst error than Hubbard's for all models"),
                    Point("Its sets are more consistent", "reductions", "merge also lowers the RMS error and the variance"),
                    Point("Expand has near zero variance", "reductions", "expand has the lowest variance, near zero where the solid is convex")]),
        Conclusion(3, "A level less for the same fit, and fewer spheres",
                   "Using the improved approximation techniques for the construction of sphere-trees produces considerable benefit for "
                   "non-trivial objects. Even for complicated models, the second level of the sphere-trees has a similar error to the "
                   "third level of the trees constructed using existing techniques, i.e. the same tightness of fit with almost an order "
                   "of magnitude less spheres. [...] By allowing the algorithm to tolerate a small increase in error, the number of "
                   "spheres in the approximation can be significantly reduced.",
                   [Point("Merge's level 2 is about as tight as Hubbard's level 3 (bunny, dragon)", "levels", "merge's second level is about as tight as Hubbard's third for bunny and dragon"),
                    Point("So is level 2 of our own methods (bunny, dragon)", "levels", judge=own_second_level, models=SCANS, of_every=True, own=True,
                          rule=f"for each of the two the better of ours has at most {ABOUT_THE_SAME} times the worst error"),
                    Point("At 5 % more error up to two fifths of the spheres go", "balance", "as many as two fifths of the spheres are thrown away at 105 %, the error being pretty much the same"),
                    Point("The error stays pretty much the same", "balance", "at 105 % the approximations contain pretty much the same error as unoptimised ones")]),
        Conclusion(4, "Interrupted collision detection errs less",
                   "The sphere-trees, generated with the new algorithms, do show significant benefits to the process of collision "
                   "detection. [...] sphere-trees generated with the GRID algorithm show as low as 20% the error observed for the Octree "
                   "based trees. The sphere-trees generated with the optimised medial axis method show as little as 20% the error of "
                   "Hubbard's algorithm when interruption occurs. Combining both classes [...] to produce a hybrid sphere-tree, produced "
                   "further improvements over the GRID algorithm. The sphere-trees produced with the improved algorithms also reduce the "
                   "number of colliding pairs [...]. Dynamically choosing the branching factor of the hierarchy shows most improvement "
                   "when interruption occurs early on.",
                   [Point("As little as 20 % of Hubbard's error", "interruption", "optimised medial-axis trees have as little as 20 % of the error of Hubbard's when interrupted"),
                    Point("Half of Hubbard's worst error on scans (7.2)", "interruption", "combined comes down to 50 % of Hubbard's worst error for bunny and dragon"),
                    Point("Our own adaptive trees likewise", "interruption", judge=own_interrupted, of_every=True, own=True, rule="at most 50 % for every model"),
                    Point("Grid as little as 20 % of the octree's", "interruption", "grid has as little as 20 % of the octree's error when interrupted"),
                    Point("Grid and hybrid quickly down to 10 % of it, for all models (7.2)", "interruption",
                          "grid and hybrid quickly drop to 10 % of the octree's worst error for all models"),
                    Point("Hybrid improves on grid", "interruption", "hybrid improves on grid"),
                    Point("As few as 20 % of the colliding pairs", "interruption", "as little as 20 % as many pairs of colliding spheres are found as with Hubbard's trees for bunny and dragon"),
                    Point("Dropping spheres helps most when stopped early", "interruption", judge=early_gain,
                          rule="for more than half of the models the ratio is lower at the first interruption than at completion")]),
    ]


def _settle(point, experiment):
    """How a point stands, by the experiment it names."""
    if experiment is None:
        point.found = f"the experiment {point.experiment} is not in this report"
    elif point.judge:
        _settle_by_table(point, experiment)
    else:
        _settle_by_claim(point, experiment["document"].get("claims", []))


def _settle_by_table(point, experiment):
    answer = point.judge(experiment["rows"])
    if answer is None:
        point.found = "its table has not what it takes (--quick measures less)"
        return
    holds, point.found = answer
    if holds is None:
        return
    measured = {row["model"] for row in experiment["rows"]}
    lacking = [m for m in point.models or experiment["document"].get("default_models", []) if m not in measured]
    if lacking and (holds or not point.of_every):
        point.standing = HOLDS_IN_PART if holds else UNDECIDED
        point.found = _in_part(lacking, point.found)
    else:
        point.standing = HOLDS if holds else HOLDS_NOT


def _settle_by_claim(point, claims):
    for claim in claims:
        if claim["thesis"] == point.claim:
            point.standing, point.found, point.rule = claim["standing"], claim["found"], claim["rule"]
            if point.standing in (HOLDS_IN_PART, UNDECIDED):
                point.found = f"{claim['lacking_text']}; measured: {claim['found']}"
            return
    point.found = f"the experiment {point.experiment} has not measured it (--quick measures less)"


def _verdict(standings):
    """Of a conclusion, by how its points stand."""
    if all(s == HOLDS for s in standings):
        return REPRODUCED
    if HOLDS in standings or HOLDS_IN_PART in standings:
        return IN_PART
    if all(s == UNKNOWN for s in standings):
        return UNKNOWN
    return NOT if all(s == HOLDS_NOT for s in standings) else UNDECIDED


def judged(experiments):
    """All conclusions with their verdicts. `experiments`: by name, {"document": its JSON, "rows": its table}."""
    result = all_conclusions()
    for conclusion in result:
        for point in conclusion.points:
            _settle(point, experiments.get(point.experiment))
        conclusion.verdict = _verdict([p.standing for p in conclusion.points if not p.own])
    return result
