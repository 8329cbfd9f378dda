#ifndef bindpose_inside_ftetwild_process_h
#define bindpose_inside_ftetwild_process_h

#include "base/execution.h"
#include "base/mesh.h"

#include <string>

namespace bindpose
{

struct FtetwildOptions
{
  /// How far the tets' boundary may be from the surface, as a fraction of its diagonal (fTetWild's
  /// --epsr), 0.00001 … 0.1.
  double epsilon = 1e-3;
  double edge =
    0.0; ///< edge length aimed at, a fraction of the diagonal (--lr); 0: fTetWild's 0.05
  double time_limit = 120.0; ///< seconds after which it is killed, > 0
  Index memory_limit = 0; ///< MiB of address space that it may use, 0: no limit
};

/// Path of the executable FloatTetwild_bin or ftetwild on PATH, empty when there is none. The
/// environment variable BINDPOSE_FTETWILD alone counts when it is set.
std::string find_ftetwild();

/// Tets of what a surface encloses by fTetWild (Hu, Schneider, Wang, Zorin, Panozzo, Fast
/// Tetrahedral Meshing in the Wild, 2020), a program of its own that is run when it is installed.
/// It takes any triangles, moves them within epsilon and keeps none of their vertices. Inside is
/// where the winding number of what became of the surface is above 0.5.
///
/// `mesh` has positive tets and no stray vertices; none when nothing is enclosed.
///
/// The surface and the result go through a temporary folder, which is removed on every way out, by
/// a guarding shell process (ScratchFolder) also when this process is killed. fTetWild runs in a
/// process group of its own, with context.threads() threads.
///
/// invalid_input: not finite, larger than 1e100, ids out of range, no triangles, all in one point,
/// an option out of range. unavailable: no executable; the message names it and where to get it.
/// cancelled: it is killed within 20 ms. internal_error: it crashed, ended with an error, ran out
/// of time or memory, or wrote no mesh; no temporary folder. Cost: seconds to minutes.
Status run_ftetwild(PointsView points, TrianglesView triangles, const FtetwildOptions& options,
  TetMesh& mesh, ExecutionContext& context);

} // namespace bindpose

#endif
