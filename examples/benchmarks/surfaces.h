#ifndef bindpose_examples_benchmarks_surfaces_h
#define bindpose_examples_benchmarks_surfaces_h

// Surfaces of any size for benchmarks. They are computed instead of read from files.

#include "geometry/mesh.h"

#include <cstdint>

namespace bindpose::benchmarks
{

/// Return a closed, bumpy sphere with about the given number of triangles.
TriangleMesh bumpy_sphere(Index triangles);
/// Return the sphere without the triangles of one cap. The number of open edges (`open_edges`)
/// grows with the square root of the number of triangles.
TriangleMesh open_bumpy_sphere(Index triangles);
/// Return the sphere cut into patches that do not touch: a triangle soup with about one open edge
/// per four triangles.
TriangleMesh patches(Index triangles);

/// Random number generator (splitmix64). Unlike the distributions of std, it gives the same numbers
/// with every compiler and on every machine.
class Random
{
public:
  explicit Random(std::uint64_t seed = 1) : state_(seed) {}
  double uniform(double lower, double upper);
  Index below(Index count)
  {
    return static_cast<Index>(this->uniform(0.0, static_cast<double>(count)));
  }

private:
  std::uint64_t state_;
};

/// Return #count x 3 points in a box around the unit sphere; the points are always the same.
Points scattered_points(Index count);

} // namespace bindpose::benchmarks

#endif
