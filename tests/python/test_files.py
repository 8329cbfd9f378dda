"""Files in the Python package: round trips, and errors as exceptions."""

import json
import warnings

import bindpose
import foreign_rig
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, points_of, to_dataset
from gltf_file import GltfFile
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData


@pytest.mark.parametrize("ending", ["off", "obj", "ply", "vtp", "mesh"])
def test_arrays_come_back_bit_for_bit(tmp_path, ending):
    vertices, faces = shapes.sphere(radius=1 / 3)
    path = tmp_path / f"sphere.{ending}"
    bindpose.write((vertices, faces), path)
    back = bindpose.read(path)
    assert isinstance(back, vtkPolyData)
    assert np.array_equal(points_of(back), np.array(vertices))
    assert back.GetNumberOfCells() == len(faces)
    assert bindpose.report(back)["counts"]["vertices"] == len(vertices)


def test_rigs(tmp_path):
    mesh = to_dataset(shapes.sphere())
    points = points_of(mesh)
    weight = np.clip(0.5 + 0.5 * points[:, 0], 0, 1)
    add_point_array(mesh, "Weights", np.stack([1 - weight, weight], axis=1), ["p1", "p2"])
    (tmp_path / "h.tgf").write_text("1 -1 0 0\n2 1 0 0\n#\n")
    pose = {"fps": 10, "frames": [{"handles": {"p2": {"translate": [0, k, 0]}}} for k in range(3)]}
    posed = bindpose.deform(mesh, tmp_path / "h.tgf", pose)
    report = bindpose.write_rig(mesh, tmp_path / "h.tgf", tmp_path / "rig.glb", frames=posed, fps=10)
    assert report["sets"] == 1 and report["animation_error"] < 1e-6
    rig = bindpose.read_rig(tmp_path / "rig.glb")
    assert points_of(rig.mesh) == pytest.approx(points, abs=1e-6)
    assert rig.handles.GetNumberOfCells() == 2
    assert rig.animation["fps"] == 10 and len(rig.animation["frames"]) == 3
    for again in (bindpose.deform(rig.mesh, rig.handles, rig.animation),
                  bindpose.deform(mesh, tmp_path / "h.tgf", tmp_path / "rig.glb")):
        for k in range(3):
            assert points_of(again[k]) == pytest.approx(points_of(posed[k]), abs=2e-6)
    # A sequence with one frame gives a list with one mesh.
    assert len(bindpose.deform(mesh, tmp_path / "h.tgf", {"frames": pose["frames"][:1]})) == 1
    bindpose.write(shapes.cube(), tmp_path / "cube.gltf")
    assert bindpose.read(tmp_path / "cube.gltf").GetNumberOfCells() == 12
    assert bindpose.read_rig(tmp_path / "cube.gltf").animation is None
    with pytest.raises(bindpose.InvalidInput, match="the file exists"):
        bindpose.write_rig(mesh, tmp_path / "h.tgf", tmp_path / "rig.glb")
    with pytest.raises(bindpose.InvalidInput, match="animation"):
        bindpose.write_rig(mesh, tmp_path / "h.tgf", tmp_path / "rig.glb", animation="shapes")


@pytest.mark.parametrize("options, joint_count", [
    ({"fingers": 12}, 44), ({"fingers": 20, "interpolation": "CUBICSPLINE"}, 60),
    ({"fingers": 15, "interpolation": "STEP", "morph_targets": 3}, 50)], ids=["linear", "cubic", "step and morph"])
