"""Test the checks of real_meshes.py: each check finds its error, and reports nothing for a correct result."""

import math
import pathlib
import signal
import sys
import time

import numpy as np
import pytest
import vtk

TESTS = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(TESTS), str(TESTS / "support")]
import accuracy_checks  # noqa: E402
import furniture  # noqa: E402
import real_meshes  # noqa: E402
import result_checks  # noqa: E402
import separate_parts  # noqa: E402
from accuracy_checks import barycentric  # noqa: E402
from limited_process import run_limited  # noqa: E402
from result_checks import write_tets  # noqa: E402

REGULAR = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
CERTIFIED = {"relative_gap": 1e-9, "kkt_residual": 1e-7, "bounds_violation": 0.0}


def triangulated(part):
    """Return the points and triangles of a part of furniture.py."""
    return part[0], np.array([[face[0], a, b] for face in part[1] for a, b in zip(face[1:-1], face[2:])])


def tets_of_boxes(xs, ys, zs):
    """Return the points and tets of a grid of boxes, with six tets in each box."""
    points = np.array([[x, y, z] for x in xs for y in ys for z in zs], float)
    tets = []
    for cell in np.ndindex(len(xs) - 1, len(ys) - 1, len(zs) - 1):
        for order in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
            corner, path = list(cell), []
            for axis in (None, *order):
                if axis is not None:
                    corner[axis] += 1
                path.append((corner[0] * len(ys) + corner[1]) * len(zs) + corner[2])
            tets.append(path)
    return points, np.array(tets)


def test_tets_that_bridge_a_gap_are_taken_out(tmp_path, monkeypatch):
    # The model has a gap: points with |x| <= 0.1 are outside. The middle boxes of tets bridge the gap, because they
    # reach from x = -0.2 to 0.2.
    def inside(_program, _model, places, _folder):
        return np.where(np.abs(places[:, 0]) > 0.1, 1.0, 0.0)

    monkeypatch.setattr(accuracy_checks, "winding_at", inside)
    points, tets = tets_of_boxes([-1, -0.5, -0.2, 0.2, 0.5, 1], range(5), range(5))
    write_tets(tmp_path / "tets.vtu", points, tets)
    (tmp_path / "model.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n")
    accuracy_checks.open_gaps("", tmp_path / "model.obj", tmp_path / "tets.vtu")
    left_points, left = result_checks.read_tets(tmp_path / "tets.vtu")
    in_middle = np.abs(points[tets].mean(axis=1)[:, 0]) < 0.2
    left_in_middle = np.abs(left_points[left].mean(axis=1)[:, 0]) < 0.2
    assert (~left_in_middle).sum() == (~in_middle).sum()
    assert left_in_middle.sum() < (in_middle & ~accuracy_checks.are_inner(tets)).sum()
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(tmp_path / "single.vtp"))
    reader.Update()
    assert reader.GetOutput().GetNumberOfPolys() == 1


@pytest.mark.parametrize("xs, bridged", [([-1, 0, 1], 2 / 13), ([-1, -0.5, -0.002], 0)])
def test_films_and_bridged_gaps_are_measured_by_area(tmp_path, monkeypatch, xs, bridged):
    # The model has two boxes with a gap of 0.004 between them, and a square above. The area of the boxes is 12, of
    # which 2 is at the gap. The area of the square is 1.
    def inside(_program, _model, places, _folder):
        x, others = np.abs(places[:, 0]), places[:, 1:]
        return np.where((x > 0.002) & (x < 1) & (others > 0).all(axis=1) & (others < 1).all(axis=1), 1.0, 0.0)

    monkeypatch.setattr(accuracy_checks, "winding_at", inside)
    lines = []
    for left, right in ((-1, -0.002), (0.002, 1)):
        lines += [f"v {x} {y} {z}" for x in (left, right) for y in (0, 1) for z in (0, 1)]
        lines += ["f -8 -7 -5 -6", "f -4 -2 -1 -3", "f -8 -4 -3 -7", "f -6 -5 -1 -2", "f -8 -6 -2 -4", "f -7 -3 -1 -5"]
    lines += ["v 0 0 1.5", "v 1 0 1.5", "v 1 1 1.5", "v 0 1 1.5", "f -4 -3 -2 -1"]
    (tmp_path / "model.obj").write_text("\n".join(lines))
    points, tets = tets_of_boxes(xs, [0, 1], [0, 1])
    write_tets(tmp_path / "tets.vtu", points, tets)
    found = accuracy_checks.surface_without_tets("", tmp_path / "model.obj", tmp_path / "tets.vtu", 0.005)
    assert found["films"] == pytest.approx(1 / 13, abs=0.01)
    assert found["bridged"] == pytest.approx(bridged, abs=0.01 if bridged else 0)


