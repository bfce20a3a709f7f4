"""pip install .: CMake builds the module. CMAKE_ARGS in the environment has further options for it."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        source, build = Path(__file__).parent.resolve(), Path(__file__).parent.resolve() / "build" / "wheel"
        prefix = Path(self.get_ext_fullpath(extension.name)).resolve().parents[1]
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DGSP_PYTHON=ON", "-DGSP_PYTHON_FOLDER=.",
                   "-DGSP_TESTS=OFF", "-DGSP_BENCHMARKS=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
        try:
            import pybind11

            options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass  # the system's
        options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
        subprocess.check_call(["cmake", "-S", source, "-B", build, *options])
        subprocess.check_call(["cmake", "--build", build, "--target", "gsp_python", "--parallel"])
        subprocess.check_call(["cmake", "--install", build, "--component", "python", "--strip", "--prefix", prefix])


setup(ext_modules=[Extension("gsp._gsp", sources=[])], cmdclass={"build_ext": CMakeBuild})
