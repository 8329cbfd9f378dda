#ifndef bindpose_benchmarks_libigl_arap_h
#define bindpose_benchmarks_libigl_arap_h

/// libigl's arap_dof, spokes, in single precision, as a library of its own: it is compiled for this
/// machine alone (-march=native), and its Eigen must not meet that of a portable build.
extern "C"
{
  struct LibiglMesh
  {
    int vertices, triangles, handles;
    const double* points; ///< row by row
    const int* corners; ///< row by row
    const double* weights; ///< column by column
  };

  /// Binds. `held` vertices are dragged to `targets` (row by row), nothing else is given.
  void libigl_arap_bind(
    const LibiglMesh* mesh, int clusters, int held, const int* at, const double* targets);

  /// Processor time of so many solves from rest, seconds.
  double libigl_arap_seconds(int solves, int iterations);
}

#endif
