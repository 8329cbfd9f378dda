"""Bindpose: from any triangle mesh to a shape that bends in real time."""

import vtkmodules.vtkCommonCore  # noqa: F401  VTK first: our library finds its symbols there

from .BindposeFilters import *  # noqa: F401,F403
