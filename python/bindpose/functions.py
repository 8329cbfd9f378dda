"""The stages as functions."""

import json
import os
import warnings as python_warnings

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import BindposeFilters as filters
from .errors import BindposeWarning, InvalidInput, Unavailable
from .fairing import make_variational
from .files import read
from .handle_sets import to_handles, with_cell_values
from .images import is_image_file, read_image, to_image
from .meshes import (
    Array,
    PlanarShape,
    Tets,
    add_point_array,
    copy_report,
    is_dataset,
    is_tets,
    point_array,
    points_of,
    shallow_copy,
    tets_of,
    to_curves,
    to_dataset,
    to_vtk_points,
    triangles_of,
)
from .running import report as report_of
from .running import run

_WINDING = {"auto": "AUTO", "exact": "EXACT", "fast": "FAST"}
_TETRAHEDRALIZE = {"auto": "AUTO", "cdt": "CDT", "remesh": "REMESH", "embed": "EMBED", "wrap": "WRAP",
                   "ftetwild": "FTETWILD"}
_SEGMENTATION = {"graph-cut": "GRAPH_CUT", "threshold": "THRESHOLD"}
_SKINNING = {"lbs": "LINEAR_BLEND", "dqs": "DUAL_QUATERNION", "stbs": "STRETCHABLE_BONES",
             "cor": "CENTERS_OF_ROTATION"}


def _choice(value, choices, what):
    if value not in choices:
        raise InvalidInput(f"{what} is one of {', '.join(choices)}, not {value!r}")
    return value


def winding_number(surface, points_or_grid=None, *, method="auto", tolerance=1e-3, bounds=None,
                   padding=0.1, gradient=False, orient_patches=False, threads=0, progress=None):
    """Winding number of a surface: 1 inside, 0 outside, in between where it is open.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
        A dataset without polygons is taken for a curve in a plane (lines), or for samples of a
        surface (points with normals, and areas in a point array ``Area``).
    points_or_grid : optional
        Where to evaluate: an array of points (#P, 3); a VTK dataset, at whose points; a number of
        samples along the longest side of a grid of cubic voxels; three numbers, the dimensions of a
        grid. Default: 64 samples.
    method : {"auto", "exact", "fast"}
        ``exact`` is true to round-off, ``fast`` keeps within `tolerance`; ``auto`` is exact where
        that is soon done (closed surfaces), else fast. The report says which and why.
    tolerance : float
        Largest error of ``fast``, from 1e-8 to 0.1.
    bounds : six numbers, optional
        Box of a grid. Default: the surface's with padding.
    padding : float
        Free space around the surface, as a fraction of its diagonal.
    gradient : bool
        Compute the field's gradient, too (without the jump across the surface).
    orient_patches : bool
        First turn triangles that look the other way than their neighbours, and closed parts that
        are inside out.
    threads : int
        0 for all cores; the result does not depend on it.
    progress : callable, optional
        See `bindpose.run`.

    Returns
    -------
    Array, vtkImageData or vtkDataSet
        (#P,) values for points, with `gradient` a pair of those and (#P, 3) gradients; an image for
        a grid; a copy of the dataset. Datasets have the point arrays ``WindingNumber``,
        ``OnSurface`` (1 where a triangle touches the point) and, when asked for,
        ``WindingNumberGradient``.

    Raises
    ------
    InvalidInput
        Not a surface, coordinates that are not finite, vertex ids out of range.

    Notes
    -----
    Jacobson, Kavan, Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
    numbers", 2013.

    See Also
    --------
    contains : the yes or no of it
    """
    if not 1e-8 <= tolerance <= 0.1:
        raise InvalidInput(f"tolerance must lie between 1e-8 and 0.1, not at {tolerance}")
    field = filters.vtkWindingNumberField()
    field.SetInputData(0, to_dataset(surface))
    field.SetMethod(getattr(field, _WINDING[_choice(method, _WINDING, "method")]))
    field.SetTolerance(tolerance)
    field.SetPadding(padding)
    field.SetComputeGradient(gradient)
    field.SetOrientPatches(orient_patches)
    field.SetNumberOfThreads(threads)
    if bounds is not None:
        field.SetBounds(*bounds)
    as_array = False
    if points_or_grid is None:
        pass
    elif is_dataset(points_or_grid):
        field.SetInputData(1, points_or_grid)
    elif np.ndim(points_or_grid) == 0:
        field.SetSamplesAlongLongestSide(int(points_or_grid))
    elif np.ndim(points_or_grid) == 1 and np.shape(points_or_grid) == (3,) and all(
            isinstance(n, (int, np.integer)) for n in points_or_grid):
        field.SetDimensions(*map(int, points_or_grid))
    else:
        cloud = vtkPolyData()
        cloud.SetPoints(to_vtk_points(points_or_grid))
        field.SetInputData(1, cloud)
        as_array = True
    report = run(field, progress)
    result = field.GetOutput()
    if not as_array:
        return result
    values = Array(point_array(result, "WindingNumber"), report)
    return (values, Array(point_array(result, "WindingNumberGradient"), report)) if gradient else values