# ---- Models ----------------------------------------------------------------------------------------


def test_obj_faces_become_fans(tmp_path):
    path = tmp_path / "model.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -4/1 -3/1 -1/1\n")
    points, triangles = result_checks.read_obj(path)
    assert points.shape == (4, 3)
    assert triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 3]]


def test_made_furniture_is_the_same_every_time(tmp_path):
    for make in furniture.FURNITURE:
        first, second = tmp_path / "first.obj", tmp_path / "second.obj"
        furniture.write_obj(first, *make())
        furniture.write_obj(second, *make())
        assert first.read_text().split("\n", 2)[2] == second.read_text().split("\n", 2)[2]


def test_a_sample_is_fixed_and_has_all_sizes():
    models = [real_meshes.Model(f"m{k}", 10 * k, None) for k in range(100)]
    sample = real_meshes.sample(models, 10)
    assert sample == real_meshes.sample(models[::-1], 10)
    assert [model.size // 100 for model in sample] == list(range(10))


def test_percentiles():
    values = list(range(1, 101))
    assert [real_meshes.percentile(values, p) for p in (50, 90, 95, 99, 100)] == [50, 90, 95, 99, 100]
    assert math.isnan(real_meshes.percentile([], 50))


# ---- Weights ---------------------------------------------------------------------------------------


def test_no_area_is_lost_when_weights_are_read(tmp_path):
    """The area of a file's polygons is that of their triangles: a quad with two corners at the same place, a concave
    pentagon, a square and a triangle.
    """
    corners = [(0, 0), (1, 0), (0, 1), (0, 1),  # a triangle as a quad, area 1/2
               (2, 0), (4, 0), (4, 2), (3, 0.5), (2, 2),  # concave, area 4 - 3/2
               (5, 0), (6, 0), (6, 1), (5, 1), (7, 0), (8, 0), (7, 1)]
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    for x, y in corners:
        points.InsertNextPoint(x, y, 0)
    for cell in (range(4), range(4, 9), range(9, 13), range(13, 16)):
        cells.InsertNextCell(len(cell), list(cell))
    surface, array, writer = vtk.vtkPolyData(), vtk.vtkDoubleArray(), vtk.vtkXMLPolyDataWriter()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    array.SetName("Weights")
    array.SetNumberOfTuples(len(corners))
    surface.GetPointData().AddArray(array)
    writer.SetFileName(str(tmp_path / "w.vtp"))
    writer.SetInputData(surface)
    writer.Write()
    read, triangles, _ = result_checks.read_weights(tmp_path / "w.vtp")
    assert len(triangles) == 2 + 3 + 2 + 1
    a, b, c = (read[triangles[:, k]][:, :2] for k in range(3))
    assert np.cross(b - a, c - a).sum() / 2 == pytest.approx(0.5 + 2.5 + 1 + 0.5)
    assert result_checks.areas(read, triangles).sum() == pytest.approx(4.5)


def test_good_weights_have_no_errors():
    assert result_checks.weights_array_errors(np.full((5, 2), 0.5), 2) == []
    assert result_checks.certificate_errors(CERTIFIED) == []


@pytest.mark.parametrize("row, words", [([0.5, math.nan], "not finite"), ([0.5, 0.5 + 1e-8], "differs from one"),
                                        ([1.25, -0.25], "range from -0.25"), ([1.0], "shape")])
def test_wrong_weights_are_found(row, words):
    errors = result_checks.weights_array_errors(np.array([row]), 2)
    assert any(words in error for error in errors)


@pytest.mark.parametrize("key", CERTIFIED)
def test_a_missing_or_large_certificate_is_found(key):
    assert key in result_checks.certificate_errors({**CERTIFIED, key: 1e-3})[0]
    assert key in result_checks.certificate_errors({k: v for k, v in CERTIFIED.items() if k != key})[0]


# ---- Tets ------------------------------------------------------------------------------------------


def test_dihedral_angles_of_known_tets():
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    points, tets = np.vstack([REGULAR, corner]), np.array([[0, 1, 2, 3], [4, 5, 6, 7]])
    angles = result_checks.smallest_dihedral_angles(points, tets)
    assert angles == pytest.approx([math.degrees(math.acos(1 / 3)), math.degrees(math.acos(1 / math.sqrt(3)))])


def test_good_tets_have_no_errors(tmp_path):
    write_tets(tmp_path / "tets.vtu", REGULAR, [[0, 2, 1, 3]])
    found = result_checks.check_tets(tmp_path / "tets.vtu", {"volume": 8 / 3})
    assert found["wrong"] == []
    assert found["tets"] == 1 and found["below_5"] == 0.0


def test_wrong_tets_are_found(tmp_path):
    for tets, volume, words in (([[0, 1, 2, 3]], -8 / 3, "no positive volume"), ([[0, 2, 1, 3]] * 2, 16 / 3, "twice"),
                                ([[0, 2, 1, 3]], 1.0, "report's volume"), ([], 0.0, "no tets")):
        write_tets(tmp_path / "tets.vtu", REGULAR, tets)
        wrong = result_checks.check_tets(tmp_path / "tets.vtu", {"volume": volume})["wrong"]
        assert any(words in error for error in wrong)


def test_barycentric_coordinates():
    inside = np.array([[0.1, 0.2, 0.3, 0.4]])
    assert barycentric(REGULAR, np.array([[0, 1, 2, 3]]), inside @ REGULAR) == pytest.approx(inside)


# ---- Refusals --------------------------------------------------------------------------------------


def test_refusals_are_compared_with_the_model(tmp_path):
    for make, verb, true in ((furniture.needles_only, "weights", True), (furniture.needles_only, "tets", True),
                             (furniture.rug, "tets", True), (furniture.rug, "weights", False),
                             (furniture.table, "weights", False)):
        path = tmp_path / "model.obj"
        furniture.write_obj(path, *make())
        wrong = result_checks.check_refusal(verb, None, path, "a sentence", 8)["wrong"]
        assert (wrong == []) is true, (make.__name__, verb)
    assert result_checks.check_refusal("weights", None, path, "two\nlines", 8)["wrong"]


# ---- Separate parts --------------------------------------------------------------------------------


def box_at(x, size=1.0):
    return furniture.box((x, 0, 0), (x + size, size, size))


@pytest.mark.parametrize("parts, count", [
    ([box_at(0), box_at(1.5)], 2),
    ([box_at(0), box_at(1.0)], 1),  # the boxes touch
    ([box_at(0), furniture.box((0.5, 0.5, -1), (0.51, 0.51, 2))], 1),  # the boxes cross
    ([box_at(0, 3.0), furniture.box((1, 1, 1), (2, 2, 2))], 1),  # the second box is inside of the first one
    ([box_at(0), box_at(1.2), furniture.box((0.5, 0.4, 0.4), (1.7, 0.5, 0.5))], 1),  # the third box joins the other two
])
def test_separate_parts(parts, count):
    points, triangles = triangulated(furniture.join(*parts))
    assert len(np.unique(separate_parts.separate_parts(points, triangles))) == count


def test_back_sides_do_not_hide_what_a_part_encloses():
    inner = furniture.box((1, 1, 1), (2, 2, 2))
    for outer, parts in ((box_at(0, 3.0), 1), (furniture.sheet(1, (0, 0, -1), (3, 0, 0), (0, 3, 0)), 2)):
        points, triangles = triangulated(furniture.join(outer, inner))
        doubled = np.concatenate([triangles, triangles[:-12, ::-1]])  # the last 12 triangles are the inner box
        assert len(np.unique(separate_parts.separate_parts(points, doubled))) == parts
        fronts = separate_parts.front_sides(points, doubled)
        assert fronts.sum() == (24 if parts == 1 else len(doubled))


def test_leaks_between_parts():
    points, triangles = triangulated(furniture.join(box_at(0), box_at(3)))
    handles = separate_parts.farthest_points(points, triangles, 4)
    weights = np.zeros((len(points), 4))
    for home in (points[:, 0] < 2, points[:, 0] > 2):
        own = [k for k, vertex in enumerate(handles) if home[vertex]]
        weights[np.ix_(home, own)] = 1 / len(own)
    weights[handles] = np.eye(4)
    assert separate_parts.largest_leak(points, triangles, weights) == 0.0
    stranger = next(k for k, vertex in enumerate(handles) if points[vertex, 0] > 2)
    vertex = next(v for v in range(8) if v not in handles)
    weights[vertex, stranger] = 0.2
    assert separate_parts.largest_leak(points, triangles, weights) == pytest.approx(0.2)


def test_the_inside_leads_from_one_open_part_to_another():
    points, triangles = triangulated(furniture.join(box_at(0, 2.0), box_at(2.2, 2.0)))
    places = points[triangles].mean(axis=1)
    faces_the_gap = ((places[:, 0] == 2.0) | (places[:, 0] == 2.2))
    sides = points[points[:, 0] < 2.1], points[points[:, 0] > 2.1]
    assert not separate_parts.inside_leads(*sides, points, triangles)
    assert separate_parts.inside_leads(*sides, points, triangles[~faces_the_gap])


# ---- Processes -------------------------------------------------------------------------------------


def test_triangles_are_turned_to_agree_with_their_neighbors():
    """Two boxes, one of which has triangles turned: fewer than half of them, or all but a few."""
    points, triangles = triangulated(furniture.join(box_at(0), box_at(3)))
    middles = [points[:8].mean(axis=0), points[8:].mean(axis=0)]
    assert separate_parts.winding_numbers(middles, points, triangles) == pytest.approx([1, 1])
    for turned in ([0, 5], [13], list(range(12, 22))):
        changed = triangles.copy()
        changed[turned] = changed[turned][:, ::-1]
        found = separate_parts.oriented(points, changed)
        most_of_the_second = len(turned) == 10
        assert separate_parts.winding_numbers(middles, points, found) == pytest.approx([1, -1 if most_of_the_second else 1])


def test_a_process_that_takes_too_long_is_ended_with_its_children(tmp_path):
    started = time.monotonic()
    words = ["bash", "-c", f"sleep 100 & echo $! >{tmp_path}/child; wait"]
    done = run_limited(words, 0.5, tmp_path / "log")
    assert done.over_limit and done.exit_code == -signal.SIGTERM
    assert time.monotonic() - started < 30
    child = (tmp_path / "child").read_text().strip()
    status = pathlib.Path(f"/proc/{child}/stat")
    assert not status.exists() or status.read_text().split()[2] == "Z"


def test_exit_codes_messages_and_peak_memory(tmp_path):
    done = run_limited(["bash", "-c", "echo wrong >&2; exit 3"], 60, tmp_path / "log")
    assert (done.exit_code, done.message, done.over_limit) == (3, "wrong", False)
    assert run_limited(["bash", "-c", "kill -SEGV $$"], 60, tmp_path / "log").exit_code == -signal.SIGSEGV
    child = f"'{sys.executable}' -c 'b = bytearray(300_000_000)'; true"
    assert run_limited(["bash", "-c", child], 60, tmp_path / "log").peak_bytes > 300e6
