#ifndef option_links_h
#define option_links_h

#include <QObject>
#include <QVariant>

#include <functional>
#include <map>

class Document;
class QWidget;

/// Ties widgets to the document's options (document/options.h) by their object names: what a person
/// chooses becomes a step of the history, and undo, redo and sessions set the widgets, which tell
/// the views as ever. Check boxes, combo boxes (by index), button groups (by id) and value rows.
class OptionLinks : public QObject
{
  Q_OBJECT

public:
  /// Of all widgets below the root that are named like an option.
  OptionLinks(Document* document, QWidget* root);

  /// Takes over what the program itself has set in the widgets, for a session to hold it.
  void note_all(const QString& but = QString());

private:
  struct Link
  {
    std::function<QVariant()> value;
    std::function<void(const QVariant&)> set;
  };
  void chosen(const QString& key);
  void option_changed(const QString& key, const QVariant& value);

  Document* document_;
  std::map<QString, Link> links_;
};

#endif