def contains(surface, points, *, winding_threshold=0.5, method="auto", tolerance=1e-3,
             orient_patches=False, threads=0, progress=None):
    """Whether points lie inside of a surface, however unclean.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
    points : (#P, 3) array or vtkDataSet
    winding_threshold : float
        Inside is where the winding number is at least this.
    method, tolerance, orient_patches, threads, progress
        See `winding_number`.

    Returns
    -------
    Array of bool
        (#P,). Points whose coordinates are not finite are not inside.

    Raises
    ------
    InvalidInput
        As `winding_number`.
    """
    values = winding_number(surface, points if is_dataset(points) else np.atleast_2d(points),
                            method=method, tolerance=tolerance, orient_patches=orient_patches,
                            threads=threads, progress=progress)
    if is_dataset(values):
        values = Array(point_array(values, "WindingNumber"), report_of(values))
    return Array(np.asarray(values) >= winding_threshold, values.report)


def tetrahedralize(surface, *, method="auto", winding_threshold=0.5, segmentation="graph-cut", cut_smoothness=1.0,
                   cut_sigma=0.1, quality=0.0, bare=False, interior_edge=0.0, keep_outside=False, resolution=0,
                   wrap_alpha=0.02, wrap_offset=0.001, ftetwild_epsilon=0.001, time_limit=0.0, memory_limit=0, handles=None, threads=0,
                   progress=None):
    """Fill the inside of a surface, however unclean, with tets.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
    method : {"auto", "cdt", "remesh", "embed", "wrap", "ftetwild"}
        ``cdt`` keeps the surface's vertices, ``remesh`` follows the winding number, ``embed`` merely
        holds the surface. ``wrap`` fills a closed surface around it, a thin shell where the surface is
        open, whatever the winding number. ``ftetwild`` runs the program fTetWild where it is installed.
        ``auto`` tries cdt, then remesh, and nothing else; the report says which and why.
    winding_threshold : float
        Inside is where the winding number is at least this.
    segmentation : {"graph-cut", "threshold"}
        How cdt tells an open surface's tets apart: all together by a graph cut, whose boundary is small across
        openings, or each by its own winding number.
    cut_smoothness, cut_sigma : float
        Of the graph cut: weight of a small boundary, and the difference of winding numbers between neighbours
        that counts as surface.
    quality : float
        Smallest dihedral angle that every tet must have, degrees, 0 to 20: auto leaves the surface's triangles
        for it where they do not allow it. remesh reaches 10.7 on any surface.
    bare : bool
        cdt and wrap add no vertices inside and leave flat tets as they are; `interior_edge` and `quality` must be 0.
    interior_edge : float
        Longest edges that cdt and wrap leave inside, as a fraction of the surface's diagonal; 0 for automatic.
        ftetwild aims at this length; 0 for its own 0.05.
    keep_outside : bool
        With cdt: all tets of the hull, for inspection; ``Label`` is above 0 where they are inside.
    handles : vtkPolyData, str or path-like, optional
        Handle dataset or file. With cdt and wrap their points become points of the tets where they are inside, and bones
        and cages get points along them.
    resolution : int
        Lattice cubes along the longest side for remesh and embed, 4 to 1000; 0 for 40 (remesh) or about 30,000
        tets (embed).
    wrap_alpha, wrap_offset : float
        Of wrap, as fractions of the diagonal: radius of the ball that carves it (gaps below twice this are
        closed), and its distance from the surface.
    ftetwild_epsilon : float
        Of ftetwild: how far from the surface the tets may end, as a fraction of the diagonal.
    time_limit : float
        Seconds for the meshing process; 0 for 120, or 120 per million triangles if that is more.
    memory_limit : int
        MiB for the meshing process; 0 for none.
    threads, progress
        See `winding_number`.

    Returns
    -------
    Tets or vtkUnstructuredGrid
        Arrays for arrays; a dataset has the point array ``OriginalPointIds`` and the cell arrays
        ``WindingNumber``, ``Label`` (1 inside, 2 inside though the winding number is below the
        threshold, 0 outside, -1 outside though it is not below) and ``MinDihedralAngle`` (degrees).

    Raises
    ------
    InvalidInput
        Not a surface, or one that encloses nothing; `keep_outside` with another method than cdt.
    Unavailable
        The meshing program is not there; the text names the packages, or where to get it.
    """
    data = to_dataset(surface)
    filler = filters.vtkTetrahedralizeSurface()
    filler.SetInputData(0, data)
    if handles is not None:
        filler.SetInputData(1, to_handles(handles, data))
    filler.SetMethod(getattr(filler, _TETRAHEDRALIZE[_choice(method, _TETRAHEDRALIZE, "method")]))
    filler.SetWindingThreshold(winding_threshold)
    filler.SetSegmentation(getattr(filler, _SEGMENTATION[_choice(segmentation, _SEGMENTATION, "segmentation")]))
    filler.SetCutSmoothness(cut_smoothness)
    filler.SetCutSigma(cut_sigma)
    filler.SetQuality(quality)
    filler.SetBare(bool(bare))
    filler.SetInteriorEdge(interior_edge)
    filler.SetKeepOutside(bool(keep_outside))
    filler.SetResolution(int(resolution))
    filler.SetWrapAlpha(wrap_alpha)
    filler.SetWrapOffset(wrap_offset)
    filler.SetFtetwildEpsilon(ftetwild_epsilon)
    filler.SetTimeLimit(time_limit)
    filler.SetMemoryLimit(memory_limit)
    filler.SetNumberOfThreads(threads)
    report = run(filler, progress)
    result = filler.GetOutput()
    if is_dataset(surface):
        return result
    return Tets(points_of(result), tets_of(result), point_array(result, "OriginalPointIds"), report)


