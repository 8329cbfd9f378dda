"""The checks and numbers of compare_bone_heat.py."""

import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "support")]
import compare_bone_heat  # noqa: E402


def strip(length, z):
    """Return the points and triangles of a strip of 2 x length vertices. Vertices 2 k and 2 k + 1 have the coordinate x = k."""
    points = np.array([(x, y, z) for x in range(length) for y in (0, 1)], float)
    return points, np.array([(a, a + 2, b) for a in range(0, 2 * length - 2, 2) for b in (a + 1, a + 3)])


def two_strips():
    """Return two strips of ten and four columns that are not connected. The triangles are separate."""
    long, short = strip(10, 0), strip(4, 5)
    points, triangles = np.concatenate([long[0], short[0]]), np.concatenate([long[1], short[1] + 20])
    return points[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3)


def numbers(*bones):
    """Return the numbers of bones whose weights are given by functions of x and z."""
    points, triangles = two_strips()
    weights = np.array([[bone(x, z) for bone in bones] for x, _, z in points])
    return compare_bone_heat.numbers_of(compare_bone_heat.Surface(points, triangles), weights)


def test_weights_far_from_their_bone_are_leaks():
    found = numbers(lambda x, z: 1.0 if x < 4 else 0.25 if x > 7 and z == 0 else 0.005)
    assert found["leaking"] == 4 / 28 and found["leak"] == 0.25  # the last two columns of the long strip
    assert found["maxima"] == 1


def test_weights_on_several_components_are_no_leaks():
    found = numbers(lambda x, z: 0.8 if x < 4 else 0.0, lambda x, z: 0.2 if x < 4 else 1.0)
    assert found["leaking"] == 0 and found["leak"] == 0 and found["empty"] == 0
    assert compare_bone_heat.faults_of({"bindpose": found}) == []


def test_faults_are_found():
    found = numbers(lambda x, z: 0.5, lambda x, z: 0.0)
    assert compare_bone_heat.faults_of({"bindpose": found}) == ["bones without vertices: 1"]
    found = numbers(lambda x, z: 0.0 if z == 0 else 1.5)
    assert compare_bone_heat.faults_of({"bindpose": found}) == ["75 % of the vertices have no weights", "weights are from 0 to 1.5"]
    assert compare_bone_heat.faults_of({"bindpose": numbers(lambda x, z: np.nan)})
    assert compare_bone_heat.faults_of({"error": "Blender ended"}) == ["Blender ended"]
