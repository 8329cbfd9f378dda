#ifndef document_options_h
#define document_options_h

#include <QMap>
#include <QString>
#include <QVariant>

#include <vector>

/// One option that the user can choose. Options are part of undo and of sessions. The type is that
/// of `initial`: bool, int, double, or a direction (a list of three doubles of length one).
struct OptionInfo
{
  const char* key; ///< in session files; also the object name of the option's widget
  const char* step; ///< name of the step in the history, in the translation context Document
  QVariant initial;
  double lowest = 0.0;
  double highest = 1.0;
  /// The words of an int that is a choice, by value. Session files contain the word.
  std::vector<const char*> words = {};
  const char* former_key = ""; ///< key in the files of earlier versions
};

/// Return all options. A new option needs a row in this table, and a widget with the key as its
/// object name or another link (option_links.h).
const std::vector<OptionInfo>& option_table();
/// Return the option of a key or of a former key; null if it is unknown.
const OptionInfo* find_option(const QString& key);

/// Values by key. Every key of the table is present.
using Options = QMap<QString, QVariant>;
Options initial_options();

/// Return the value in the option's own type; invalid if it has another type, is not finite or is
/// out of range. A choice may be a word, or its integer as in the files of earlier versions.
QVariant checked_option(const OptionInfo& option, const QVariant& value);

#endif