def planar_shape(image_or_curves, *, rectangle=False, simplify=0.5, winding_threshold=0.5, min_angle=30.0, edge=0.02,
                 handles=None, time_limit=120.0, memory_limit=0, threads=0, progress=None):
    """What an image shows, or what curves in a plane enclose, as quality triangles.

    Parameters
    ----------
    image_or_curves : vtkImageData, vtkPolyData, array, pair of arrays, str or path-like
        An image: a dataset, a png, jpg, tif or bmp file, or an array with its first row on top,
        #rows x #columns of alpha (0 to 1, bool, or unsigned integers) or x 4 with alpha as the last.
        It is cut out where alpha is at least one half; without alpha it is taken as a whole.
        Curves: a dataset or mesh file with lines or polygons in a plane z = const, or arrays
        (points #V x 2 or x 3, segments #E x 2), counter-clockwise around the inside.
    rectangle : bool
        The whole image, whatever its alpha.
    simplify : float
        Pixels that simplifying may move the image's outline by, 0 to 1.
    winding_threshold : float
        Inside is where the curves' winding number is at least this.
    min_angle : float
        Smallest angle of a triangle in degrees, 0 to 33, where the outline has none smaller.
    edge : float
        Longest edge of a triangle, as a fraction of the diagonal; 0 for no bound.
    handles : vtkPolyData, str or path-like, optional
        Handle dataset or file: points become points of the mesh, bones rows of edges.
    time_limit : float
        Seconds for the meshing process.
    memory_limit : int
        MiB for the meshing process; 0 for none.
    threads, progress
        See `winding_number`.

    Returns
    -------
    PlanarShape or vtkPolyData
        Arrays for arrays; a dataset has the point arrays ``TCoords`` (texture coordinates) and
        ``OriginalPointIds`` and the cell array ``WindingNumber``.

    Raises
    ------
    InvalidInput
        An image that is transparent everywhere, curves that enclose nothing or are not in a plane.
    Unavailable
        The meshing program is not there; the text names the packages.

    See Also
    --------
    tetrahedralize : the same for surfaces
    """
    data, as_arrays = image_or_curves, False
    if isinstance(data, (str, os.PathLike)):
        data = read_image(data) if is_image_file(data) else read(data)
    elif isinstance(data, np.ndarray):
        data, as_arrays = to_image(data), True
    elif not is_dataset(data):
        data, as_arrays = to_curves(data), True
    if not data.IsA("vtkImageData") and not data.IsA("vtkPolyData"):
        raise InvalidInput(f"a {data.GetClassName()} is neither an image nor curves")
    shaper = filters.vtkPlanarShape()
    shaper.SetInputData(0, data)
    if handles is not None:
        shaper.SetInputData(1, to_handles(handles, data))
    shaper.SetRectangle(bool(rectangle))
    shaper.SetSimplify(simplify)
    shaper.SetWindingThreshold(winding_threshold)
    shaper.SetMinAngle(min_angle)
    shaper.SetEdge(edge)
    shaper.SetTimeLimit(time_limit)
    shaper.SetMemoryLimit(memory_limit)
    shaper.SetNumberOfThreads(threads)
    report = run(shaper, progress)
    result = shaper.GetOutput()
    if not as_arrays:
        return result
    return PlanarShape(points_of(result), triangles_of(result), point_array(result, "TCoords"),
                       point_array(result, "OriginalPointIds"), report)


