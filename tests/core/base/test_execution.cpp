// ExecutionContext and Phase: monotone progress, nested phases, seconds per phase, and cancel.
#include "base/execution.h"

#include <gtest/gtest.h>

#include <vector>

using namespace bindpose;

TEST(ExecutionContext, ProgressNeverGoesBack)
{
  std::vector<double> reported_fractions;
  ExecutionContext context([&](double fraction, const std::string&)
    { reported_fractions.push_back(fraction); },
    [] { return false; });
  // Each phase begins at the given fraction. If a larger fraction was reported before, the phase
  // reports the larger fraction again, so that the progress never decreases.
  for (const double begin : { 0.0, 0.4, 0.1, 0.0, 0.7 })
  {
    const Phase phase(context, "again", begin, 0.9);
  }
  EXPECT_EQ(reported_fractions, (std::vector<double>{ 0.0, 0.4, 0.4, 0.4, 0.7 }));
}

TEST(Execution, PhasesNestAndProgressNeverGoesBack)
{
  std::vector<double> fractions;
  std::vector<std::string> names;
  ExecutionContext context(
    [&](double fraction, const std::string& phase)
    {
      fractions.push_back(fraction);
      names.push_back(phase);
    },
    nullptr);
  {
    Phase build(context, "build", 0.0, 0.25);
    context.progress(1.0);
  }
  {
    Phase solve(context, "solve", 0.25, 1.0);
    {
      Phase factor(context, "factor", 0.0, 0.5);
      context.progress(0.5);
    }
    Phase iterate(context, "iterate", 0.5, 1.0);
  }
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);
  EXPECT_EQ(names.front(), "build");
  // The start of each phase is always reported. Phase "iterate" begins at 0.25 + 0.75 * 0.5.
  const auto at = std::find(names.begin(), names.end(), "iterate") - names.begin();
  EXPECT_DOUBLE_EQ(fractions.at(static_cast<std::size_t>(at)), 0.625);
}

TEST(Execution, SecondsAddUpByPhase)
{
  ExecutionContext context;
  for (int i = 0; i < 2; ++i)
  {
    Phase phase(context, "factor");
  }
  context.add_seconds("factor", 10.0);
  EXPECT_GE(context.seconds().number("seconds.factor", 0.0), 10.0);
  EXPECT_LT(context.seconds().number("seconds.factor", 0.0), 11.0);
}

TEST(Execution, CancelLatches)
{
  bool wanted = false;
  ExecutionContext context(nullptr, [&] { return wanted; });
  EXPECT_FALSE(context.canceled());
  wanted = true;
  EXPECT_TRUE(context.canceled());
  wanted = false;
  EXPECT_TRUE(context.canceled());
}
