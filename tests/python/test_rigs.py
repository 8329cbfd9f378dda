"""Rigs: poses agree with `deform`, are written in place and do not repeat the preparation of a method."""

import itertools
import threading

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, point_array, points_of, to_dataset
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

BAR = shapes.bar()
BONES = [[[0.5, 0.5, 0.5], [3, 0.5, 0.5]], [[3, 0.5, 0.5], [5.5, 0.5, 0.5]]]
BEND = {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}}
METHODS = ["lbs", "dqs", "stbs", "cor", "reduced-arap", "full-arap", "mls", "variational"]


@pytest.fixture(scope="module")
def rig():
    return bindpose.bind(BAR, bindpose.handles(bones=BONES), domain="surface")


@pytest.fixture(scope="module")
def dataset_rig():
    return bindpose.bind(to_dataset(BAR), bindpose.handles(bones=BONES), domain="surface")


def test_the_weights_are_those_of_the_function(rig):
    handles = bindpose.handles(bones=BONES)
    assert np.array_equal(rig.weights, bindpose.weights(BAR, handles, domain="surface"))
    assert rig.weights.names == ["b1", "b2"]
    assert rig.report["relative_gap"] <= 1e-6
    assert set(rig.extrema) == {"b1", "b2"}


@pytest.mark.parametrize("method", METHODS)
def test_poses_agree_with_deform(method):
    handles = bindpose.handles(bones=BONES)
    weighted = bindpose.weights(to_dataset(BAR), handles, domain="surface")
    rig = bindpose.Rig(weighted, handles)
    precise = {"tolerance": 1e-13, "maximum_iterations": 100000} if "arap" in method else {}
    for degrees in (0, 25, 60):
        pose = {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": degrees}}, "b1": {"translate": [0, 0.1, 0]}}
        expected = bindpose.deform(weighted, handles, {"handles": pose}, method=method, **precise)
        fresh = bindpose.Rig(weighted, handles).pose(pose, method=method, **precise)
        assert np.array_equal(points_of(fresh), points_of(expected))
        again = points_of(rig.pose(pose, method=method, **precise))
        if "arap" in method:  # the solve starts from the previous pose
            assert again == pytest.approx(points_of(expected), abs=1e-4)
        else:
            assert np.array_equal(again, points_of(expected))


def test_a_thousand_poses_bind_once():
    rig = bindpose.bind(BAR, bindpose.handles(bones=BONES), domain="surface")
    assert rig.number_of_binds == 0
    out = rig.pose(BEND)
    for degrees in np.linspace(0, 90, 1000):
        again = rig.pose({"b2": {"rotate": {"axis": [0, 0, 1], "degrees": degrees}}}, out=out)
        assert again is out
    assert rig.number_of_binds == 1
    rig.pose(BEND, method="reduced-arap")
    rig.pose(BEND, method="reduced-arap", tolerance=1e-3, time_budget=100)
    rig.pose(BEND, method="lbs")
    assert rig.number_of_binds == 2
    rig.pose(BEND, method="reduced-arap", number_of_clusters=4)
    assert rig.number_of_binds == 3


def test_an_option_is_valid_for_one_call():
    rig = bindpose.bind(BAR, bindpose.handles(bones=BONES), domain="surface")
    drag = {"b2": {"translate": [0, 1, 0]}}  # the method computes the rotation of b2
    with pytest.warns(bindpose.NotConvergedWarning):
        rig.pose(drag, method="reduced-arap", maximum_iterations=1, tolerance=1e-12)
    rig.pose(drag, method="reduced-arap")
    assert rig.pose_report["status"] == "ok"


def test_out_is_written_in_place(rig, dataset_rig):
    rest = np.array(BAR[0], dtype=float)
    out = np.full_like(rest, np.nan)
    assert rig.pose(BEND, out=out) is out
    assert np.array_equal(out, rig.pose(BEND)) and not np.array_equal(out, rest)
    assert np.array_equal(rig.pose({}), rest)
    posed = dataset_rig.pose(BEND)
    memory = posed.GetPoints().GetData()
    assert np.array_equal(points_of(posed), out)
    assert dataset_rig.pose({}, out=posed) is posed and posed.GetPoints().GetData() is memory
    assert np.array_equal(points_of(posed), rest)
    assert np.array_equal(points_of(dataset_rig.mesh), rest)
    assert point_array(posed, "Weights").shape == rig.weights.shape


@pytest.mark.parametrize("out", [
    np.zeros((3, 3)), np.zeros((len(BAR[0]), 3), dtype=np.float32), np.zeros((3, len(BAR[0]))).T, [[0, 0, 0]], vtkPolyData(),
    to_dataset(BAR)])
def test_an_out_that_does_not_fit_is_refused(rig, out):
    if isinstance(out, vtkPolyData) and out.GetPoints():
        out = rig.mesh
    with pytest.raises(bindpose.InvalidInput, match="out must be a"):
        rig.pose(BEND, out=out)
    locked = np.zeros((len(BAR[0]), 3))
    locked.flags.writeable = False
    with pytest.raises(bindpose.InvalidInput, match="writeable"):
        rig.pose(BEND, out=locked)


def test_all_forms_of_a_pose_agree(rig):
    angle = np.radians(40)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    head = np.array([3, 0.5, 0.5])
    maps = np.stack([np.eye(3, 4), np.column_stack([turn, head - turn @ head])])
    expected = rig.pose(BEND)
    for pose in (maps, maps.reshape(2, 12), {"handles": BEND}, {"version": 2, "handles": BEND},
                 '{"version": 2, "handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}}}',
                 {"b2": {"rotate": {"axis": np.array([0, 0, 1]), "degrees": np.float64(40)}}},
                 {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": "10 * 4"}}}):
        assert rig.pose(pose) == pytest.approx(expected, abs=1e-12)
    assert np.array_equal(rig.pose(BEND), expected)  # earlier poses, such as arrays, have no effect


@pytest.mark.parametrize("pose, sentence", [
    ({"b3": {}}, "b3"), ({"b2": {"turn": 1}}, "turn"), ("{", "JSON"), ("pose.json", "deform"), (None, "must be a dict"),
    (["a"], "must be a dict"), ({"frames": [{"handles": BEND}]}, "one pose"), (np.zeros((3, 3, 4)), "2 x 3 x 4"),
    ({"b2": {"translate": object()}}, "JSON"), ({"b2": {"translate": [0, 0, np.inf]}}, "JSON|finite"), (np.full((2, 3, 4), np.nan), "finite")])
def test_a_wrong_pose_is_named_and_the_rig_stays_usable(rig, pose, sentence):
    before = rig.pose(BEND)
    with pytest.raises(bindpose.InvalidInput, match=sentence):
        rig.pose(pose)
    assert np.array_equal(rig.pose(BEND), before)


def test_wrong_options_are_named(rig):
    with pytest.raises(bindpose.InvalidInput, match="method must be one of"):
        rig.pose(BEND, method="best")
    with pytest.raises(bindpose.InvalidInput, match="not used by method 'lbs'"):
        rig.pose(BEND, number_of_clusters=3)
    with pytest.raises(TypeError, match="'speed'"):
        rig.pose(BEND, speed=2)


def test_a_moved_rest_handle_is_reported_once():
    rig = bindpose.bind(BAR, bindpose.handles(bones=BONES), domain="surface")
    rig.pose(BEND)
    assert rig.moved_handles == []
    points = rig.handles.GetPoints()
    points.SetPoint(3, 5.6, 0.5, 0.5)
    points.Modified()
    assert rig.moved_handles == ["b2"]
    points.SetPoint(0, 0.4, 0.5, 0.5)
    points.Modified()
    assert rig.moved_handles == ["b1", "b2"]
    with pytest.warns(bindpose.BindposeWarning, match="b1, b2; compute the weights again"):
        rig.pose(BEND)
    assert rig.number_of_binds == 2
    rig.pose(BEND)


def test_threads_do_not_change_the_bits(rig):
    for method in ("lbs", "reduced-arap"):
        one = bindpose.Rig(rig.mesh, rig.handles).pose(BEND, method=method, threads=1)
        many = bindpose.Rig(rig.mesh, rig.handles).pose(BEND, method=method, threads=4)
        assert np.array_equal(points_of(one), points_of(many))


def test_several_threads_may_pose_one_rig(rig):
    maps = np.tile(np.eye(3, 4), (2, 1, 1))
    maps[1, 1, 3] = 0.5
    poses = [BEND, {"b2": {"translate": [0, 1, 0]}}, maps]
    expected = [rig.pose(pose) for pose in poses]
    wrong = []

    def work(k):
        for _ in range(200):
            if not np.array_equal(rig.pose(poses[k]), expected[k]):
                wrong.append(k)

    def fail():
        for _ in range(200):
            try:
                rig.pose({"b9": {}})
                wrong.append("no error")
            except bindpose.InvalidInput:
                pass

    threads = [threading.Thread(target=work, args=(k,)) for k in range(3)] + [threading.Thread(target=fail)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_a_mesh_of_arrays_with_its_weights(rig):
    again = bindpose.Rig(BAR, bindpose.handles(bones=BONES), weights=rig.weights)
    assert np.array_equal(again.pose(BEND), rig.pose(BEND))
    assert again.report == rig.report and again.extrema == rig.extrema


def test_pseudo_edges_are_no_handles():
    handles = bindpose.handles(points=[[0, 0.5, 0.5], [3, 0.5, 0.5], [6, 0.5, 0.5]], pseudo_edges=[[0, 1], [1, 2]])
    rig = bindpose.bind(BAR, handles, domain="surface")
    moved = rig.pose(np.tile(np.eye(3, 4), (3, 1, 1)) + [0, 0, 0, 0.5])
    assert moved == pytest.approx(np.array(BAR[0]) + 0.5, abs=1e-9)


def test_the_mesh_of_the_caller_and_the_rest_shape_are_apart(dataset_rig):
    mesh = to_dataset(BAR)
    rig = bindpose.bind(mesh, bindpose.handles(bones=BONES), domain="surface")
    vtk_to_numpy(mesh.GetPoints().GetData())[:] += 7
    assert np.array_equal(points_of(rig.pose({})), np.array(BAR[0], dtype=float))
    with pytest.raises(bindpose.InvalidInput, match="shares no memory"):
        rig.pose({}, out=vtk_to_numpy(rig.mesh.GetPoints().GetData()))


def test_the_rig_has_the_bits_of_the_mesh():
    thin = to_dataset(shapes.bar(size=(6.0, 1 / 3, 1 / 7)))
    handles = bindpose.handles(points=[[0, 0, 0], [6, 0, 0]])
    weighted = bindpose.weights(thin, handles, domain="surface")
    rig = bindpose.Rig(weighted, handles)
    assert np.array_equal(points_of(rig.mesh), points_of(thin))
    pose = {"p1": {"translate": [0, 0, 0.1]}}
    assert np.array_equal(points_of(rig.pose(pose)), points_of(bindpose.deform(weighted, handles, {"handles": pose})))


def test_normals_at_rest_do_not_stay():
    mesh = to_dataset(shapes.sphere(8, 4))
    weights = np.ones((mesh.GetNumberOfPoints(), 1))
    add_point_array(mesh, "Weights", weights, ["p1"])
    add_point_array(mesh, "Normals", points_of(mesh))
    mesh.GetPointData().SetActiveNormals("Normals")
    posed = bindpose.Rig(mesh, bindpose.handles(points=[[0, 0, 0]])).pose({"p1": {"scale": 2}})
    assert posed.GetPointData().GetNormals() is None and mesh.GetPointData().GetNormals() is not None


def test_saved_rigs_can_be_posed(rig, tmp_path):
    rig.save(tmp_path / "bar.glb")
    back = bindpose.read_rig(tmp_path / "bar.glb")
    assert back.animation is None and back.number_of_binds == 0
    posed = back.pose(BEND)
    assert np.abs(points_of(posed) - rig.pose(BEND)).max() < 1e-5
    assert vtk_to_numpy(posed.GetPoints().GetData()).shape == (len(BAR[0]), 3)


def test_frames_of_a_saved_rig_are_poses(rig, tmp_path):
    report = rig.save(tmp_path / "bar.glb", frames=[BEND, {"handles": {}}, BEND], fps=12)
    assert report["animation_error"] < 1e-5
    back = bindpose.read_rig(tmp_path / "bar.glb")
    assert len(back.animation["frames"]) == 3 and back.animation["fps"] == pytest.approx(12)
    posed = bindpose.deform(back.mesh, back.handles, back.animation)
    assert points_of(posed[2]) == pytest.approx(np.array(rig.pose(BEND)), abs=1e-5)
    assert back.save(tmp_path / "again.glb")["status"] == "ok"


def test_options_are_in_the_signature():
    import inspect

    names = list(inspect.signature(bindpose.Rig.pose).parameters)
    assert names[:4] == ["self", "pose", "out", "threads"] and "number_of_clusters" in names and "options" not in names
    assert all(f"        {name} : " in bindpose.Rig.pose.__doc__ for name in itertools.islice(names, 4, None))