def _make_weights(method):
    if method == "bounded-biharmonic":
        return filters.vtkBoundedBiharmonicWeights()
    if method == "monotone":
        return filters.vtkMonotoneWeights()
    result = filters.vtkUnconstrainedWeights()
    result.SetMethod(getattr(result, method.upper().replace("-", "_")))
    return result


def _set_terms(solver, data, terms):
    """What is asked of weights: names for the solver, arrays on a copy of the mesh."""
    named = shallow_copy(data)
    for term, values in terms.items():
        if term == "Mirror" and isinstance(values, str) and values in ("x", "y", "z"):
            low, high = np.reshape(data.GetBounds(), (3, 2)).T
            solver.SetMirrorNormal(*(float(values == axis) for axis in "xyz"))
            solver.SetMirrorOrigin(*(0.5 * (low + high)))
        elif isinstance(values, str):
            if data.GetPointData().GetArray(values) is None:
                raise InvalidInput(f"the mesh has no point array {values!r}")
            getattr(solver, f"Set{term}ArrayName")(values)
        elif values is not None:
            values = np.asarray(values, dtype=np.int64 if term in ("RigidSet", "Mirror") else float)
            if len(values) != data.GetNumberOfPoints():
                raise InvalidInput(f"there are {len(values)} rows of terms for {data.GetNumberOfPoints()} points")
            add_point_array(named, getattr(solver, f"Get{term}ArrayName")(), values)
    return named


