#ifndef file_kind_h
#define file_kind_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

#include <string>

namespace bindpose
{

/// Return the extension of a path in lower case without its dot ("vtp"); empty if there is none.
BINDPOSEFILTERS_EXPORT std::string file_extension(const std::string& path);

/// Report whether a word is in a list of words that are separated by blanks.
BINDPOSEFILTERS_EXPORT bool is_listed(const std::string& word, const std::string& list);

/// Return invalid_input if there is no file name or its extension is not in the list.
BINDPOSEFILTERS_EXPORT Status check_extension(const std::string& path, const std::string& list);

} // namespace bindpose

#endif
