#include "fuzz/compressed_target.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/mesh_file_targets.h"
#include "fuzz/rig_file_targets.h"
#include "fuzz/shape_target.h"

namespace bindpose::test
{

const std::vector<FuzzTarget>& kernel_fuzz_targets()
{
  static const std::vector<FuzzTarget> targets
  {
    { "off", check_off, 3000 }, { "obj", check_obj, 3000 }, { "mtl", check_mtl, 6000 },
      { "ply", check_ply, 6000 }, { "stl", check_stl, 4000 }, { "medit", check_medit, 3000 },
      { "tgf", check_tgf, 3000 }, { "dmat", check_dmat, 4000 }, { "gltf", check_gltf, 8000 },
#if defined(BINDPOSE_HAS_DRACO) && defined(BINDPOSE_HAS_MESHOPTIMIZER)
      { "compressed", check_compressed, 4000 },
#endif
      { "pose", check_pose_file, 12000 }, { "expression", check_expression, 4000 },
      { "names", check_names, 3000 }, { "shape", check_shape, 300 },
  };
  return targets;
}

} // namespace bindpose::test