def weights(mesh, handles, *, method="bounded-biharmonic", domain="auto", resolution=0, stage="certified",
            regions=None, tolerance=1e-6, maximum_iterations=100, keep_mesh=False, rigidity=None, rigid_sets=None,
            lower=None, upper=None, pins=None, bounds=(0, 1), mirror=None, influences=0, partition="normalise",
            memory_limit=0, threads=0, progress=None):
    """Smooth weights, one function a handle, at the mesh's own points.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A surface or tets.
    handles : vtkPolyData, str or path-like
        A handle dataset (see `bindpose.handles`), a .tgf or .vtp file, "auto:N" for N points
        spread over the surface, or "skeleton:N" for at most N bones in it (`automatic_handles`).
    method : {"bounded-biharmonic", "monotone", "harmonic", "biharmonic", "triharmonic", \
              "graph-biharmonic", "linear-subspace", "inverse-distance", "smoothed-harmonic", "bone-heat"}
        All but the first two are to compare with: see ``vtkUnconstrainedWeights``.
    domain : {"auto", "volume", "embedding", "cage", "surface"}
        Where to solve for a surface: in tets of its inside, in a lattice that holds it, in the closed
        cage that the handles have around it (of edges, around a flat shape), on itself.
        ``auto``: flat shapes on themselves, closed and clean surfaces in their volume where that is
        predicted to be well conditioned and cheap, all others in the lattice, which also takes over
        where the first choice fails. Tets are solved on directly.
    resolution : int
        Of the embedding: lattice cubes along the longest side; 0: finer until two lattices agree.
    stage : {"certified", "preview"}
        ``preview``: biharmonic weights, clamped, in the time of a factorisation or less.
    regions : str, optional
        Point array of labels that the handle dataset's regions (``RegionId``) refer to.
        Default: ``RegionId``, on meshes that have it.
    tolerance : float
        Of the certificate: relative gap and natural residual of each column.
    maximum_iterations : int
        At most for a handle.
    keep_mesh : bool
        Split no cell: the corners around a handle stand for it.
    rigidity : str or array_like (#V,), optional
        Painted rigidity, 0 and more: weights hardly vary where it is 1 or more. This and what follows
        are for bounded and monotone weights, arrays or names of the mesh's point arrays; without them
        its arrays ``Rigidity``, ``RigidSet``, ``WeightsLower``, ``WeightsUpper``, ``PinnedWeights`` and
        ``SymmetricPoint`` count, where it has them.
    rigid_sets : str or array_like (#V,) of int, optional
        Labels: weights are constant on each one above 0.
    lower, upper : str or array_like (#V, #handles), optional
        Least and largest weights, NaN: those of ``bounds``.
    pins : str or array_like (#V, #handles), optional
        Weights that are given, NaN: free.
    bounds : (float, float) or dict of handle name to (float, float)
        Least and largest weight, of all or of single handles; only a wider range than 0 to 1 can be kept.
        Without a dict the handles' cell array ``WeightBounds`` counts, where they have it.
    mirror : {"x", "y", "z"}, str or array_like (#V,) of int, optional
        Handles that are mirror images get mirrored weights: in the plane across the middle of that axis,
        or by ids of mirror points, -1 for none.
    influences : int
        Handles with a weight at a point, at most: the largest, solved for again. 0: any number.
    partition : {"normalise", "coupled"}
        Divide rows by their sums, or solve for all columns together with the sums as constraints
        (bounded weights only, slow).
    memory_limit : int
        MiB that the whole process may hold; 0: as much as the machine has available. What would take more
        is refused before it is begun.
    threads, progress
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        For arrays (#V, #handles) with ``names`` of the columns; for a dataset a copy of the mesh with
        the point array ``Weights``, a component a handle. Rows sum to one.

    Raises
    ------
    InvalidInput
        A mesh or handles that cannot be used; the text names the first offender.
    BindposeError
        Not enough memory; the text has the numbers.

    Warns
    -----
    NotConvergedWarning
        A column's certificate is above the tolerance; the result is kept.
    BindposeWarning
        A handle lies outside, the domain that ``auto`` chose failed and a lattice took over, or the
        weights of two lattices differ.

    Notes
    -----
    Jacobson, Baran, Popović, Sorkine, "Bounded biharmonic weights for real-time deformation", 2011;
    Jacobson, Weinkauf, Sorkine, "Smooth shape-aware functions with controlled extrema", 2012.
    """
    methods = ("bounded-biharmonic", "monotone", "harmonic", "biharmonic", "triharmonic", "graph-biharmonic",
               "linear-subspace", "inverse-distance", "smoothed-harmonic", "bone-heat")
    _choice(method, methods, "method")
    _choice(domain, ("auto", "volume", "embedding", "cage", "surface"), "domain")
    _choice(stage, ("certified", "preview"), "stage")
    _choice(partition, ("normalise", "coupled"), "partition")
    data = to_dataset(mesh)
    handle_data = to_handles(handles, data)
    if is_tets(data) and domain == "surface":
        raise InvalidInput("the mesh holds tets: domain 'surface' needs a surface")
    solver = _make_weights(method)
    solver.SetInputData(1, handle_data)
    solver.SetDomain(getattr(solver, domain.upper()))
    solver.SetEmbeddingResolution(int(resolution))
    solver.SetStage(getattr(solver, stage.upper()))
    solver.SetRegionArrayName(regions or "RegionId")
    solver.SetTolerance(tolerance)
    solver.SetMaximumIterations(int(maximum_iterations))
    solver.SetMemoryLimit(int(memory_limit))
    solver.SetKeepMesh(bool(keep_mesh))
    if isinstance(bounds, dict):
        handle_data = with_cell_values(handle_data, "WeightBounds", bounds, 2, missing=(np.nan, np.nan))
        solver.SetInputData(1, handle_data)
    else:
        solver.SetBounds(*map(float, bounds))
    solver.SetMaximumInfluences(int(influences))
    solver.SetPartitionOfUnity(("normalise", "coupled").index(partition))
    asked = [value is not None for value in (rigidity, rigid_sets, lower, upper, pins, mirror)]
    if method not in methods[:2] and (any(asked) or isinstance(bounds, dict) or tuple(bounds) != (0, 1) or influences or partition != "normalise"):
        raise InvalidInput(f"{method} weights take no terms, bounds, influences or partition")
    terms = {"Rigidity": rigidity, "RigidSet": rigid_sets, "Lower": lower, "Upper": upper, "Pinned": pins, "Mirror": mirror}
    solver.SetInputData(0, _set_terms(solver, data, terms))
    solver.SetNumberOfThreads(threads)
    report = run(solver, progress)
    result = solver.GetOutput()
    if is_tets(data) or domain == "surface":  # it may have got points: back to the mesh's own
        transfer = filters.vtkTransferWeights()
        transfer.SetInputData(0, data)
        transfer.SetInputData(1, result)
        transfer.SetNumberOfThreads(threads)
        report = {**run(transfer), **report}
        result = transfer.GetOutput()
    result = shallow_copy(result)
    copy_report(solver.GetOutput(), result)
    if is_dataset(mesh):
        return result
    array = result.GetPointData().GetArray("Weights")
    names = [array.GetComponentName(j) for j in range(array.GetNumberOfComponents())]
    return Array(point_array(result, "Weights"), report, names)


