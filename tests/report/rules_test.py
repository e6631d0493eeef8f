#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""By what rules the report keeps, shows and concludes, without running anything."""
import re
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "demos/report"))


class Keys(unittest.TestCase):
    """What an earlier run left is kept while all it depends on is the same, by content."""

    def test_turn_with_options_programs_meshes_and_processor(self):
        import keys
        with tempfile.TemporaryDirectory() as folder:
            program, meshes, machine = Path(folder) / "program", Path(folder) / "meshes", {"CPU": "one", "Cores": "2"}
            meshes.mkdir()

            def key(options="--seed 1", about=None):
                return keys.key_of([str(program), options], [str(program), str(meshes)], about or machine)

            def written(file, text):
                file.write_text(text, encoding="utf-8")
                return key()

            seen = [key(), written(program, "first"), written(program, "other"), written(meshes / "a.obj", "v 0 0 0"),
                    written(meshes / "a.obj", "v 0 0 1"), written(meshes / "b.obj", "v 0 0 1"), key("--seed 2"),
                    key(about={"CPU": "another", "Cores": "2"})]
            last = key()
            (meshes / "b.obj").rename(meshes / "c.obj")
            seen.append(key())
            self.assertEqual(len(set(seen)), len(seen))
            (meshes / "c.obj").rename(meshes / "b.obj")
            self.assertEqual(key(), last, "nothing but content and names counts")


class Tables(unittest.TestCase):
    def test_a_mesh_may_be_called_like_a_number(self):
        import tables
        rows = [{"model": name, "error_fraction": "0.5"} for name in ("nan", "1e5")]
        self.assertEqual([row[0] for row in tables.from_rows(rows, "", 9).rows], ["nan", "1e5"])


