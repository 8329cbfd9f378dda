#ifndef cli_key_table_h
#define cli_key_table_h

#include <string>

namespace bindpose::cli
{

/// Return the keys and buttons of the window as Markdown, for the README.
std::string key_table_markdown();

} // namespace bindpose::cli

#endif