_ENERGIES = ("auto", "spokes-and-rims", "spokes", "tetrahedra", "triangles")


_PSEUDO_EDGES = {"none": "NO_PSEUDO_EDGES", "given": "GIVEN_PSEUDO_EDGES", "auto": "AUTOMATIC_PSEUDO_EDGES"}


def _make_deformation(method, energy, options):
    """The filter of a method, with what deform() was told of it."""
    if method == "variational":
        return make_variational(options["order"], options["boundary"], options["tangents"])
    if method in ("reduced-arap", "full-arap"):
        arap = filters.vtkReducedARAP() if method == "reduced-arap" else filters.vtkFullARAP()
        arap.SetEnergy(getattr(arap, energy.upper().replace("-", "_")))
        arap.SetTolerance(options["tolerance"])
        if options["iterations"]:
            arap.SetMaximumIterations(int(options["iterations"]))
        if method == "reduced-arap":
            arap.SetTimeBudget(options["budget_us"])
            arap.SetMixedPrecision(bool(options["mixed_precision"]))
            arap.SetNumberOfExtraWeights(int(options["extra_weights"]))
            arap.SetExtraWeights(getattr(arap, options["extra_kind"].upper()))
        return arap
    if method == "mls":
        warp = filters.vtkMovingLeastSquaresWarp()
        warp.SetExponent(options["exponent"])
        return warp
    skinning = filters.vtkSkinningDeformation()
    skinning.SetMethod(getattr(skinning, _SKINNING[method]))
    skinning.SetSinglePrecision(bool(options["single_precision"]))
    skinning.SetMaximumInfluences(int(options["influences"]))
    skinning.SetSmallestWeight(options["smallest_weight"])
    skinning.SetPseudoEdges(getattr(skinning, _PSEUDO_EDGES[options["pseudo_edges"]]))
    skinning.SetPseudoEdgeStretch(options["pseudo_edge_stretch"])
    return skinning


def _posed_handles(mesh, handles, pose, weights):
    """The mesh as a dataset with its weights, and the filter that poses the handles."""
    data = to_dataset(mesh)
    if weights is not None:
        data = shallow_copy(data)
        add_point_array(data, "Weights", np.asarray(weights, dtype=float), getattr(weights, "names", ()))
    return data, _make_poser(to_handles(handles, data), pose)


def _make_poser(handles, pose):
    """The filter that poses a handle dataset."""
    poser = filters.vtkPoseHandles()
    poser.SetInputData(0, handles)
    if isinstance(pose, (str, os.PathLike)):
        poser.SetFileName(os.fspath(pose))
    else:
        if isinstance(pose, dict):
            pose = {"version": 2, **pose}
        try:
            poser.SetPoseJSON(json.dumps(pose))
        except TypeError as error:
            raise InvalidInput(f"the pose is no JSON object: {error}") from None
    return poser


