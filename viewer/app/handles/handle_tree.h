#ifndef app_handles_handle_tree_h
#define app_handles_handle_tree_h

#include "pose/pose.h"

#include <QStringList>
#include <QWidget>

#include <vector>

class QLabel;
class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace app::handles
{

/// The handles as a tree, with children below their parents, and a search field for names. The
/// window sets the contents; the tree reports the user's selection.
class HandleTree : public QWidget
{
  Q_OBJECT

public:
  explicit HandleTree(QWidget* parent = nullptr);

  struct Row
  {
    QString name;
    bindpose::HandleKind kind = bindpose::HandleKind::point;
    int parent = -1; ///< index of the parent in the list of rows; -1: no parent
    int mode = static_cast<int>(bindpose::HandleMode::automatic);
  };
  /// Replace all rows and clear the selection. A new row is collapsed if the old row with the
  /// same name was collapsed.
  void set_rows(const std::vector<Row>& rows);
  const std::vector<Row>& rows() const { return this->rows_; }
  void set_mode(int handle, int mode);
  /// Select only these handles, and emit selection_changed() if the selection changes.
  void select(const std::vector<int>& handles);
  /// Return the selected handles in the order of their selection.
  const std::vector<int>& selected() const { return this->selected_; }

  QTreeWidget* tree() const { return this->tree_; }
  QTreeWidgetItem* item(int handle) const { return this->items_[static_cast<std::size_t>(handle)]; }
  /// Return the index of the handle that an item shows.
  static int handle_of(const QTreeWidgetItem* item);
  QLineEdit* search() const { return this->search_; }

Q_SIGNALS:
  /// Emitted when the selection has changed.
  void selection_changed();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;

private:
  void read_selection();
  void show_matches();
  void choose_first_match();
  bool matches(const QString& name) const;
  void show_icons();
  void fit_column();

  QLabel* heading_;
  QLineEdit* search_;
  QTreeWidget* tree_;
  std::vector<Row> rows_;
  std::vector<QTreeWidgetItem*> items_; // item of each handle
  std::vector<int> selected_;
  int maximum_depth_ = 0;
};

} // namespace app::handles

#endif
