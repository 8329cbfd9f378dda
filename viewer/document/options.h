#ifndef document_options_h
#define document_options_h

#include <QMap>
#include <QString>
#include <QVariant>

#include <vector>

/// One option that the user can choose. Undo and sessions include options. The type of the option
/// is that of `initial`: bool, int, double, or a direction (a list of three doubles of length one).
struct OptionInfo
{
  const char* key; ///< name of the option in session files, and object name of its widget
  const char* step; ///< name of the undo step, in the translation context Document
  QVariant initial;
  double lowest = 0.0;
  double highest = 1.0;
  /// If the option is a choice: the word for each int value. Session files contain the word.
  std::vector<const char*> words = {};
  const char* former_key = ""; ///< key in the files of earlier versions
};

/// Return all options. A new option needs a row in this table. It also needs a widget whose object
/// name is the key, or another link (option_links.h).
const std::vector<OptionInfo>& option_table();
/// Return the option with a key or former key; null if it is unknown.
const OptionInfo* find_option(const QString& key);

/// Values of the options by key. Every key of the table is present.
using Options = QMap<QString, QVariant>;
Options initial_options();

/// Convert a value to the option's own type. Return an invalid variant if it has another type, is
/// not finite or is out of range. The value of a choice may be a word, or its integer as in the
/// files of earlier versions.
QVariant checked_option(const OptionInfo& option, const QVariant& value);

#endif