def deform(mesh, handles, pose, *, method="lbs", weights=None, exponent=1.0, energy="auto", iterations=0,
           tolerance=1e-6, budget_us=0.0, mixed_precision=True, extra_weights=0, extra_kind="bumps", times=None, order=2,
           boundary="region", tangents="surroundings", pseudo_edges="given", pseudo_edge_stretch=False,
           single_precision=False, influences=0, smallest_weight=0.0, stretch_limit=2.0, stretch_array=False,
           rotation_arrays=False, threads=0, progress=None):
    """Bend a mesh with weights to a pose, or to a sequence of poses.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A dataset with the point array ``Weights``, or arrays beside `weights`. ``full-arap``, ``mls`` and
        ``variational`` need none.
    handles : vtkPolyData, str or path-like
        The handles that the weights were made for.
    pose : dict, str or path-like
        ``{"handles": {name: {"translate": [x, y, z], "rotate": {"axis": [x, y, z], "degrees": d}, …}}}``
        or ``{"frames": [pose, …], "fps": n}``, as a dict or as a .json file, where numbers may be expressions in
        ``t``; or a .dmat file of libigl; or a .glb or .gltf file for its animation. A handle follows its parent
        unless its entry has ``"space": "world"``; a .json file needs ``"version": 2`` for that.
    method : {"lbs", "dqs", "stbs", "cor", "reduced-arap", "full-arap", "mls", "variational"}
        Linear blend skinning, dual quaternions, stretchable and twistable bones (with the point array
        ``EndpointWeights`` where there is one), centres of rotation (neither twists nor bends lose width),
        reduced as-rigid-as-possible; without weights: full as-rigid-as-possible, the rigid warp by moving least
        squares, which knows nothing of the shape, or the smooth displacement between what handles and the point
        array ``Fixed`` hold (see `fair`).
    weights : (#V, #handles) array, optional
        For a mesh of arrays.
    exponent : float
        Of mls: handles count by 1 / distance^(2 exponent), 1 to 8.
    energy : {"auto", "spokes-and-rims", "spokes", "tetrahedra", "triangles"}
        Of reduced-arap and full-arap: which edges share a rotation. Auto: tetrahedra on tets, spokes and rims
        on surfaces.
    iterations : int
        Of reduced-arap and full-arap: at most; 0: 100 and 500.
    tolerance : float
        Of reduced-arap and full-arap: an iteration that lowers the energy by less than this share of it is
        the last.
    budget_us : float
        Of reduced-arap: microseconds for the iterations of a pose; 0: no limit. The report's ``iterations``,
        given as `iterations` with `tolerance` 0, repeat the result.
    mixed_precision : bool
        Of reduced-arap: iterate in single precision as far as that goes (the report's ``single_precision_iterations``),
        then in double; False: in double from the start.
    extra_weights : int
        Of reduced-arap: weights beside the handles', which let the mesh bend where no handle is; 15 is a good
        number.
    extra_kind : {"bumps", "eigenmodes"}
        Of `extra_weights`: bumps around places far apart, or the smoothest weights that vanish at the handles.
    times : sequence of floats, optional
        Of a pose with expressions: seconds at which to take it; without, 0.
    order, boundary, tangents
        Of variational: see `fair`.
    pseudo_edges : {"none", "given", "auto"}
        Of lbs, dqs, stbs and cor: edges between points that tell how these turn when they are dragged: those of the
        handles (see `handles`), or the tree that joins near points through the shape.
    pseudo_edge_stretch : bool
        Scale points by how much longer their pseudo-edges become.
    single_precision : bool
        Of lbs, dqs, stbs and cor: weights and transforms as floats: half the memory, up to twice as fast, right to
        about a millionth of the diagonal.
    influences : int
        Of lbs, dqs, stbs and cor: weights of a vertex that count, the largest; 0: all. The report tells what is lost
        (``dropped_share``).
    smallest_weight : float
        Of lbs, dqs, stbs and cor: weights of at most this size do not count.
    stretch_limit : float
        The report counts elements that become more than this many times as long in some direction, or less than one
        over this (``counts.stretched_elements``), and those turned inside out (``counts.inverted_elements``, a
        warning), with ``largest_stretch`` and ``smallest_stretch``; 0: it does not look at them.
    stretch_array : bool
        For a dataset: add the cell array ``Stretch``, the largest and the smallest stretch of each cell, the smallest
        below 0 where it is inside out.
    rotation_arrays : bool
        Of reduced-arap and full-arap, for a dataset: add the point arrays ``RotationCluster``, the number of the
        rotation that a vertex follows, and ``Rotation``, its axis times its angle in degrees.
    threads, progress
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet, or a list of them
        Posed coordinates (#V, 3) for arrays, a posed copy for a dataset; a list, one a frame, for a
        sequence.

    Raises
    ------
    InvalidInput
        Weights that do not fit, an unknown handle in the pose, a broken pose.
    """
    _choice(method, (*_SKINNING, "reduced-arap", "full-arap", "mls", "variational"), "method")
    _choice(energy, _ENERGIES, "energy")
    _choice(extra_kind, ("bumps", "eigenmodes"), "extra_kind")
    _choice(pseudo_edges, tuple(_PSEUDO_EDGES), "pseudo_edges")
    data, poser = _posed_handles(mesh, handles, pose, weights)
    bender = _make_deformation(method, energy, {
        "exponent": exponent, "iterations": iterations, "tolerance": tolerance, "budget_us": budget_us,
        "mixed_precision": mixed_precision,
        "extra_weights": extra_weights, "extra_kind": extra_kind, "order": order, "boundary": boundary,
        "tangents": tangents, "pseudo_edges": pseudo_edges, "pseudo_edge_stretch": pseudo_edge_stretch,
        "single_precision": single_precision, "influences": influences, "smallest_weight": smallest_weight})
    bender.SetInputData(0, data)
    bender.SetInputConnection(1, poser.GetOutputPort())
    bender.SetStretchLimit(stretch_limit)
    bender.SetStretchArray(stretch_array)
    if method in ("reduced-arap", "full-arap"):
        bender.SetRotationArrays(rotation_arrays)
    bender.SetNumberOfThreads(threads)
    results = []
    run(poser)
    frames = poser.GetNumberOfFrames() if times is None else len(times)
    for frame in range(frames):
        if times is None:
            poser.SetFrame(frame)
        else:
            poser.SetTime(times[frame])
        run(poser)
        report = run(bender, progress)
        posed = bender.GetOutput()
        results.append(shallow_copy(posed) if is_dataset(mesh) else Array(points_of(posed), report))
    return results if times is not None or poser.GetSequence() else results[0]


