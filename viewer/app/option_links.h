#ifndef option_links_h
#define option_links_h

#include <QObject>
#include <QStringList>
#include <QVariant>

#include <functional>
#include <map>

class Document;
class QWidget;

/// Ties widgets to the document's options (document/options.h) by their object names: what a person
/// chooses becomes a step of the history, and undo, redo and sessions set the widgets, which tell
/// the views as ever. Check boxes, combo boxes (by index), button groups (by id) and value rows;
/// what else holds an option is tied by what reads and sets it.
class OptionLinks : public QObject
{
  Q_OBJECT

public:
  /// Of all widgets below the root that are named like an option.
  OptionLinks(Document* document, QWidget* root);

  /// The option is what `value` says and `set` makes of it, whichever widget chooses it.
  void tie(const QString& key, const std::function<QVariant()>& value,
    const std::function<void(const QVariant&)>& set);
  /// These options go together: a step of one is a step of all of them.
  void join(const QStringList& keys);
  /// A person has chosen the option: a step that is named like it.
  void chosen(const QString& key);

  /// The program itself chooses the option: the widget shows it and a session keeps it, but it is
  /// no step.
  void note(const QString& key, const QVariant& value);
  /// Takes over what the program itself has set, for a session to hold it.
  void note_all() { this->note_all_but({}); }

private:
  struct Link
  {
    std::function<QVariant()> value;
    std::function<void(const QVariant&)> set;
    QStringList together; ///< itself among them; empty: it alone
  };
  void note_all_but(const QStringList& keys);
  void option_changed(const QString& key, const QVariant& value);

  Document* document_;
  std::map<QString, Link> links_;
  bool follows_ = false; ///< the document is being followed: nobody chooses
};

#endif
