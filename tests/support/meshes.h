#ifndef bindpose_tests_support_meshes_h
#define bindpose_tests_support_meshes_h

// Meshes whose winding numbers, volumes and weights are known, so that tests can check results.

#include "geometry/mesh.h"

#include <cstdint>

namespace bindpose::test
{

/// Return [lower, upper]^3 as 12 triangles, oriented outwards. The triangles of face k are 2k and
/// 2k + 1, in the order -x +x -y +y -z +z.
TriangleMesh cube(double lower = -1.0, double upper = 1.0);
/// Return an axis-aligned box of 12 triangles.
TriangleMesh box(const Vec3& lower, const Vec3& upper);
/// Return the cube without its face toward +z.
TriangleMesh open_cube(double lower = -1.0, double upper = 1.0);
/// Return a subdivided icosahedron of 20 * 4^levels triangles on a sphere, oriented outwards.
TriangleMesh sphere(int levels, double radius = 1.0, const Vec3& center = Vec3::Zero());
/// Return a torus around the z axis, of major_segments * minor_segments * 2 triangles.
TriangleMesh torus(int major_segments, int minor_segments, double radius, double tube);
/// Return nx * ny squares on [0, sx] x [0, sy] in the plane z = 0, oriented upwards. All squares
/// are cut along the same diagonal.
TriangleMesh grid(int nx, int ny, double sx = 1.0, double sy = 1.0);
/// Combine two meshes. The vertex ids of the second mesh are shifted.
TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b);
TriangleMesh translated(TriangleMesh mesh, const Vec3& translation);
/// Reverse the orientation of all triangles.
TriangleMesh flipped(TriangleMesh mesh);
/// Give each triangle its own corners, as in an STL file.
TriangleMesh unwelded(const TriangleMesh& mesh);

/// Return a box of nx * ny * nz cells of six tets each (Kuhn's subdivision), all of positive
/// volume.
TetMesh tet_box(
  int nx, int ny, int nz, const Vec3& lower = Vec3::Zero(), const Vec3& upper = Vec3::Ones());

/// Return vertices - edges + facets - tets: 1 for a ball, 0 for a solid torus, 2 for a ball with a
/// cavity.
Index euler_characteristic(const TetMesh& mesh);
/// Return vertices - edges + triangles: 2 for a sphere, 0 for a torus. For a closed surface, this
/// is twice the Euler characteristic of its inside.
Index euler_characteristic(const TriangleMesh& mesh);

/// Deterministic random numbers in [0, 1). They are the same on every machine, unlike those of the
/// distributions in std.
class Random
{
public:
  explicit Random(std::uint64_t seed = 1) : state_(seed) {}
  double uniform();
  double uniform(double lower, double upper) { return lower + (upper - lower) * this->uniform(); }
  Vec3 in_box(const Vec3& lower, const Vec3& upper);
  /// Return a point in [-size, size]^3.
  Vec3 in_cube(double size = 1.0)
  {
    return this->in_box(Vec3::Constant(-size), Vec3::Constant(size));
  }
  Index below(Index count)
  {
    return static_cast<Index>(this->uniform() * static_cast<double>(count));
  }

private:
  std::uint64_t state_;
};

/// Return random points in [-reach, reach]^3.
Points random_points(Index count, double reach, std::uint64_t seed);

} // namespace bindpose::test

#endif
