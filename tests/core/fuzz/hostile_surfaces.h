#ifndef bindpose_tests_core_fuzz_hostile_surfaces_h
#define bindpose_tests_core_fuzz_hostile_surfaces_h

// Surfaces and points that are hard for algorithms that decide sides, crossings and contacts.

#include "support/meshes.h"

namespace bindpose::test
{

/// Return a surface of a random type with at most about `most` triangles, of size about 1 near the
/// origin. The types are: random triangles with corners on a lattice or anywhere, needles, slivers,
/// layers, fans, closed surfaces, surfaces with holes, with reversed or repeated triangles or with
/// parts of very different sizes, and one or two triangles.
TriangleMesh hostile_surface(Random& random, Index most);

/// Return a closed surface: the directions of its triangles cancel at every edge. The types are
/// self-crossing spheres, very thin rings, nested spheres at distances down to 1e-5, cubes of a
/// lattice that touch at edges and vertices, facets of random tets, and bipyramids of many needles.
TriangleMesh hostile_closed_surface(Random& random, Index most);

/// Return the same surface after a random scaling and translation: tiny, huge, as far from the
/// origin as the range of double permits, or unchanged.
TriangleMesh placed(Random& random, TriangleMesh mesh);

/// Return a random point in a special position: on or near a vertex, edge or face, in the plane of
/// a face, on an axis-parallel line through a vertex, anywhere in the bounding box, or far away.
Vec3 hostile_point(Random& random, const TriangleMesh& mesh);

} // namespace bindpose::test

#endif
