"""Smoothing of data with a list of extrema or by persistence: arrays, datasets, and exceptions."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, point_array, to_dataset

BAR = shapes.bar()
X, Y, Z = np.array(BAR[0]).T
DATA = X + 0.5 * np.sin(5 * X) + 0.3 * np.random.default_rng(2).random(len(X))
LEFT, RIGHT = int(np.argmin(X + Y + Z)), int(np.argmax(X + Y + Z))


def edges():
    faces = np.array(BAR[1])
    return np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)


def extrema(values):
    """Return the vertices without a higher neighbor, and those without a lower one."""
    above, below = np.zeros(len(values), bool), np.zeros(len(values), bool)
    for a, b in edges():
        low, high = (a, b) if values[a] <= values[b] else (b, a)
        above[low] = below[high] = True
        if values[a] == values[b]:
            above[high] = below[low] = True
    return set(np.flatnonzero(~above)), set(np.flatnonzero(~below))


def test_listed_extrema_are_the_only_ones():
    values = bindpose.monotone_smoothing(BAR, DATA, maxima=[RIGHT], minima=[LEFT])
    highest, lowest = extrema(values)
    assert highest <= {RIGHT} and lowest <= {LEFT}
    assert values.argmax() == RIGHT or values[RIGHT] == values.max()
    report = bindpose.report(values)
    assert report["status"] == "ok" and report["extrema_from"] == "list" and report["interior_extrema"] == 0
    assert report["relative_gap"] <= 1e-6 and report["kkt_residual"] <= 1e-6
    assert [e["vertex"] for e in report["extrema"]] == sorted([LEFT, RIGHT])
    kinds = np.zeros(len(X), dtype=int)
    kinds[RIGHT], kinds[LEFT] = 1, -1
    assert np.array_equal(bindpose.monotone_smoothing(BAR, DATA, extrema=kinds), values)
    assert values == pytest.approx(-bindpose.monotone_smoothing(BAR, -DATA, maxima=[LEFT], minima=[RIGHT]), abs=0.1)


def test_values_are_kept_and_data_may_weigh_nothing():
    ends = np.zeros(len(X))
    ends[RIGHT], ends[LEFT] = 3.0, -1.0
    for guide in ("harmonic", "unconstrained"):
        values = bindpose.monotone_smoothing(BAR, ends, maxima=[RIGHT], minima=[LEFT], data_weight=0, guide=guide)
        assert values.max() == values[RIGHT] == 3 and values.min() == values[LEFT] == -1
    kept = bindpose.monotone_smoothing(BAR, DATA, maxima=[RIGHT], minima=[LEFT], keep_values=True)
    assert kept[RIGHT] == DATA[RIGHT] and kept[LEFT] == DATA[LEFT]


def test_datasets_keep_their_arrays():
    mesh = to_dataset(BAR)
    add_point_array(mesh, "Height", DATA)
    smooth = bindpose.monotone_smoothing(mesh, "Height", number_of_extrema=2)
    assert type(smooth) is type(mesh) and point_array(mesh, "Smoothed") is None
    assert np.abs(point_array(smooth, "SmoothedExtrema")).sum() == 2
    assert np.array_equal(point_array(smooth, "Height"), DATA)
    values = bindpose.monotone_smoothing(BAR, DATA, number_of_extrema=2)
    assert np.array_equal(point_array(smooth, "Smoothed"), values)
    mesh.GetPointData().SetActiveScalars("Height")
    assert np.array_equal(point_array(bindpose.monotone_smoothing(mesh, number_of_extrema=2), "Smoothed"), values)
    from_array = bindpose.monotone_smoothing(mesh, DATA, number_of_extrema=2)
    names = {from_array.GetPointData().GetArrayName(i) for i in range(from_array.GetPointData().GetNumberOfArrays())}
    assert names == {"Height", "Smoothed", "SmoothedExtrema"}


def test_bad_input_is_named():
    with pytest.raises(bindpose.InvalidInput, match="99999 is out of range"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[99999], minima=[LEFT])
    with pytest.raises(bindpose.InvalidInput, match="-1 is out of range"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[RIGHT], minima=[-1])
    with pytest.raises(bindpose.InvalidInput, match="maximum and as minimum"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[RIGHT], minima=[RIGHT])
    with pytest.raises(bindpose.InvalidInput, match="must be a vertex id"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[0.5], minima=[LEFT])
    with pytest.raises(bindpose.InvalidInput, match="no minimum"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[RIGHT])
    with pytest.raises(bindpose.InvalidInput, match="is empty"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[], minima=[])
    with pytest.raises(bindpose.InvalidInput, match="cannot be combined"):
        bindpose.monotone_smoothing(BAR, DATA, maxima=[RIGHT], extrema=np.zeros(len(X)))
    with pytest.raises(bindpose.InvalidInput, match="data is required"):
        bindpose.monotone_smoothing(BAR)
    with pytest.raises(bindpose.InvalidInput, match="shape"):
        bindpose.monotone_smoothing(BAR, DATA[:-1])
    with pytest.raises(bindpose.InvalidInput, match="shape"):
        bindpose.monotone_smoothing(BAR, np.stack([DATA, DATA], axis=1))
    with pytest.raises(bindpose.InvalidInput, match="shape"):
        bindpose.monotone_smoothing(BAR, DATA, extrema=np.zeros(3))
    with pytest.raises(bindpose.InvalidInput, match="'Depth'"):
        bindpose.monotone_smoothing(to_dataset(BAR), "Depth")
    with pytest.raises(bindpose.InvalidInput, match="vertex 3"):
        bindpose.monotone_smoothing(BAR, np.where(np.arange(len(X)) == 3, np.nan, DATA))
    for wrong in ({"order": 4}, {"guide": "data"}, {"persistence": 1.0}, {"data_weight": -1}, {"epsilon": -1},
                  {"rebuilds": -1}, {"number_of_extrema": -1}, {"tolerance": 0}, {"maximum_iterations": 0}):
        with pytest.raises(bindpose.InvalidInput):
            bindpose.monotone_smoothing(BAR, DATA, **wrong)


def test_constant_data_stay_and_few_iterations_warn():
    with pytest.warns(bindpose.BindposeWarning, match="constant"):
        assert (bindpose.monotone_smoothing(BAR, np.full(len(X), 2.5)) == 2.5).all()
    with pytest.warns(bindpose.NotConvergedWarning):
        bindpose.monotone_smoothing(BAR, DATA, number_of_extrema=2, maximum_iterations=1)
