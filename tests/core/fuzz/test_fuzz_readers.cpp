// Fuzz test of the file readers. The test damages files of tests/fuzz/corpus: bits are
// flipped, lines moved, numbers replaced, and ends cut off. A reader must return usable data or an
// error message of one sentence.
#include "fuzz/fuzz_rounds.h"

#include <algorithm>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
void fuzz_kernel(const std::string& name)
{
  const std::vector<FuzzTarget>& targets = kernel_fuzz_targets();
  const auto found = std::find_if(
    targets.begin(), targets.end(), [&](const FuzzTarget& target) { return target.name == name; });
  ASSERT_NE(found, targets.end());
  fuzz_target(*found);
}
} // namespace

TEST(FuzzCorpus, KernelsAcceptValidFiles)
{
  replay_corpus(kernel_fuzz_targets());
}

TEST(FuzzReaders, Off)
{
  fuzz_kernel("off");
}

TEST(FuzzReaders, Obj)
{
  fuzz_kernel("obj");
}

TEST(FuzzReaders, Mtl)
{
  fuzz_kernel("mtl");
}

TEST(FuzzReaders, Ply)
{
  fuzz_kernel("ply");
}

TEST(FuzzReaders, Stl)
{
  fuzz_kernel("stl");
}

TEST(FuzzReaders, Medit)
{
  fuzz_kernel("medit");
}

TEST(FuzzReaders, Tgf)
{
  fuzz_kernel("tgf");
}

TEST(FuzzReaders, Dmat)
{
  fuzz_kernel("dmat");
}

TEST(FuzzReaders, Gltf)
{
  fuzz_kernel("gltf");
}

#if defined(BINDPOSE_HAS_DRACO) && defined(BINDPOSE_HAS_MESHOPTIMIZER)
TEST(FuzzReaders, CompressedGltf)
{
  fuzz_kernel("compressed");
}
#endif

TEST(FuzzReaders, PoseFiles)
{
  fuzz_kernel("pose");
}

TEST(FuzzReaders, Expressions)
{
  fuzz_kernel("expression");
}

TEST(FuzzReaders, NamesOfHandles)
{
  fuzz_kernel("names");
}

TEST(FuzzReaders, ShapesWithWeightsAndPoses)
{
  fuzz_kernel("shape");
}
