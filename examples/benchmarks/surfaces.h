#ifndef bindpose_examples_benchmarks_surfaces_h
#define bindpose_examples_benchmarks_surfaces_h

// Surfaces of any size for benchmarks, made on the spot: no files needed.

#include "base/mesh.h"

#include <cstdint>

namespace bindpose::benchmarks
{

/// A closed, bumpy sphere of about the given number of triangles.
TriangleMesh bumpy_sphere(Index triangles);
/// The same without the triangles of one cap: `open_edges` grows with the square root of the size.
TriangleMesh open_bumpy_sphere(Index triangles);
/// The same cut into patches that do not touch: a soup with about one open edge in four triangles.
TriangleMesh patches(Index triangles);

/// The same numbers on every machine, unlike std's (splitmix64).
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

/// #count x 3 points in a box around the unit sphere, the same ones each time.
Points scattered_points(Index count);

} // namespace bindpose::benchmarks

#endif
