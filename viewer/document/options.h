#ifndef document_options_h
#define document_options_h

#include <QMap>
#include <QString>
#include <QVariant>

#include <vector>

/// What can be chosen and is kept, with undo and in sessions. The type is that of `initial`: bool,
/// int, double, or a direction: a list of three doubles of length one.
struct OptionInfo
{
  const char* key; ///< in session files, and the object name of the widget that chooses it
  const char* step; ///< name of the step in the history, of the context Document
  QVariant initial;
  double lowest = 0.0;
  double highest = 1.0;
};

/// All of them. A new option is a row here, and a widget with the key as its object name, or what
/// else holds it (option_links.h).
const std::vector<OptionInfo>& option_table();
/// Null for an unknown key.
const OptionInfo* find_option(const QString& key);

/// By key; every key of the table is there.
using Options = QMap<QString, QVariant>;
Options initial_options();

/// The value in the option's own type; invalid when it is of another kind, not finite or out of
/// range.
QVariant checked_option(const OptionInfo& option, const QVariant& value);

#endif
