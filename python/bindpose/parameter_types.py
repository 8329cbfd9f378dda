"""Types of parameters that several functions have, for type checkers."""

import os
from collections.abc import Callable
from typing import Optional, Union

from numpy.typing import ArrayLike
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

Path = Union[str, "os.PathLike[str]"]
Mesh = Union[vtkDataSet, tuple[ArrayLike, ArrayLike]]
Handles = Union[vtkPolyData, Path]
Drawable = Union[Mesh, Path]
Progress = Optional[Callable[[float, str], object]]
