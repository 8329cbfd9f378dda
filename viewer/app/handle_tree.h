#ifndef handle_tree_h
#define handle_tree_h

#include "pose/pose.h"

#include <QStringList>
#include <QWidget>

#include <vector>

class QLabel;
class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

/// The handles as a tree, children below their parents, with a field that searches their names. It
/// shows what it is told, and tells what a person selects.
class HandleTree : public QWidget
{
  Q_OBJECT

public:
  explicit HandleTree(QWidget* parent = nullptr);

  struct Row
  {
    QString name;
    bindpose::HandleKind kind = bindpose::HandleKind::point;
    int parent = -1; ///< number of a row; -1: none
    int mode = static_cast<int>(bindpose::HandleMode::automatic);
  };
  /// Other handles; none is selected then. What was folded stays so, by its name.
  void set_rows(const std::vector<Row>& rows);
  const std::vector<Row>& rows() const { return this->rows_; }
  void set_mode(int handle, int mode);
  /// Those alone, with chosen() if others were selected before.
  void select(const std::vector<int>& handles);
  /// The last one selected at the end.
  const std::vector<int>& selected() const { return this->selected_; }

  QTreeWidget* tree() const { return this->tree_; }
  QTreeWidgetItem* item(int handle) const { return this->items_[static_cast<std::size_t>(handle)]; }
  /// Number of an item's handle.
  static int handle_of(const QTreeWidgetItem* item);
  QLineEdit* search() const { return this->search_; }

Q_SIGNALS:
  /// Others are selected.
  void chosen();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;

private:
  void take_selection();
  void show_matches();
  void choose_first_match();
  bool matches(const QString& name) const;
  void show_icons();
  void fit_column();

  QLabel* heading_;
  QLineEdit* search_;
  QTreeWidget* tree_;
  std::vector<Row> rows_;
  std::vector<QTreeWidgetItem*> items_; // by the handle
  std::vector<int> selected_;
  int deepest_ = 0;
};

#endif
