#ifndef shortcut_sheet_h
#define shortcut_sheet_h

#include <QDialog>

class QLineEdit;
class QTableWidget;

/// All keys and mouse buttons of the window, grouped by when they apply (window_keys.h), with a
/// search field.
class ShortcutSheet : public QDialog
{
  Q_OBJECT

public:
  explicit ShortcutSheet(QWidget* parent);

  QTableWidget* table() const { return this->table_; }
  /// Show only the rows that contain all these words, and their headings.
  void look_for(const QString& words);

private:
  QLineEdit* words_;
  QTableWidget* table_;
};

#endif
