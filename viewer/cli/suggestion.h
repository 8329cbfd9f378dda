#ifndef bindpose_cli_suggestion_h
#define bindpose_cli_suggestion_h

#include <string>
#include <vector>

namespace bindpose::cli
{

/// Return the known word that is most similar to a mistyped word. Return an empty text if more than
/// a third of the letters are wrong, missing, added or swapped with their neighbors.
std::string most_similar(const std::string& word, const std::vector<std::string>& known);

/// Return "; did you mean 'WORD'?" with the most similar known word, or an empty text.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

} // namespace bindpose::cli

#endif
