// Fuzz test of the parsers that use VTK (see filter_targets.h).
#include "fuzz/filter_targets.h"
#include "fuzz/fuzz_rounds.h"

using namespace bindpose::test;

TEST(FuzzFilterCorpus, FiltersAcceptValidInputs)
{
  replay_corpus(filter_fuzz_targets());
}

TEST(FuzzFilters, DamagedInputs)
{
  for (const FuzzTarget& target : filter_fuzz_targets())
  {
    SCOPED_TRACE(target.name);
    fuzz_target(target);
  }
}
