#include "app/handles/handle_tree.h"

#include "app/parts/panel_parts.h"
#include "app/parts/style.h"

#include "pose/pose.h"

#include <QApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QSet>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <functional>

namespace app::handles
{

using namespace bindpose;

namespace
{
constexpr int handle_role = Qt::UserRole;
constexpr int indentation = 14; // pixels
constexpr int icon_size = 14;
// Minimum width of the name in the deepest row, in pixels. If the tree is too narrow for it, the
// tree scrolls horizontally.
constexpr int name_width = 150;

/// Return an icon for a type of handle, in the color of secondary text.
QIcon kind_icon(HandleKind kind)
{
  QIcon icon;
  for (const int scale : { 1, 2 })
  {
    QPixmap pixmap(scale * icon_size, scale * icon_size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.scale(scale, scale);
    painter.setPen(QPen(parts::theme_color("note"), 1.2));
    switch (kind)
    {
      case HandleKind::bone:
      {
        const QPointF bone[4] = { { 2.0, 12.0 }, { 3.0, 8.0 }, { 12.0, 2.0 }, { 6.0, 11.0 } };
        painter.drawPolygon(bone, 4);
        break;
      }
      case HandleKind::cage_vertex:
        painter.drawRect(QRectF(4.0, 4.0, 6.0, 6.0));
        break;
      case HandleKind::region:
        painter.setBrush(parts::theme_color("scroll"));
        painter.drawEllipse(QRectF(2.0, 4.0, 10.0, 7.0));
        break;
      default:
        painter.setBrush(parts::theme_color("note"));
        painter.drawEllipse(QRectF(4.5, 4.5, 5.0, 5.0));
        break;
    }
    painter.end();
    pixmap.setDevicePixelRatio(scale);
    icon.addPixmap(pixmap);
    icon.addPixmap(pixmap, QIcon::Selected); // without this pixmap, Qt tints icons of selected rows
  }
  return icon;
}

/// Return the parent of each row; -1: no parent. The parents in a dataset may form a cycle. A row
/// whose ancestors form a cycle gets no parent.
std::vector<int> acyclic_parents(const std::vector<HandleTree::Row>& rows)
{
  const int count = static_cast<int>(rows.size());
  std::vector<int> parents(rows.size(), -1);
  for (int k = 0; k < count; ++k)
  {
    int ancestor = rows[static_cast<std::size_t>(k)].parent;
    int steps = 0;
    while (ancestor >= 0 && ancestor < count && ancestor != k && steps <= count)
    {
      ancestor = rows[static_cast<std::size_t>(ancestor)].parent;
      ++steps;
    }
    const int direct_parent = rows[static_cast<std::size_t>(k)].parent;
    if ((ancestor < 0 || ancestor >= count) && direct_parent < count)
    {
      parents[static_cast<std::size_t>(k)] = direct_parent;
    }
  }
  return parents;
}

QString row_text(const HandleTree::Row& row)
{
  return row.mode == static_cast<int>(HandleMode::automatic)
    ? row.name
    : QString("%1   (%2)")
        .arg(row.name, HandleTree::tr(handle_mode_words[static_cast<std::size_t>(row.mode)]));
}
} // namespace

HandleTree::HandleTree(QWidget* parent)
  : QWidget(parent), heading_(parts::heading(QString(), this)), search_(new QLineEdit(this)),
    tree_(new QTreeWidget(this))
{
  this->setAttribute(Qt::WA_StyledBackground);
  this->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Expanding);
  this->setObjectName("handles");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 10, 16, 6);
  column->setSpacing(6);
  auto* line = new QHBoxLayout;
  line->setSpacing(10);
  line->addWidget(this->heading_);
  this->search_->setPlaceholderText(tr("Search"));
  this->search_->setAccessibleName(tr("Search handles"));
  this->search_->setClearButtonEnabled(true);
  this->search_->setToolTip(tr("Show only handles whose names contain this text; Enter selects the "
                               "first one, Esc shows all handles"));
  this->search_->installEventFilter(this);
  line->addWidget(this->search_, 1);
  column->addLayout(line);
  this->tree_->setHeaderHidden(true);
  this->tree_->setIndentation(indentation);
  this->tree_->setUniformRowHeights(true);
  this->tree_->setIconSize({ icon_size, icon_size });
  this->tree_->setTextElideMode(Qt::ElideMiddle);
  this->tree_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  this->tree_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  this->tree_->setExpandsOnDoubleClick(false);
  this->tree_->header()->setStretchLastSection(false);
  this->tree_->header()->setSectionResizeMode(QHeaderView::Fixed);
  this->tree_->header()->setMinimumSectionSize(0);
  this->tree_->setMinimumHeight(4 * this->tree_->fontMetrics().lineSpacing());
  this->tree_->viewport()->installEventFilter(this);
  column->addWidget(this->tree_, 1);
  QObject::connect(
    this->tree_, &QTreeWidget::itemSelectionChanged, this, &HandleTree::read_selection);
  QObject::connect(this->tree_, &QTreeWidget::currentItemChanged, this,
    [this](QTreeWidgetItem* item)
    {
      if (item && this->tree_->selectedItems().isEmpty() &&
        QApplication::mouseButtons() == Qt::NoButton)
      {
        // select the row, because Qt only makes it current when the first arrow key is pressed
        item->setSelected(true);
      }
    });
  QObject::connect(this->search_, &QLineEdit::textChanged, this, &HandleTree::show_matches);
  this->set_rows({});
}

