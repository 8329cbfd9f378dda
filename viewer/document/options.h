#ifndef document_options_h
#define document_options_h

#include <QMap>
#include <QString>
#include <QVariant>

#include <vector>

/// One value of an option that is a choice.
struct OptionChoice
{
  const char* word; ///< the value in session files
  const char* label; ///< text in the window, in the translation context Document
  int value = 0; ///< for an option of a stage (filters/options): value of the VTK enumeration
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
  std::vector<OptionChoice> choices = {}; ///< if the option is a choice: one for each int value
  const char* former_key = ""; ///< key in the files of earlier versions
};

/// Return all options. If a filter has the option too, its words, labels, range and default come
/// from the description of the filter's options (filters/options/README.md). A new option needs a
/// row in this table. It also needs a widget (app/parts/option_widgets.h), or two functions that
/// read and set it (app/window/option_links.h).
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
