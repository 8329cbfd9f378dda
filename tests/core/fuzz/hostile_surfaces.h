#ifndef bindpose_tests_core_fuzz_hostile_surfaces_h
#define bindpose_tests_core_fuzz_hostile_surfaces_h

// Surfaces and points made to hurt whoever decides sides, crossings and touching.

#include "support/meshes.h"

namespace bindpose::test
{

/// Up to about `most` triangles of a random kind, of size about 1 near the origin: heaps on a
/// lattice or anywhere, needles, slivers, layers, fans, closed surfaces, those with holes, flipped
/// or doubled triangles, parts of very different sizes; one triangle, two triangles.
TriangleMesh hostile_surface(Random& random, Index most);

/// Closed: all directions of edges cancel. Spheres that cross themselves, rings thinner than a
/// hair, spheres in spheres down to 1e-5, cubes on a lattice that touch in edges and vertices,
/// heaps of tets, bipyramids of many needles.
TriangleMesh hostile_closed_surface(Random& random, Index most);

/// The same surface elsewhere: tiny, huge, as far from the origin as doubles can bear, or left
/// alone.
TriangleMesh placed(Random& random, TriangleMesh mesh);

/// A point with a meaning for the surface: on a vertex, edge or face or a hair's breadth off, in
/// the plane of a face, on a line along an axis through a vertex, anywhere in its box, far away.
Vec3 hostile_point(Random& random, const TriangleMesh& mesh);

} // namespace bindpose::test

#endif