def test_a_character_comes_back_with_its_poses(tmp_path, options, joint_count):
    """Compare the poses of 24 animations at their keys and between them. GltfFile evaluates them without Bindpose."""
    foreign_rig.write_foreign_rig(tmp_path / "c.gltf", animations=24, **options)
    (tmp_path / "skin.png").write_bytes(shapes.png(1, 1, lambda x, y: (0, 0, 0, 255)))
    before = GltfFile(tmp_path / "c.gltf")
    mesh, joints = bindpose.read_asset(tmp_path / "c.gltf")
    rest = before.skinned_points()
    assert points_of(mesh) == pytest.approx(rest, abs=1e-5)  # the scales of the nodes are uneven
    of_file = [before.json["nodes"][joint]["name"] for joint in before.json["skins"][0]["joints"]]
    names = [joints.GetCellData().GetAbstractArray("HandleName").GetValue(k) for k in range(joints.GetNumberOfCells())]
    assert len(names) == joint_count and len(before.json["meshes"]) >= 10
    weights = np.concatenate([before.weights(k) for k in range(len(before.json["meshes"]))])
    add_point_array(mesh, "Weights", weights[:, [of_file.index(name) for name in names]], names)
    report = bindpose.write_rig(mesh, joints, tmp_path / "out.glb", asset=tmp_path / "c.gltf")
    assert report["kept_joints"] == "yes" and "losses" not in report
    after = GltfFile(tmp_path / "out.glb")
    diagonal = np.linalg.norm(np.ptp(rest, axis=0))
    for animation in range(24):
        keys = before.key_times(animation)
        times = np.concatenate([keys, keys[:-1] + (0.1 + 0.03 * animation) * np.diff(keys)])
        posed = [before.skinned_points(animation, time) for time in times]
        assert np.abs(posed - rest).max() > 0.1 * diagonal
        errors = [np.abs(after.skinned_points(animation, time) - points).max() for time, points in zip(times, posed)]
        assert max(errors) <= 1e-6 * diagonal


def test_interpolation_of_gltf_files(tmp_path):
    """Check the evaluation of animations that other tests use: exact values between keys, and clamped ends."""
    def sampled(interpolation, path, rows, time):
        buffer = foreign_rig.Buffer()
        sampler = {"input": buffer.add([1.0, 3.0], "SCALAR"), "output": buffer.add(rows, f"VEC{len(rows[0])}"),
                   "interpolation": interpolation}
        (tmp_path / "a.gltf").write_text(json.dumps(buffer.complete({})))
        return GltfFile(tmp_path / "a.gltf").sampled(sampler, path, time)

    def cube(t):
        return [t ** 3, 1 - t, t ** 2]

    def slope(t):
        return [3 * t ** 2, -1, 2 * t]

    hermite = [slope(1), cube(1), slope(1), slope(3), cube(3), slope(3)]
    for time in (1, 1.5, 2.75, 3):
        assert sampled("CUBICSPLINE", "translation", hermite, time) == pytest.approx(cube(time), abs=1e-6)
        assert sampled("LINEAR", "translation", [cube(1), cube(3)], time) == pytest.approx(
            [26 * (time - 1) / 2 + 1, 1 - time, 4 * time - 3], abs=1e-6)
        assert sampled("STEP", "scale", [cube(1), cube(3)], time) == pytest.approx(cube(1 if time < 3 else 3))
        # Quaternions with opposite signs are the same rotation; the shorter path is the one with 0.6 radians.
        turn = sampled("LINEAR", "rotation", [[0, 0, 0, 1], [-np.sin(0.3), 0, 0, -np.cos(0.3)]], time)
        assert 2 * np.arctan2(turn[0], turn[3]) % (2 * np.pi) == pytest.approx(0.6 * (time - 1) / 2, abs=1e-6)
    for interpolation, rows in (("CUBICSPLINE", hermite), ("LINEAR", [cube(1), cube(3)]), ("STEP", [cube(1), cube(3)])):
        assert sampled(interpolation, "translation", rows, 0) == pytest.approx(cube(1))
        assert sampled(interpolation, "translation", rows, 9) == pytest.approx(cube(3))


