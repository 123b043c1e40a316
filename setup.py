"""The wheel of the Python module: CMake builds the extension, for the Python that runs this. See PYTHON.md."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent
WORK = SOURCE / "build" / "wheel"  # as deep as build/release: a compiler cache sees the same relative paths
FRESH = WORK / "setuptools"  # made anew: else a wheel would also have what an older one left there


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        subprocess.run(["cmake", "-S", SOURCE, "-B", WORK, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_UNITY_BUILD=ON", "-DBUILD_SHARED_LIBS=OFF", "-DVDBCAGE_BUILD_TESTS=OFF",
                        "-DVDBCAGE_BUILD_VIEW=OFF", f"-DVDBCAGE_PYTHON={sys.executable}",
                        *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", WORK, "--target", "vdbcage_python"], check=True)
        built = pathlib.Path(self.get_ext_fullpath(extension.name))
        built.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(WORK / "python" / "vdbcage" / built.name, built)


shutil.rmtree(FRESH, ignore_errors=True)
FRESH.mkdir(parents=True)
setup(
    version=re.search(r'VDBCAGE_VERSION "(.*)"', (SOURCE / "vdbcage" / "core" / "version.h").read_text())[1],
    packages=["vdbcage"],
    package_dir={"vdbcage": "tools/python/vdbcage"},
    package_data={"vdbcage": ["py.typed"]},
    ext_modules=[Extension("vdbcage._vdbcage", [])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": str(FRESH)}, "egg_info": {"egg_base": str(FRESH)}},
)
