#include "app/window/shortcut_sheet.h"

#include "app/parts/panel_parts.h"
#include "app/parts/style.h"
#include "app/parts/window_keys.h"

#include <QHeaderView>
#include <QLineEdit>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace app::window
{

ShortcutSheet::ShortcutSheet(QWidget* parent) : QDialog(parent)
{
  this->setWindowTitle(tr("Mouse and keys"));
  this->setAttribute(Qt::WA_DeleteOnClose);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(12, 12, 12, 12);
  this->search_field_ = new QLineEdit(this);
  this->search_field_->setPlaceholderText(tr("Search …"));
  this->search_field_->setClearButtonEnabled(true);
  rows->addWidget(this->search_field_);
  this->table_ = new QTableWidget(0, 2, this);
  this->table_->setObjectName("sheet");
  this->table_->horizontalHeader()->hide();
  this->table_->verticalHeader()->hide();
  this->table_->setShowGrid(false);
  this->table_->setWordWrap(true);
  this->table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  this->table_->setSelectionMode(QAbstractItemView::NoSelection);
  this->table_->setFocusPolicy(Qt::NoFocus);
  QFont bold = this->font();
  bold.setBold(true);
  for (const parts::KeyGroup& group : parts::all_keys())
  {
    const int heading_row = this->table_->rowCount();
    this->table_->insertRow(heading_row);
    auto* title = new QTableWidgetItem(parts::capitalized(QString::fromStdString(group.heading)));
    title->setFont(bold);
    title->setForeground(parts::theme_color(parts::is_dark() ? "accent_ring" : "accent"));
    this->table_->setItem(heading_row, 0, title);
    this->table_->setSpan(heading_row, 0, 1, 2);
    for (const auto& [input, text] : group.rows)
    {
      const int row = this->table_->rowCount();
      this->table_->insertRow(row);
      auto* keys = new QTableWidgetItem(QString::fromStdString(input));
      keys->setFont(bold);
      keys->setTextAlignment(Qt::AlignLeft | Qt::AlignTop);
      this->table_->setItem(row, 0, keys);
      auto* effect_item = new QTableWidgetItem(QString::fromStdString(text));
      effect_item->setTextAlignment(Qt::AlignLeft | Qt::AlignTop);
      this->table_->setItem(row, 1, effect_item);
    }
  }
  this->table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Fixed);
  this->table_->setColumnWidth(0, 38 * this->fontMetrics().averageCharWidth());
  this->table_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  this->table_->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  rows->addWidget(this->table_);
  QObject::connect(
    this->search_field_, &QLineEdit::textChanged, this, &ShortcutSheet::apply_search);
  const QSize window = parent ? parent->size() : QSize(1280, 800);
  this->resize(std::min(820, window.width() - 80), std::min(900, window.height() - 80));
  this->search_field_->setFocus();
}

void ShortcutSheet::apply_search(const QString& words)
{
  const QStringList search_words = words.split(' ', Qt::SkipEmptyParts);
  int heading_row = -1;
  QString title;
  bool any_row_shown = false;
  for (int row = 0; row < this->table_->rowCount(); ++row)
  {
    if (this->table_->columnSpan(row, 0) == 2)
    {
      heading_row = row;
      title = this->table_->item(row, 0)->text();
      any_row_shown = false;
      this->table_->hideRow(row);
      continue;
    }
    const QString text =
      title + ' ' + this->table_->item(row, 0)->text() + ' ' + this->table_->item(row, 1)->text();
    const bool shown = std::all_of(search_words.begin(), search_words.end(),
      [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
    this->table_->setRowHidden(row, !shown);
    any_row_shown = any_row_shown || shown;
    this->table_->setRowHidden(heading_row, !any_row_shown);
  }
}

} // namespace app::window
