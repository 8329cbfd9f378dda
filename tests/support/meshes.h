#ifndef bindpose_tests_support_meshes_h
#define bindpose_tests_support_meshes_h

// Meshes whose winding numbers, volumes and weights are known, so that tests can state facts.

#include "base/mesh.h"

#include <cstdint>

namespace bindpose::test
{

/// [lower, upper]^3, 12 triangles outwards, side k's triangles are 2k, 2k+1 in the order
/// -x +x -y +y -z +z.
TriangleMesh cube(double lower = -1.0, double upper = 1.0);
/// An axis-aligned box of 12 triangles.
TriangleMesh box(const Vec3& lower, const Vec3& upper);
/// The cube without its +z side.
TriangleMesh open_cube(double lower = -1.0, double upper = 1.0);
/// Subdivided icosahedron: 20 * 4^levels triangles on the unit sphere, outwards.
TriangleMesh sphere(int levels, double radius = 1.0, const Vec3& center = Vec3::Zero());
/// around * across * 2 triangles, axis z.
TriangleMesh torus(int around, int across, double radius, double tube);
/// nx * ny squares on [0, sx] x [0, sy], z = 0, each cut along the same diagonal, upwards.
TriangleMesh grid(int nx, int ny, double sx = 1.0, double sy = 1.0);
/// Both meshes side by side, the second's ids shifted.
TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b);
TriangleMesh translated(TriangleMesh mesh, const Vec3& by);
/// All triangles turned inside out.
TriangleMesh flipped(TriangleMesh mesh);
/// Every triangle with corners of its own, as in an STL file.
TriangleMesh unwelded(const TriangleMesh& mesh);

/// A box of nx * ny * nz cells of six tets each (Kuhn's subdivision), all positive.
TetMesh tet_box(
  int nx, int ny, int nz, const Vec3& lower = Vec3::Zero(), const Vec3& upper = Vec3::Ones());

/// Vertices - edges + facets - tets: 1 for a ball, 0 for a solid torus, 2 for a shell.
Index euler_characteristic(const TetMesh& mesh);

/// Deterministic numbers in [0, 1): the same on every machine, unlike std's distributions.
class Random
{
public:
  explicit Random(std::uint64_t seed = 1) : state_(seed) {}
  double uniform();
  double uniform(double lower, double upper) { return lower + (upper - lower) * this->uniform(); }
  Vec3 in_box(const Vec3& lower, const Vec3& upper);
  Index below(Index count)
  {
    return static_cast<Index>(this->uniform() * static_cast<double>(count));
  }

private:
  std::uint64_t state_;
};

} // namespace bindpose::test

#endif
