"""The plugin for PyVista 0.48 and later: ``mesh.bindpose``, and readers and writers of file formats.

PyVista imports this module when it is needed: the first time that ``mesh.bindpose`` or a file name extension of the package is
used. The entry points of the package (``pyvista.accessors``, ``pyvista.readers``, ``pyvista.writers``) name it.
"""

import functools
import inspect

import pyvista
from pyvista.core.utilities.reader_registry import LocalFileRequiredError, has_scheme

from . import files, functions, program, rigs
from .errors import InvalidInput


def _method(function):
    """Return a method of the accessor that passes its mesh as the first argument of a function."""
    @functools.wraps(function)
    def method(self, *arguments, **keywords):
        return function(self._mesh, *arguments, **keywords)  # pylint: disable=protected-access

    signature = inspect.signature(function)
    _mesh, *others = signature.parameters.values()
    first = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    method.__signature__ = signature.replace(parameters=[first, *others])
    return method


class Accessor:
    """The functions of Bindpose for a dataset of PyVista: ``mesh.bindpose.tetrahedralize()``.

    Datasets in results are datasets of PyVista. Each method has the documentation of the function of the same name.
    """

    def __init__(self, mesh):
        self._mesh = mesh

    winding_number = _method(functions.winding_number)
    contains = _method(functions.contains)
    tetrahedralize = _method(functions.tetrahedralize)
    defects = _method(functions.defects)
    weights = _method(functions.weights)
    deform = _method(rigs.deform)
    bind = _method(rigs.bind)

    def render(self, *others, **options):
        """Make a picture of the mesh, and of other meshes beside it; see `bindpose.render`."""
        return program.render(self._mesh, *others, **options)


pyvista.register_dataset_accessor("bindpose", pyvista.DataSet)(Accessor)


def _check(path, options):
    """Refuse options, and ask PyVista for a local copy of a remote file."""
    if options:
        raise InvalidInput(f"{path}: unexpected option {next(iter(options))!r}; this format has no options")
    if has_scheme(path):
        raise LocalFileRequiredError


def read(path, **options):
    """Read a .off or .mesh (MEDIT) file for `pyvista.read`.

    Files without triangles and tets are left to meshio, which PyVista uses without this plugin. Other cells of mixed files
    are ignored.
    """
    _check(path, options)
    data, failure = None, None
    try:
        data = files.read(path)
    except InvalidInput as error:
        failure = error
    if data is None or not data.GetNumberOfCells():
        try:
            return pyvista.read_meshio(path)
        except Exception:  # pylint: disable=broad-except  meshio is missing, or cannot read the file either
            if failure:
                raise failure from None
    return pyvista.wrap(data)


def read_handles(path, **options):
    """Read handles from a .tgf file for `pyvista.read`."""
    _check(path, options)
    return pyvista.wrap(files.read_handles(path))


def write(dataset, path, **options):
    """Write a .off, .mesh (MEDIT) or .dmat file (the array ``Weights``) for ``dataset.save``."""
    _check(path, options)
    files.write(dataset, path, overwrite=True)
