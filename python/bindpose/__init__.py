"""Bindpose: from any triangle mesh to a shape that bends in real time.

Functions on numpy arrays and VTK datasets (PyVista's objects are VTK datasets)::

    import bindpose

    surface = bindpose.read("elephant.off")
    handles = bindpose.read_handles("elephant.tgf")
    rig = bindpose.bind(surface, handles)
    posed = rig.pose({"b4": {"rotate": {"axis": [0, 0, 1], "degrees": 30}}}, method="reduced-arap")
    bindpose.write(posed, "posed.vtp")

Every filter is also available as a VTK class (``bindpose.vtkWindingNumberField``, …), for persistent pipelines.
``bindpose.run`` turns a filter's status into an exception.

Functions that accept arrays and VTK datasets return arrays for arrays, and for a dataset a dataset of the same class.
``bindpose.report(result)`` returns the report of both types of result.
"""

import vtkmodules.vtkCommonCore as _vtk  # import VTK first, because Bindpose's libraries use its symbols

from .version import VTK_VERSION as _VTK_VERSION
from .version import __version__

_found = f"{_vtk.vtkVersion.GetVTKMajorVersion()}.{_vtk.vtkVersion.GetVTKMinorVersion()}"
if _found != _VTK_VERSION:
    raise ImportError(f"this bindpose was built for VTK {_VTK_VERSION}, but vtkmodules is VTK {_found}: {_vtk.__file__}")

from .BindposeFilters import *  # noqa: F401,F403

try:
    from .BindposeWidgets import *  # noqa: F401,F403
except ModuleNotFoundError:
    pass  # this build contains no widgets

from .crowds import crowd
from .errors import (
    BindposeError,
    BindposeWarning,
    Canceled,
    InvalidInput,
    NotConvergedWarning,
    Unavailable,
)
from .fairing import fair
from .files import Asset, read, read_asset, read_handles, write
from .functions import contains, defects, dynamics, planar_shape, tetrahedralize, weights, winding_number
from .handle_sets import automatic_handles, farthest_point_handles, handles
from .meshes import Array, PlanarShape, Tets
from .program import render
from .rigs import Rig, bind, deform, read_rig, write_rig
from .running import report, run
from .smoothing import monotone_smoothing
from .weight_uses import cut_along_bones, depth_order, endpoint_weights, transfer_weights, weighted_colors
