# SPDX-License-Identifier: Zlib
"""Cairn's libraries for Conan 2, from this checkout: `conan create packaging/conan`."""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

ROOT = Path(__file__).resolve().parents[2]
# What a build of the libraries reads.
EXPORTED = ("CMakeLists.txt", "cmake/*", "core/*", "plugin/*")


class CairnRecipe(ConanFile):
    name = "cairn"
    license = "Zlib"
    description = "Collision detection that keeps its deadline: certified sphere-trees for Bullet"
    topics = ("collision-detection", "physics", "bullet", "sphere-tree", "real-time")
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False], "double_precision": [True, False]}
    default_options = {"shared": False, "fPIC": True, "double_precision": False}
    package_type = "library"

    def set_version(self):
        text = (ROOT / "core/include/cairn/core/version.h").read_text()
        self.version = ".".join(re.findall(r"^#define CAIRN_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text, re.M))

    def export_sources(self):
        for pattern in EXPORTED:
            copy(self, pattern, src=str(ROOT), dst=self.export_sources_folder)

    def config_options(self):
        if self.settings.os == "Windows":
            del self.options.fPIC

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")
        self.options["bullet3"].double_precision = self.options.double_precision

    def requirements(self):
        self.requires("bullet3/3.25", transitive_headers=True, transitive_libs=True)
        self.requires("highway/1.0.3")
        self.requires("flatbuffers/23.5.26")

    def build_requirements(self):
        self.tool_requires("flatbuffers/<host_version>")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in ("BUILDER", "DEMOS", "TESTS", "PYTHON"):
            toolchain.cache_variables[f"CAIRN_{part}"] = False
        toolchain.cache_variables["CAIRN_DOUBLE_PRECISION"] = bool(self.options.double_precision)
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        suffix = "-float64" if self.options.double_precision else ""
        self.cpp_info.set_property("cmake_file_name", f"cairn{suffix}")
        parts = {"core": ["highway::highway"], "bullet": ["core", "bullet3::bullet3"], "effects": ["bullet"], "c": ["bullet"]}
        for part, requires in parts.items():
            component = self.cpp_info.components[part]
            component.set_property("cmake_target_name", f"cairn::{part}")
            component.libs = [f"cairn_{part}{suffix}"]
            component.requires = requires
            if self.options.shared:
                component.defines = ["CAIRN_SHARED"]
