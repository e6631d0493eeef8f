# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the code of docs/python.md as it stands there, one block after the other. This needs the builder."""
import pathlib
import sys

import cairn

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "snippets"))
import snippets  # noqa: E402
from conftest import ball, write_obj  # noqa: E402


def test_the_code_of_the_page_runs(tmp_path, monkeypatch):
    page = ROOT / "docs" / "python.md"
    blocks = [block for block in snippets.blocks_of("docs/python.md", page.read_text()) if block.language == "python"]
    assert len(blocks) >= 6
    monkeypatch.chdir(tmp_path)
    write_obj(tmp_path / "rock.obj", *ball(8))
    names = {}
    for block in blocks:
        assert not block.reason, f"{block.place}: Python is always run"
        exec(compile("\n" * (block.line - 1) + block.text, str(page), "exec"), names)
    # What the page promises is there afterwards.
    assert isinstance(names["tree"], cairn.SphereTree) and (tmp_path / "rock.cairn").stat().st_size > 1000
    assert names["proof"].proven and names["cancelled"]