class Conclusions(unittest.TestCase):
    """Verdicts turn with the claims."""

    @staticmethod
    def verdict(*holds):
        import conclusions
        first = conclusions.all_conclusions()[0]
        claims = [{"thesis": p.claim, "rule": "r", "found": "f", "holds": h, "standing": "holds" if h else "does not hold"} for p, h in zip(first.points, holds) if h is not None]
        return conclusions.judged({"sampling": {"document": {"claims": claims}, "rows": []}})[0]

    def test_turn_with_the_claims(self):
        self.assertEqual(self.verdict(True, True, True).verdict, "reproduced")
        self.assertEqual(self.verdict(True, False, True).verdict, "reproduced in part")
        self.assertEqual(self.verdict(False, False, False).verdict, "not reproduced")
        self.assertEqual(self.verdict(None, None, None).verdict, "not measured")
        self.assertEqual(self.verdict(True, None, True).told(), "of 3 points 2 hold, 1 is not measured")
        self.assertEqual(self.verdict(True, None, True).verdict, "reproduced in part", "what was not measured was not found again")
        self.assertEqual(self.verdict(None, False, None).verdict, "not decided", "what was not measured could hold")

    def test_what_names_a_model_that_was_not_measured_is_not_known(self):
        import conclusions
        third = conclusions.all_conclusions()[2]
        claims = [{"thesis": p.claim, "rule": "r", "found": "f", "holds": True, "standing": "holds"} for p in third.points if p.claim]
        claims[0] |= {"standing": "holds in part", "lacking_text": "only 1 of 2 models measured (without dragon)"}
        settled = conclusions.judged({name: {"document": {"claims": claims}, "rows": []} for name in ("levels", "balance")})[2]
        self.assertEqual((settled.verdict, settled.told()), ("reproduced in part", "of 3 points 2 hold, 1 holds on what was measured"))
        self.assertEqual(settled.points[0].standing, "holds in part")
        self.assertIn("without dragon", settled.points[0].found)
        claims[0] |= {"holds": False, "standing": "not decided"}
        alone = conclusions.judged({"levels": {"document": {"claims": claims[:1]}, "rows": []}})[2]
        self.assertEqual(alone.verdict, "not decided")

    def test_claims_are_those_the_experiments_make(self):
        """A claim reworded in an experiment would silently leave the summary."""
        import conclusions
        texts = "".join(f.read_text(encoding="utf-8") for f in (SOURCE / "demos/accuracy_cost/experiments").glob("*.cpp"))
        joined = re.sub(r'"\s*\n\s*"', "", texts)
        for conclusion in conclusions.all_conclusions():
            for point in conclusion.points:
                if point.claim:
                    self.assertIn(f'"{point.claim}', joined)

    def test_read_tables(self):
        import conclusions
        rows = [{"model": "m", "construction": c, "interruption": at, "hubbard_worst_ratio": str(h), "octree_worst_ratio": str(o)}
                for c, at, h, o in (("grid", "500", 1, 0.5), ("hybrid", "500", 1, 0.25), ("cairn adaptive", "500", 0.6, 1), ("cairn adaptive", "1000", 0.4, 1),
                                    ("combined", "500", 1.0, 1), ("combined optimised", "500", 0.5, 1), ("combined", "completion", 0.4, 1),
                                    ("combined optimised", "completion", 0.6, 1), ("cairn adaptive", "completion", 0.1, 1))]
        self.assertEqual(conclusions.own_interrupted(rows)[0], True)
        self.assertIn("40 %", conclusions.own_interrupted(rows)[1], "completion is no interruption")
        self.assertEqual(conclusions.early_gain(rows)[0], True)
        self.assertIsNone(conclusions.early_gain(rows[:4]))

    def test_our_second_level_goes_by_the_rule_of_the_thesiss(self):
        import conclusions

        def judged(*errors):
            rows = []
            for model, error in errors:
                rows += [{"model": model, "construction": "hubbard", "level": "3", "sampled_max_fraction": "0.1"},
                         {"model": model, "construction": "cairn combined", "level": "2", "sampled_max_fraction": str(error)}]
            settled = conclusions.judged({"levels": {"document": {"default_models": ["bunny", "dragon", "cow"]}, "rows": rows}})[2]
            return next(p for p in settled.points if p.judge is conclusions.own_second_level)
        self.assertEqual(judged(("bunny", 0.124), ("dragon", 0.1)).standing, "holds", "the cow is not what it is about")
        self.assertEqual(judged(("bunny", 0.126), ("dragon", 0.1)).standing, "does not hold", "one of the two is not enough")
        self.assertEqual(judged(("bunny", 0.1), ("dragon", 0.1), ("cube", 1)).standing, "holds", "of bunny and dragon alone")
        self.assertEqual(judged(("bunny", 0.1), ("cube", 1)).standing, "holds in part", "of both, or it is not known")
        self.assertIn("not measured on dragon", judged(("bunny", 0.1)).found)
        self.assertEqual(judged(("bunny", 0.2)).standing, "does not hold", "one is enough to refute it")
        self.assertEqual(judged(("cube", 0.1)).standing, "not measured")
        texts = (SOURCE / "demos/accuracy_cost/experiments/levels.cpp").read_text(encoding="utf-8")
        self.assertIn(f"kAboutTheSame = {conclusions.ABOUT_THE_SAME};", texts)

    def test_cover_the_four_conclusions_and_no_point_of_the_thesis_has_a_softer_rule(self):
        """Where an experiment claims the same, the point is its claim."""
        import conclusions
        claimed = {p.claim for c in conclusions.all_conclusions() for p in c.points}
        for claim in ("merge's second level is about as tight as Hubbard's third for bunny and dragon",
                      "as many as two fifths of the spheres are thrown away at 105 %, the error being pretty much the same",
                      "optimised medial-axis trees have as little as 20 % of the error of Hubbard's when interrupted",
                      "combined comes down to 50 % of Hubbard's worst error for bunny and dragon",
                      "grid has as little as 20 % of the octree's error when interrupted",
                      "grid and hybrid quickly drop to 10 % of the octree's worst error for all models",
                      "as little as 20 % as many pairs of colliding spheres are found as with Hubbard's trees for bunny and dragon",
                      "hybrid improves on grid"):
            self.assertIn(claim, claimed)
        own = [p.judge.__name__ for c in conclusions.all_conclusions() for p in c.points if p.judge and not p.own]
        self.assertEqual(own, ["early_gain"], "the one thing no experiment claims")


if __name__ == "__main__":
    unittest.main(verbosity=2)