def test_assets(tmp_path):
    foreign_rig.write_foreign_rig(tmp_path / "c.gltf", animations=1)
    (tmp_path / "skin.png").write_bytes(shapes.png(1, 1, lambda x, y: (0, 0, 0, 255)))
    mesh, joints = bindpose.read_asset(tmp_path / "c.gltf")
    assert bindpose.report(mesh)["counts"]["meshes"] == len(foreign_rig.BOXES)
    ends = bindpose.handles(points=[[0, 0, 0], [0, 2, 0]])
    rig = bindpose.bind(mesh, ends, domain="surface")
    with pytest.warns(bindpose.BindposeWarning, match="1 animation of the old joints"):
        report = rig.save(tmp_path / "out.glb", asset=tmp_path / "c.gltf", maximum_influences=4,
                          frames=[{"p2": {"translate": [0, k, 0]}} for k in range(2)], fps=4)
    assert report["losses"] == ["1 animation of the old joints"] and report["counts"]["frames"] == 2
    assert report["animation_error"] < 1e-6 and report["kept_joints"] == "no"
    # New weights for the joints of the file keep the joints and their animation.
    own = bindpose.bind(mesh, joints, domain="surface").save(tmp_path / "own.glb", asset=tmp_path / "c.gltf")
    assert own["kept_joints"] == "yes" and "losses" not in own
    # The file has the points of the asset, and its rest pose.
    again = bindpose.read_asset(tmp_path / "out.glb")
    assert again.handles.GetNumberOfCells() == 2
    assert points_of(again.mesh) == pytest.approx(points_of(mesh), abs=1e-5)
    with pytest.raises(bindpose.InvalidInput, match="does not belong to the asset .*c.gltf: it has 8 points"):
        bindpose.bind(shapes.cube(), bindpose.handles(points=[[1, 1, 1], [0, 0, 0]])).save(
            tmp_path / "cube.glb", asset=tmp_path / "c.gltf")
    mesh.GetPoints().SetPoint(0, 0, 9, 0)
    with pytest.raises(bindpose.InvalidInput, match="has other points"):
        bindpose.bind(mesh, ends, domain="surface").save(tmp_path / "moved.glb", asset=tmp_path / "c.gltf")
    with pytest.raises(bindpose.InvalidInput, match="morph targets cannot be added"):
        rig.save(tmp_path / "morph.glb", asset=tmp_path / "c.gltf", animation="morph")
    for missing in ("none.glb", "none.stl"):
        with pytest.raises(bindpose.InvalidInput, match=missing):
            bindpose.read_asset(tmp_path / missing)


def test_what_a_character_loses_is_a_warning(tmp_path):
    path = tmp_path / "c.gltf"
    foreign_rig.write_foreign_rig(path, animations=3)
    for read in (bindpose.read, bindpose.read_rig):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            read(path)
        texts = [str(each.message) for each in caught if issubclass(each.category, bindpose.BindposeWarning)]
        assert len(texts) == 1 and "does not keep 2 of 3 animations" in texts[0] and "2 materials" in texts[0]
    with pytest.warns(bindpose.BindposeWarning):
        rig = bindpose.read_rig(path)
    ownership = rig.handles.GetCellData().GetArray("Ownership")
    names = rig.handles.GetCellData().GetAbstractArray("HandleName")
    idle = [names.GetValue(k) for k in range(names.GetNumberOfValues()) if ownership.GetTuple1(k) == 2]
    assert sorted(idle) == sorted(foreign_rig.WITHOUT_WEIGHTS)


def test_existing_files_are_kept(tmp_path):
    path = tmp_path / "m.off"
    bindpose.write(shapes.cube(), path)
    with pytest.raises(bindpose.InvalidInput, match="the file exists"):
        bindpose.write(shapes.flat(), path)
    assert bindpose.read(path).GetNumberOfCells() == 12
    bindpose.write(shapes.flat(), path, overwrite=True)
    assert bindpose.read(path).GetNumberOfCells() == 2


def test_errors(tmp_path):
    with pytest.raises(bindpose.InvalidInput, match="No such file") as caught:
        bindpose.read(tmp_path / "none.off")
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, bindpose.BindposeError)
    assert caught.value.status == "invalid_input"
    assert caught.value.report["status"] == "invalid_input"
    (tmp_path / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(ValueError, match="bad.off, line 4"):
        bindpose.read(tmp_path / "bad.off")
    with pytest.raises(bindpose.InvalidInput, match="vtkImageData"):
        image = vtkImageData()
        image.SetDimensions(2, 2, 2)
        bindpose.write(image, tmp_path / "m.vtp")
    with pytest.raises(bindpose.InvalidInput, match="unknown file name extension"):
        bindpose.write(shapes.cube(), tmp_path / "m.doc")
    with pytest.raises(bindpose.InvalidInput, match="No such file"):
        bindpose.write(shapes.cube(), tmp_path / "no" / "m.off")
    assert [p.name for p in tmp_path.iterdir()] == ["bad.off"]


def test_a_file_without_a_report_has_none(tmp_path):
    assert bindpose.report(vtkPolyData()) == {}
