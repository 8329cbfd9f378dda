#ifndef app_window_shortcut_sheet_h
#define app_window_shortcut_sheet_h

#include <QDialog>

class QLineEdit;
class QTableWidget;

namespace app::window
{

/// A dialog with all keys and mouse buttons of the window and a search field. The keys are grouped
/// by the situations in which they apply (window_keys.h).
class ShortcutSheet : public QDialog
{
  Q_OBJECT

public:
  explicit ShortcutSheet(QWidget* parent);

  QTableWidget* table() const { return this->table_; }
  /// Show only the rows that match, and the headings of these rows. A row matches if the row and
  /// its heading together contain all words of the search text.
  void apply_search(const QString& words);

private:
  QLineEdit* search_field_;
  QTableWidget* table_;
};

} // namespace app::window

#endif
