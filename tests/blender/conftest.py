"""Make the driver of the command-line program importable."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "viewer" / "cli"))
