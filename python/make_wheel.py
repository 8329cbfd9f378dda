#!/usr/bin/env python3
"""Make a wheel of the Python package from an install tree. The wheel contains the package,
its libraries and the programs.

    cmake --install build --prefix PREFIX
    python3 python/make_wheel.py PREFIX --output dist
    pip install --no-index --no-deps dist/bindpose-*.whl        # into an environment with VTK and NumPy

The wheel works with this version of Python, and with VTK of the same minor version as in the build. Install it into a virtual
environment that uses the system's packages (python3 -m venv --system-site-packages).

Needs the Debian packages python3-build, python3-setuptools and python3-wheel.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

SETUP = """\
from setuptools import Distribution, setup


class BinaryDistribution(Distribution):
    def has_ext_modules(self):
        return True  # the wheel depends on the processor and on the version of Python


setup(name="bindpose", version={version!r}, packages=["bindpose"], package_data={{"bindpose": ["*"]}},
      data_files={data!r}, entry_points={entry_points!r}, distclass=BinaryDistribution)
"""
BUILD_SYSTEM = '[build-system]\nrequires = ["setuptools", "wheel"]\nbuild-backend = "setuptools.build_meta"\n'


def stage(prefix, folder):
    """Write the sources of the wheel: copies of the files of the install tree, and setup.py.

    The wheel needs no other run paths than the install tree: in both, the package is three folders below the libraries.
    """
    package = next(prefix.glob("lib*/**/dist-packages/bindpose"), None)
    if package is None:
        sys.exit(f"make_wheel.py: there is no Python package in {prefix}; run cmake --install build --prefix {prefix}")
    metadata = next(package.parent.glob("bindpose-*.dist-info"))
    version = metadata.name.removeprefix("bindpose-").removesuffix(".dist-info")
    shutil.copytree(package, folder / "bindpose", ignore=shutil.ignore_patterns("__pycache__"))
    data = []
    for target, files in (("lib", package.parents[2].glob("libBindpose*.so.*")), ("bin", (prefix / "bin").glob("bindpose*"))):
        (folder / target).mkdir()
        names = [shutil.copy(file, folder / target) for file in files if not file.is_symlink()]
        data.append((target, [str(pathlib.Path(name).relative_to(folder)) for name in names]))
    entry_points = (metadata / "entry_points.txt").read_text(encoding="utf-8")
    (folder / "setup.py").write_text(SETUP.format(version=version, data=data, entry_points=entry_points), encoding="utf-8")
    (folder / "pyproject.toml").write_text(BUILD_SYSTEM, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("prefix", type=pathlib.Path, help="install tree")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("dist"), help="folder of the wheel (default: dist)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        stage(options.prefix.resolve(), pathlib.Path(folder))
        command = [sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", options.output.resolve(), folder]
        sys.exit(subprocess.run(command, check=False).returncode)


if __name__ == "__main__":
    main()
