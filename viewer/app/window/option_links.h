#ifndef app_window_option_links_h
#define app_window_option_links_h

#include <QObject>
#include <QStringList>
#include <QVariant>

#include <functional>
#include <map>

class Document;
class QWidget;

namespace app::window
{

/// Connects widgets with the document's options (document/options.h). The object name of a widget
/// is the key of its option. A choice of the user becomes an undo step. Undo, redo and sessions set
/// the widgets, whose signals then update the views. Supported widgets are check boxes, combo boxes
/// (the value is the index), button groups (the value is the id) and value rows. For other options,
/// call link_option().
class OptionLinks : public QObject
{
  Q_OBJECT

public:
  /// Connect all widgets below `root` whose object name is the key of an option.
  OptionLinks(Document* document, QWidget* root);

  /// Connect an option. `value` must return the current value, and `set` must apply a new value.
  void link_option(const QString& key, const std::function<QVariant()>& value,
    const std::function<void(const QVariant&)>& set);
  /// Combine options into a group. If one of them changes, the undo step stores all of them.
  void group_options(const QStringList& keys);
  /// Make an undo step after the user has changed the option. The step has the name of the option.
  void chosen(const QString& key);

  /// Set an option to a value that the program has chosen. The widget shows the value and a session
  /// stores it, but no undo step is made.
  void set_without_undo(const QString& key, const QVariant& value);
  /// Store the current values of all options in the document without an undo step, so that a
  /// session contains them.
  void store_all() { this->store_all_except({}); }

private:
  struct Link
  {
    std::function<QVariant()> value;
    std::function<void(const QVariant&)> set;
    QStringList grouped_keys; ///< all options of the option's group; empty: no group
  };
  void store_all_except(const QStringList& keys);
  void option_changed(const QString& key, const QVariant& value);

  Document* document_;
  std::map<QString, Link> links_;
  /// True while widgets are set from the document. Their signals are then caused by the program,
  /// not by the user.
  bool is_updating_widgets_ = false;
};

} // namespace app::window

#endif
