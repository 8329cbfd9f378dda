#ifndef bindpose_inside_ftetwild_process_h
#define bindpose_inside_ftetwild_process_h

// Tetrahedralization by the external program fTetWild.

#include "base/execution.h"
#include "geometry/mesh.h"

#include <string>

namespace bindpose
{

/// Options of run_ftetwild().
struct FtetwildOptions
{
  /// Largest distance between the tets' boundary and the surface, in bounding-box diagonals
  /// (fTetWild's --epsr), 0.00001 … 0.1.
  double epsilon = 1e-3;
  /// Target edge length in bounding-box diagonals (--lr); 0: fTetWild's default 0.05.
  double edge = 0.0;
  double time_limit = 120.0; ///< seconds (> 0) after which the program is killed
  Index memory_limit = 0; ///< largest address space of the program in MiB, 0: no limit
};

/// Return the path of the executable FloatTetwild_bin or ftetwild on PATH, or an empty string if
/// there is none. If the environment variable BINDPOSE_FTETWILD is set, it replaces this search.
std::string find_ftetwild();

/// Run fTetWild to compute tets of the volume that a surface encloses (Hu, Schneider, Wang, Zorin,
/// Panozzo, Fast Tetrahedral Meshing in the Wild, 2020). fTetWild is a separate program that must
/// be installed. It accepts any triangles, moves them by at most epsilon and keeps none of their
/// vertices. A tet is inside if the winding number of the moved surface is above 0.5.
///
/// `mesh` has positively oriented tets and no unused vertices. `mesh` is empty if the surface
/// encloses no volume.
///
/// The surface and the result are stored in a temporary folder, which is always removed. If this
/// process is killed, a guarding shell process (ScratchFolder) removes the folder. fTetWild runs in
/// a separate process group, with context.threads() threads.
///
/// Status codes:
/// - invalid_input: a coordinate is not finite or larger than 1e100, an id is out of range, there
///   are no triangles, all points are equal, or an option is out of range.
/// - unavailable: there is no executable; the message contains its name and where to get it.
/// - canceled: fTetWild is killed within 20 ms.
/// - internal_error: fTetWild crashed, failed, exceeded its time or memory limit, or wrote no mesh;
///   or the temporary folder cannot be created.
///
/// Cost: seconds to minutes.
Status run_ftetwild(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const FtetwildOptions& options, TetMesh& mesh);

} // namespace bindpose

#endif
