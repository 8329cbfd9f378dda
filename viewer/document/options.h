#ifndef document_options_h
#define document_options_h

#include <QMap>
#include <QString>
#include <QVariant>

#include <vector>

/// One allowed value of a choice, i.e. of an option with a fixed list of values.
struct OptionChoice
{
  const char* word; ///< the value in session files
  const char* label; ///< text in the window, in the translation context Document
  int value = 0; ///< value of the VTK enumeration, if filters/options describes the option
};

/// One option that the user can choose. Undo and sessions include options. The type of the option
/// is that of `initial`: bool, int, double, or a direction (a list of three doubles of length one).
struct OptionInfo
{
  const char* key; ///< name of the option in session files, and object name of its widget
  const char* step; ///< name of the undo step, in the translation context Document
  QVariant initial;
  double lowest = 0.0;
  double highest = 1.0;
  /// The allowed values of a choice: the option's int value is an index into this list. Empty if
  /// the option is not a choice.
  std::vector<OptionChoice> choices = {};
  const char* former_key = ""; ///< key in the files of earlier versions
};

/// Return all options. If a filter has the same option, the words, labels, range and default come
/// from the description of the filter's options (filters/options/README.md). A new option needs a
/// row in this table. It also needs a widget (app/parts/option_widgets.h), or two functions that
/// read and set it (app/window/option_links.h).
const std::vector<OptionInfo>& option_table();
/// Return the option with a key or former key; null if it is unknown.
const OptionInfo* find_option(const QString& key);

/// Values of the options by key. Every key of the table is present.
using Options = QMap<QString, QVariant>;
Options initial_options();

/// Return a value as the type of the option. Return an invalid variant if the value cannot be
/// converted without loss, is not finite or is out of range. The value of a choice may be a word,
/// or an integer as in files of earlier versions.
QVariant checked_option(const OptionInfo& option, const QVariant& value);

#endif
