# SPDX-License-Identifier: Zlib
"""Makes a wheel of the package, with setuptools because Debian's is enough for it and CMake knows the rest.

    pip wheel --no-deps python                                             compiles everything first
    CAIRN_BUILD_DIR=build/release pip wheel --no-deps python               takes what a build folder has
    CAIRN_BUILDER=OFF pip wheel --no-deps python                           without the builder: zlib licence alone
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent


def version():
    text = (PROJECT / "core/include/cairn/core/version.h").read_text()
    return ".".join(re.search(rf"CAIRN_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def compiled(folder):
    """Configures and builds the package in a folder of its own."""
    options = {"CMAKE_BUILD_TYPE": "Release", "CAIRN_PYTHON": "ON", "CAIRN_BUILDER": os.environ.get("CAIRN_BUILDER", "ON"),
               "CAIRN_PLUGIN": "OFF", "CAIRN_DEMOS": "OFF", "CAIRN_TESTS": "OFF", "Python_EXECUTABLE": sys.executable}
    subprocess.run(["cmake", "-G", "Ninja", "-S", PROJECT, "-B", folder, *(f"-D{k}={v}" for k, v in options.items())],
                   check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "cairn_python"], check=True)
    return folder


class CMakeBuild(build_ext):
    def run(self):
        if self.inplace:
            sys.exit("cairn cannot be installed in place; build with CMake and set PYTHONPATH to python/ of the build folder")
        given = os.environ.get("CAIRN_BUILD_DIR")
        package = (pathlib.Path(given) if given else compiled(pathlib.Path(self.build_temp).resolve())) / "python" / "cairn"
        modules = sorted(package.glob("_*.so"))
        if not modules:
            sys.exit(f"{package} has no modules; build the target cairn_python first")
        target = pathlib.Path(self.build_lib) / "cairn"
        target.mkdir(parents=True, exist_ok=True)
        for module in modules:
            shutil.copy2(module, target)
        shutil.copy(PROJECT / "core/LICENSE", target / "LICENSE.core")
        if any(module.name.startswith("_builder") for module in modules):
            shutil.copy(PROJECT / "builder/LICENSE", target / "LICENSE.builder")


with tempfile.TemporaryDirectory() as scratch:  # so that the sources stay clean
    setup(name="cairn", version=version(), description="Certified sphere-trees of meshes, and covers by spheres, with proofs",
          license="zlib (cairn._core), GPL-3.0-or-later (cairn._builder)", python_requires=">=3.9", install_requires=["numpy"],
          packages=["cairn"], package_data={"cairn": ["py.typed", "*.pyi"]}, ext_modules=[Extension("cairn._core", [])],
          cmdclass={"build_ext": CMakeBuild},
          options={"egg_info": {"egg_base": scratch}, "build": {"build_base": scratch}})