int HandleTree::handle_of(const QTreeWidgetItem* item)
{
  return item->data(0, handle_role).toInt();
}

void HandleTree::set_rows(const std::vector<Row>& rows)
{
  const QSignalBlocker blocker(this->tree_);
  QSet<QString> folded;
  for (std::size_t k = 0; k < this->items_.size(); ++k)
  {
    if (this->items_[k]->childCount() > 0 && !this->items_[k]->isExpanded())
    {
      folded.insert(this->rows_[k].name);
    }
  }
  this->tree_->clear();
  this->items_.clear();
  this->selected_.clear();
  this->rows_ = rows;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    auto* item = new QTreeWidgetItem({ row_text(rows[k]) });
    item->setToolTip(0, rows[k].name);
    item->setData(0, handle_role, static_cast<int>(k));
    this->items_.push_back(item);
  }
  const std::vector<int> parents = acyclic_parents(rows);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    if (parents[k] >= 0)
    {
      this->item(parents[k])->addChild(this->items_[k]);
    }
  }
  QList<QTreeWidgetItem*> roots;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    if (parents[k] < 0)
    {
      roots << this->items_[k];
    }
  }
  this->tree_->addTopLevelItems(roots);
  this->maximum_depth_ = 0;
  bool nested = false;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    this->items_[k]->setExpanded(!folded.contains(rows[k].name));
    nested = nested || parents[k] >= 0;
    int depth = 0;
    for (int ancestor = parents[k]; ancestor >= 0;
         ancestor = parents[static_cast<std::size_t>(ancestor)])
    {
      ++depth;
    }
    this->maximum_depth_ = std::max(this->maximum_depth_, depth);
  }
  this->tree_->setRootIsDecorated(nested);
  this->heading_->setText(
    rows.empty() ? tr("Handles") : tr("Handles (%1)").arg(static_cast<int>(rows.size())));
  this->show_icons();
  this->fit_column();
  this->show_matches();
}

void HandleTree::show_icons()
{
  for (std::size_t k = 0; k < this->items_.size(); ++k)
  {
    this->items_[k]->setIcon(0, kind_icon(this->rows_[k].kind));
  }
}

/// Make the column as wide as the tree, with a minimum width for names in deep trees.
void HandleTree::fit_column()
{
  this->tree_->header()->resizeSection(0,
    std::max(
      this->tree_->viewport()->width(), (this->maximum_depth_ + 1) * indentation + name_width));
}

void HandleTree::set_mode(int handle, int mode)
{
  Row& row = this->rows_[static_cast<std::size_t>(handle)];
  row.mode = mode;
  this->item(handle)->setText(0, row_text(row));
}

// ---- The selection -----------------------------------------------------------------------------

