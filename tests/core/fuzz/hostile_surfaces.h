#ifndef bindpose_tests_core_fuzz_hostile_surfaces_h
#define bindpose_tests_core_fuzz_hostile_surfaces_h

// Difficult surfaces and points. They test algorithms that decide on which side of a triangle a
// point is, and whether triangles cross or touch.

#include "support/meshes.h"

namespace bindpose::test
{

/// Return a random surface near the origin. Its size is about 1, and it has at most about
/// `maximum_triangles` triangles. The surface is one of: triangles between random points, triangles
/// between lattice points, separate needles and slivers, parallel layers, a fan, one or two
/// triangles, or a closed surface with random defects. The defects are holes, reversed triangles,
/// repeated triangles, and corners that are detached from their neighbors.
TriangleMesh hostile_surface(Random& random, Index maximum_triangles);

/// Return a closed surface: each edge has equally many triangles in both directions. The types are
/// self-crossing spheres, very thin rings, combinations of several such surfaces with sizes down to
/// 1e-5, cubes of a lattice that touch at edges and vertices, facets of random tets, and bipyramids
/// of many needles.
TriangleMesh hostile_closed_surface(Random& random, Index maximum_triangles);

/// Return a copy of the surface with a random change. The surface is scaled to a tiny or huge size
/// (up to the limits of the range of double), moved far from the origin, or unchanged.
TriangleMesh randomly_transformed(Random& random, TriangleMesh mesh);

/// Return a random point in a special position: on or near a vertex, edge or face, in the plane of
/// a face, on an axis-parallel line through a vertex, anywhere in the bounding box, or far away.
Vec3 hostile_point(Random& random, const TriangleMesh& mesh);

} // namespace bindpose::test

#endif
