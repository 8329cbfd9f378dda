"""Run the program `bindpose`: `python3 -m bindpose`."""

import os
import sys

from .errors import Unavailable
from .program import program_path

try:
    path = program_path()
except Unavailable as error:
    sys.exit(f"bindpose: {error}")
os.execv(path, [path, *sys.argv[1:]])
