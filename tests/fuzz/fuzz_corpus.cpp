#include "fuzz/fuzz_target.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace bindpose::test
{

std::vector<FuzzSeed> fuzz_corpus(const FuzzTarget& target)
{
  std::vector<FuzzSeed> seeds;
  const std::filesystem::path folder =
    std::filesystem::path(BINDPOSE_FUZZ_CORPUS_FOLDER) / target.name;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    seeds.push_back({ entry.path().filename().string(), content.str() });
  }
  std::sort(seeds.begin(), seeds.end(),
    [](const FuzzSeed& a, const FuzzSeed& b) { return a.name < b.name; });
  return seeds;
}

} // namespace bindpose::test
