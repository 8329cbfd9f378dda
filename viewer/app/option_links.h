#ifndef option_links_h
#define option_links_h

#include <QObject>
#include <QStringList>
#include <QVariant>

#include <functional>
#include <map>

class Document;
class QWidget;

/// Connects widgets with the document's options (document/options.h) by their object names. A
/// choice of the user becomes a step of the history. Undo, redo and sessions set the widgets, which
/// then notify the views as usual. Supported widgets are check boxes, combo boxes (by index),
/// button groups (by id) and value rows. Other options are connected by two functions, see tie().
class OptionLinks : public QObject
{
  Q_OBJECT

public:
  /// Connect all widgets below the root that are named like an option.
  OptionLinks(Document* document, QWidget* root);

  /// Connect an option by two functions: `value` returns the current value, `set` applies another
  /// one.
  void tie(const QString& key, const std::function<QVariant()>& value,
    const std::function<void(const QVariant&)>& set);
  /// Join options, so that a step of one of them is a step of all of them.
  void join(const QStringList& keys);
  /// The user has chosen the option: make a step that is named like it.
  void chosen(const QString& key);

  /// Set an option that the program itself has chosen. The widget shows it and a session stores it,
  /// but it makes no step.
  void note(const QString& key, const QVariant& value);
  /// Store all values that the program itself has set, so that a session contains them.
  void note_all() { this->note_all_but({}); }

private:
  struct Link
  {
    std::function<QVariant()> value;
    std::function<void(const QVariant&)> set;
    QStringList together; ///< options of one step, including this one; empty: only this one
  };
  void note_all_but(const QStringList& keys);
  void option_changed(const QString& key, const QVariant& value);

  Document* document_;
  std::map<QString, Link> links_;
  bool follows_ = false; ///< widgets are being set from the document, so no user chooses
};

#endif
