#ifndef shortcut_sheet_h
#define shortcut_sheet_h

#include <QDialog>

class QLineEdit;
class QTableWidget;

/// All keys and buttons of the window, by when they apply (window_keys.h), with a field to look for
/// words in.
class ShortcutSheet : public QDialog
{
  Q_OBJECT

public:
  explicit ShortcutSheet(QWidget* parent);

  QTableWidget* table() const { return this->table_; }
  /// Only rows with all these words are shown, and the headings above them.
  void look_for(const QString& words);

private:
  QLineEdit* words_;
  QTableWidget* table_;
};

#endif
