"""Load a state that the window has saved and write the bent points, for window.py: pvbatch posed_state.py PLUGIN STATE OUT."""

import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))
simple.LoadState(sys.argv[2])
bent = simple.FindSource("bent")
bent.UpdatePipeline()
np.save(sys.argv[3], vtk_to_numpy(servermanager.Fetch(bent).GetPoints().GetData()))
