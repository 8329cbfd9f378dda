#ifndef file_kind_h
#define file_kind_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

#include <string>

namespace bindpose
{

/// Ending of a path in lower case without its dot ("vtp"); empty when there is none.
BINDPOSEFILTERS_EXPORT std::string file_extension(const std::string& path);

/// Word of a list whose words are parted by blanks?
BINDPOSEFILTERS_EXPORT bool is_listed(const std::string& word, const std::string& list);

/// invalid_input: there is no file name, or its ending is not in the list.
BINDPOSEFILTERS_EXPORT Status check_extension(const std::string& path, const std::string& list);

} // namespace bindpose

#endif
