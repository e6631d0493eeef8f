# SPDX-License-Identifier: Zlib
"""A wheel of the package, in an environment of its own: built, installed and used without the network."""
import os
import pathlib
import subprocess
import sys
import zipfile

import pytest

import cairn
from conftest import DATA

PROJECT = pathlib.Path(__file__).resolve().parents[2] / "python"


def run(*command, **environment):
    clean = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONDEVMODE")}
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=300,
                          env=clean | environment)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_wheel_installs_and_imports_in_a_fresh_environment(tmp_path):
    for module in ("venv", "ensurepip", "setuptools", "wheel", "pip"):
        pytest.importorskip(module, reason="Debian's python3-venv, -setuptools, -wheel and -pip make wheels")
    build = pathlib.Path(cairn.__file__).parents[2]
    run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", tmp_path, PROJECT,
        CAIRN_BUILD_DIR=str(build))
    wheel, = tmp_path.glob("*.whl")
    assert wheel.name.startswith(f"cairn-{cairn.__version__}-cp3") and wheel.name.endswith("linux_x86_64.whl")
    names = zipfile.ZipFile(wheel).namelist()
    for name in ("cairn/__init__.py", "cairn/__init__.pyi", "cairn/_core.pyi", "cairn/py.typed"):
        assert name in names
    assert "cairn/LICENSE.core" in names and ("cairn/LICENSE.builder" in names) == cairn.has_builder
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "fresh")
    python = tmp_path / "fresh" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel)
    told = run(python, "-W", "error", "-c",
               f"import cairn, numpy; t = cairn.load({str(DATA / 'rock.cairn')!r}); "
               "print(cairn.__file__, len(t), cairn.has_builder, cairn.__version__)").split()
    assert told[0].startswith(str(tmp_path / "fresh"))
    assert told[1:] == [str(len(cairn.load(DATA / "rock.cairn"))), str(cairn.has_builder), cairn.__version__]
    assert not list(PROJECT.glob("build")) and not list(PROJECT.glob("*.egg-info"))
