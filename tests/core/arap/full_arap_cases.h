#ifndef bindpose_tests_core_arap_full_arap_cases_h
#define bindpose_tests_core_arap_full_arap_cases_h

// Meshes and handles that the tests of full as-rigid-as-possible (ARAP) deformation share.

#include "arap/full_arap.h"
#include "support/handles.h"
#include "support/meshes.h"

namespace bindpose::test
{

constexpr ArapEnergy every_energy[] = { ArapEnergy::elements, ArapEnergy::spokes_and_rims,
  ArapEnergy::spokes };

struct LabeledBar
{
  TetMesh mesh;
  Handles handles;
  std::vector<Index> labels; ///< region label of each vertex
};

/// Return the bar [0, 4] x [0, 1] x [0, 1]. Regions 1, 2 and 3 are the cross sections at x = 0, 2
/// and 4.
inline LabeledBar labeled_bar(int cells)
{
  LabeledBar bar;
  const int across = std::max(2, cells / 4);
  bar.mesh = tet_box(cells, across, across, Vec3::Zero(), Vec3(4, 1, 1));
  const char* const names[] = { "left", "middle", "right" };
  bar.labels.assign(static_cast<std::size_t>(bar.mesh.points.rows()), 0);
  for (Index r = 0; r < 3; ++r)
  {
    const double x = 2.0 * static_cast<double>(r);
    bar.handles.push_back(region_handle(names[r], r + 1, Vec3(x, 0.5, 0.5)));
    for (Index v = 0; v < bar.mesh.points.rows(); ++v)
    {
      if (std::abs(bar.mesh.points(v, 0) - x) < 1e-9)
      {
        bar.labels[static_cast<std::size_t>(v)] = r + 1;
      }
    }
  }
  return bar;
}

inline Status bind(FullArap& arap, const LabeledBar& bar, ArapEnergy energy)
{
  ExecutionContext context;
  return arap.bind(context, bar.mesh.points, bar.mesh.tets, bar.handles, { energy, bar.labels });
}

/// Return options for the given number of iterations without acceleration.
constexpr FullArap::SolveOptions plain(Index count, FullArap::Start start)
{
  return { 0.0, count, start, 0 };
}

} // namespace bindpose::test

#endif
