# SPDX-License-Identifier: Zlib
"""The vcpkg port and the Conan recipe, run as far as they go without either: with stand-ins for the two programs, on the
packages that are installed. Both must configure Cairn's libraries, name options that exist, and tell the right version.

Usage: packages_test.py
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PORT = ROOT / "packaging/vcpkg/cairn"

# What vcpkg gives to a portfile, as far as ours asks: configuring is done in earnest, the rest is noted.
STAND_INS = r"""
cmake_minimum_required(VERSION 3.25)
set(CURRENT_PACKAGES_DIR "${SCRATCH}/packages")
set(CURRENT_HOST_INSTALLED_DIR "${SCRATCH}/host")
function(vcpkg_check_features)
  cmake_parse_arguments(arg "" "OUT_FEATURE_OPTIONS" "FEATURES" ${ARGN})
  list(GET arg_FEATURES 1 option)
  set(${arg_OUT_FEATURE_OPTIONS} "-D${option}=OFF" PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(arg "" "SOURCE_PATH" "OPTIONS" ${ARGN})
  execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${arg_SOURCE_PATH} -B ${SCRATCH}/build -DCMAKE_BUILD_TYPE=Release
                          ${arg_OPTIONS} COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${SCRATCH}/options "${arg_OPTIONS}")
endfunction()
function(vcpkg_cmake_install)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(arg "" "PACKAGE_NAME;CONFIG_PATH" "" ${ARGN})
  file(WRITE ${SCRATCH}/config "${arg_CONFIG_PATH}/${arg_PACKAGE_NAME}Config.cmake")
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(arg "" "" "FILE_LIST" ${ARGN})
  foreach(file IN LISTS arg_FILE_LIST)
    if(NOT EXISTS ${file})
      message(FATAL_ERROR "there is no ${file}")
    endif()
  endforeach()
endfunction()
include(${PORT}/portfile.cmake)
"""


def version():
    text = (ROOT / "core/include/cairn/core/version.h").read_text()
    return ".".join(re.findall(r"^#define CAIRN_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text, re.M))


def known_options(build):
    """Cache entries that Cairn's own files declare; one only given on the command line has no type."""
    cache = (build / "CMakeCache.txt").read_text()
    return set(re.findall(r"^(CAIRN_\w+):(?!UNINITIALIZED)", cache, re.M))


def install_script_names(build, path):
    """Whether the build installs a file whose path ends like this."""
    return any(path.rsplit("/", 1)[-1] in script.read_text() for script in build.rglob("cmake_install.cmake"))


class Scratch(unittest.TestCase):
    def setUp(self):
        self.scratch = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.scratch)

    def run_quietly(self, *command):
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Vcpkg(Scratch):
    def test_the_manifest_tells_the_version_and_the_licence(self):
        manifest = json.loads((PORT / "vcpkg.json").read_text())
        self.assertEqual(manifest["version"], version())
        self.assertEqual(manifest["license"], "Zlib")
        self.assertRegex((PORT / "usage").read_text(), r"find_package\(cairn CONFIG REQUIRED\)")

    def test_the_port_configures_the_libraries_by_options_that_exist(self):
        flatc = self.scratch / "host/tools/flatbuffers/flatc"
        flatc.parent.mkdir(parents=True)
        flatc.symlink_to(shutil.which("flatc"))
        script = self.scratch / "run.cmake"
        script.write_text(STAND_INS)
        self.run_quietly("cmake", f"-DSCRATCH={self.scratch}", f"-DPORT={PORT}", "-P", script)
        build = self.scratch / "build"
        given = set(re.findall(r"-D(CAIRN_\w+)", (self.scratch / "options").read_text()))
        self.assertGreaterEqual(known_options(build), given)
        self.assertTrue(install_script_names(build, (self.scratch / "config").read_text()))


def stand_in_for_conan(copied):
    """The modules that the recipe imports, with a `copy` that copies in earnest and notes what."""

    def module(name, **names):
        made = types.ModuleType(name)
        vars(made).update(names)
        sys.modules[name] = made

    class Recipe:
        pass

    class Toolchain:
        def __init__(self, recipe):
            self.cache_variables = recipe.cache_variables = {}

        def generate(self):
            pass

    class Dependencies:
        def __init__(self, recipe):
            pass

        def generate(self):
            pass

    def copy(recipe, pattern, src, dst):
        folder = pattern.removesuffix("/*")
        copied.append(folder)
        if folder != pattern:
            shutil.copytree(Path(src) / folder, Path(dst) / folder)
        else:
            shutil.copy(Path(src) / pattern, dst)

    module("conan", ConanFile=Recipe)
    module("conan.tools")
    module("conan.tools.cmake", CMake=None, CMakeDeps=Dependencies, CMakeToolchain=Toolchain, cmake_layout=None)
    module("conan.tools.files", copy=copy)


class Conan(Scratch):
    def recipe(self):
        self.copied = []
        stand_in_for_conan(self.copied)
        names = {"__file__": str(ROOT / "packaging/conan/conanfile.py"), "__name__": "conanfile"}
        exec(compile((ROOT / "packaging/conan/conanfile.py").read_text(), names["__file__"], "exec"), names)
        recipe = names["CairnRecipe"]()
        recipe.export_sources_folder = str(self.scratch / "sources")
        recipe.options = types.SimpleNamespace(**recipe.default_options)
        Path(recipe.export_sources_folder).mkdir()
        return recipe

    def test_it_tells_the_version(self):
        recipe = self.recipe()
        recipe.set_version()
        self.assertEqual(recipe.version, version())

    def test_what_it_exports_is_enough_to_configure_the_libraries(self):
        recipe = self.recipe()
        recipe.export_sources()
        recipe.generate()
        build = self.scratch / "build"
        options = [f"-D{name}={'ON' if on else 'OFF'}" for name, on in recipe.cache_variables.items()]
        self.run_quietly("cmake", "-G", "Ninja", "-S", recipe.export_sources_folder, "-B", build, "-DCMAKE_BUILD_TYPE=Release", *options)
        self.assertGreaterEqual(known_options(build), set(recipe.cache_variables))
        targets = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], capture_output=True, text=True).stdout
        for part in ("core", "bullet", "effects", "c"):
            self.assertIn(f"libcairn_{part}.a", targets)


if __name__ == "__main__":
    unittest.main()