def dynamics(mesh, handles, pose, *, frames, time_step=1 / 24, weights=None, gravity=(0.0, 0.0, 0.0), damping=0.0,
             stiffness=1000.0, density=1.0, energy="auto", extra_weights=0, extra_kind="bumps", mixed_precision=True,
             rotation_arrays=False, threads=0, progress=None):
    """Move a mesh as a body with mass: what handles leave open swings and falls.

    Parameters
    ----------
    mesh, handles, weights
        See `deform`.
    pose : dict, str or path-like
        See `deform`: a sequence, whose frames lead at their times, a pose with expressions in ``t``, or one that
        stays. A handle that changes to mode ``free`` lets go.
    frames : int
        Steps in time to return; the first is the pose at time 0 without motion.
    time_step : float
        Seconds of a step.
    gravity : sequence of 3 floats
        Acceleration, lengths / s^2.
    damping : float
        Drag of this times mass times velocity, 1 / s.
    stiffness, density : float
        Energy of a strain of one, and mass, per volume (of surfaces per area). Waves run at
        sqrt(stiffness / density) lengths a second.
    energy, extra_weights, extra_kind, mixed_precision, rotation_arrays
        See `deform`, of reduced-arap.
    threads, progress
        See `winding_number`.

    Returns
    -------
    list of Array or of vtkDataSet
        One a step, as `deform` returns.

    Raises
    ------
    InvalidInput
        Weights that do not fit, a broken pose, numbers out of range.
    """
    _choice(energy, _ENERGIES, "energy")
    _choice(extra_kind, ("bumps", "eigenmodes"), "extra_kind")
    data, poser = _posed_handles(mesh, handles, pose, weights)
    body = filters.vtkReducedDynamics()
    body.SetEnergy(getattr(filters.vtkReducedARAP, energy.upper().replace("-", "_")))
    body.SetNumberOfExtraWeights(int(extra_weights))
    body.SetExtraWeights(getattr(filters.vtkReducedARAP, extra_kind.upper()))
    body.SetTimeStep(time_step)
    body.SetGravity(*(float(x) for x in gravity))
    body.SetDamping(damping)
    body.SetStiffness(stiffness)
    body.SetDensity(density)
    body.SetMixedPrecision(bool(mixed_precision))
    body.SetRotationArrays(rotation_arrays)
    body.SetInputData(0, data)
    body.SetInputConnection(1, poser.GetOutputPort())
    body.SetNumberOfThreads(threads)
    run(poser)
    results = []
    for frame in range(frames):
        body.SetStep(frame)
        report = run(body, progress)
        posed = body.GetOutput()
        results.append(shallow_copy(posed) if is_dataset(mesh) else Array(points_of(posed), report))
    return results
