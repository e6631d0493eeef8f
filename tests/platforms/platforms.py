# SPDX-License-Identifier: Zlib
"""The platforms: how each is built, what runs its programs, and which tests are left out there, with the reason."""
import dataclasses
import re

# Trials by the thousand and figures of front ends, which neither a compiler nor a processor decides. The preset `double`
# leaves them out as well. On emulated processors they take hours.
LONG = r"NoneOfAThousand|HardlyAnyGoesThrough|FrontEnd_Quality"


@dataclasses.dataclass(frozen=True)
class Platform:
    name: str
    preset: str
    packages: str  # the group in cmake/packages-debian.txt
    what: str
    runner: tuple = ()  # what starts a program of that platform
    suffix: str = ""  # of its programs
    environment: tuple = ()  # pairs
    left_out: tuple = ()  # pairs of a pattern of test names and the reason

    def leaves_out(self, test):
        return any(re.search(pattern, test) for pattern, _ in self.left_out)


PLATFORMS = {p.name: p for p in (
    Platform("wasm", "wasm", "wasm", "WebAssembly: Emscripten, Node",
             # This Emscripten takes a Node that has `fetch` for a browser.
             runner=("node", "--no-experimental-fetch"), suffix=".js",
             left_out=((LONG, "long"),
                       (r"^WorkerThreads|^PosixFiles.Pipe_", "there are no threads"),
                       (r"\.IsToldOnce$|^SphereTreeShape_(Margin|Scaling).*(Refused|Children)|^Terrain.RefusesToBe|^CLog",
                        "what goes to standard error cannot be read back"),
                       (r"^ConvexSurface_AnyShape.LiesBehind",
                        "Bullet's own penetration of multi-spheres, the judge, fails once in its trials"))),
    Platform("arm64", "arm64", "arm64", "ARM64 Linux: GCC, qemu-user",
             runner=("qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"),
             left_out=((LONG, "long"), (r"^Unserved\.", "the emulator starts no second program of its processor"))),
    Platform("windows", "windows", "windows", "Windows x86-64: MinGW-w64, Wine",
             runner=("wine",), suffix=".exe",
             environment=(("WINEDEBUG", "-all"), ("DISPLAY", ""), ("WINEDLLOVERRIDES", "mscoree,mshtml=")),
             left_out=((LONG, "long"),
                       (r"^Sines.AreWithinTheirStatedError$", "the judge, that system's sine of doubles, errs more"))),
    Platform("libcxx", "libcxx", "libcxx", "Linux x86-64: Clang, libc++", left_out=((LONG, "long"),)),
    Platform("clang", "clang", "libcxx", "Linux x86-64: Clang, libstdc++", left_out=((LONG, "long"),)),
)}
