#ifndef bindpose_tests_core_fuzz_hostile_surfaces_h
#define bindpose_tests_core_fuzz_hostile_surfaces_h

// Difficult surfaces and points. They test algorithms that decide on which side of a triangle a
// point is, and whether triangles cross or touch.

#include "support/meshes.h"

namespace bindpose::test
{

/// Return a random surface of size about 1 near the origin, with approximately `maximum_triangles`
/// triangles or fewer. The type is random: triangles with corners on a lattice or anywhere, needles
/// and slivers, layers, a fan, one or two triangles, or a damaged closed surface. A damaged surface
/// has holes, reversed or repeated triangles, or separated corners.
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
