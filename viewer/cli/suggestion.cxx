#include "cli/suggestion.h"

#include <algorithm>

namespace bindpose::cli
{

namespace
{
/// Return the edit distance of two words; swapping neighboring letters counts as one edit (optimal
/// string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
  {
    for (std::size_t j = 0; j <= b.size(); ++j)
    {
      if (i == 0 || j == 0)
      {
        rows[i][j] = i + j;
        continue;
      }
      rows[i][j] = std::min({ rows[i - 1][j] + 1, rows[i][j - 1] + 1,
        rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U) });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
      }
    }
  }
  return rows[a.size()][b.size()];
}
} // namespace

std::string most_similar(const std::string& word, const std::vector<std::string>& known)
{
  std::string best;
  std::size_t minimum_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : known)
  {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < minimum_distance)
    {
      minimum_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known)
{
  const std::string best = most_similar(word, known);
  return best.empty() ? best : "; did you mean '" + best + "'?";
}

} // namespace bindpose::cli