void HandleTree::select(const std::vector<int>& handles)
{
  if (handles == this->selected_)
  {
    return;
  }
  {
    const QSignalBlocker blocker(this->tree_);
    this->selected_ = handles;
    this->show_matches(); // update the filter, which always shows selected rows
    QTreeWidgetItem* last = handles.empty() ? nullptr : this->item(handles.back());
    this->tree_->setCurrentItem(last, 0, QItemSelectionModel::NoUpdate);
    this->tree_->clearSelection();
    for (const int handle : handles)
    {
      this->item(handle)->setSelected(true);
    }
    if (last)
    {
      this->tree_->scrollToItem(last); // scrollToItem() also expands the item's parents
    }
  }
  this->tree_->viewport()->update();
  Q_EMIT this->selection_changed();
}

/// Update selected_. The tree reports which items are selected, but not the order of their
/// selection, so the order is kept here.
void HandleTree::read_selection()
{
  const auto is_unselected = [this](int k) { return !this->item(k)->isSelected(); };
  this->selected_.erase(
    std::remove_if(this->selected_.begin(), this->selected_.end(), is_unselected),
    this->selected_.end());
  for (int k = 0; k < static_cast<int>(this->items_.size()); ++k)
  {
    const bool is_listed =
      std::find(this->selected_.begin(), this->selected_.end(), k) != this->selected_.end();
    if (!is_listed && !is_unselected(k))
    {
      this->selected_.push_back(k);
    }
  }
  Q_EMIT this->selection_changed();
}

// ---- The search --------------------------------------------------------------------------------

bool HandleTree::matches(const QString& name) const
{
  return name.contains(this->search_->text().trimmed(), Qt::CaseInsensitive);
}

/// Hide all rows except matches, their parents, and selected rows.
void HandleTree::show_matches()
{
  const bool all = this->search_->text().trimmed().isEmpty();
  const std::function<bool(QTreeWidgetItem*)> show = [&](QTreeWidgetItem* item)
  {
    const int handle = handle_of(item);
    const bool found = this->matches(this->rows_[static_cast<std::size_t>(handle)].name);
    bool shown = found ||
      std::find(this->selected_.begin(), this->selected_.end(), handle) != this->selected_.end();
    for (int k = 0; k < item->childCount(); ++k)
    {
      shown = show(item->child(k)) || shown;
    }
    item->setHidden(!shown);
    if (!all && shown)
    {
      item->setExpanded(true);
    }
    item->setForeground(0, !found ? QBrush(parts::theme_color("off")) : QBrush());
    return shown;
  };
  for (int k = 0; k < this->tree_->topLevelItemCount(); ++k)
  {
    show(this->tree_->topLevelItem(k));
  }
}

void HandleTree::choose_first_match()
{
  for (QTreeWidgetItem* item = this->tree_->topLevelItem(0); item;
       item = this->tree_->itemBelow(item))
  {
    if (!item->isHidden() &&
      this->matches(this->rows_[static_cast<std::size_t>(handle_of(item))].name))
    {
      this->select({ handle_of(item) });
      this->tree_->setFocus();
      return;
    }
  }
}

bool HandleTree::eventFilter(QObject* watched, QEvent* event)
{
  if (watched != this->search_)
  {
    if (event->type() == QEvent::Resize)
    {
      this->fit_column();
    }
    return QWidget::eventFilter(watched, event);
  }
  if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress)
  {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool clears_search = key == Qt::Key_Escape && !this->search_->text().isEmpty();
    const bool accepts_match = key == Qt::Key_Return || key == Qt::Key_Enter;
    if ((clears_search || accepts_match) && event->type() == QEvent::ShortcutOverride)
    {
      event->accept();
      return true;
    }
    if (clears_search)
    {
      this->search_->clear();
      return true;
    }
    if (accepts_match)
    {
      this->choose_first_match();
      return true;
    }
  }
  return QWidget::eventFilter(watched, event);
}

void HandleTree::changeEvent(QEvent* event)
{
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) // the desktop changes between light and dark
  {
    this->show_icons();
    this->show_matches();
  }
}

} // namespace app::handles
