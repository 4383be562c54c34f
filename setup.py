"""Builds the Python package's module and the program by CMake: what `pip install .` calls.

GNOMON_BUILD names a build folder to use again; without it everything is compiled, which takes minutes.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


def version():
    """The version that CMakeLists.txt has."""
    return re.search(r"project\(gnomon VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class BuildByCMake(build_ext):
    """Builds `_gnomon` and `gnomon`, and lays both beside the package's files."""

    def run(self):
        build = Path(os.environ.get("GNOMON_BUILD") or ROOT / "build" / "wheel").resolve()
        if not (build / "build.ninja").exists():
            options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=32"]
            options += ["-DGNOMON_BUILD_TESTS=OFF", "-DGNOMON_BUILD_BENCHMARKS=OFF"]
            options += [f"-DPython3_EXECUTABLE={sys.executable}"]
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "gnomon_python", "gnomon"], check=True)
        package = Path(self.build_lib) / "gnomon"
        package.mkdir(parents=True, exist_ok=True)
        for module in (build / "python" / "gnomon").glob("_gnomon*.so"):
            shutil.copy2(module, package)
        shutil.copy2(build / "bin" / "gnomon", package)


setup(
    version=version(),
    cmdclass={"build_ext": BuildByCMake},
    ext_modules=[Extension("gnomon._gnomon", sources=[])],
)
