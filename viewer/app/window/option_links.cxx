// Connects widgets to the options of the document. Undo steps are made for signals that a user
// causes: clicked, activated, idClicked, value_chosen. If such a signal is emitted because a widget
// is set from the document, the signal is ignored.
#include "app/window/option_links.h"

#include "app/parts/value_row.h"
#include "document/document.h"

#include <QAbstractButton>
#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QSlider>
#include <QWidget>

namespace app::window
{

OptionLinks::OptionLinks(Document* document, QWidget* root) : QObject(root), document_(document)
{
  for (const OptionInfo& option : option_table())
  {
    const QString key = option.key;
    QObject* found = root->findChild<QObject*>(key);
    const auto store_choice = [this, key] { this->chosen(key); };
    if (auto* box = qobject_cast<QCheckBox*>(found))
    {
      this->link_option(
        key, [box] { return box->isChecked(); },
        [box](const QVariant& value) { box->setChecked(value.toBool()); });
      QObject::connect(box, &QCheckBox::clicked, this, store_choice);
    }
    else if (auto* list = qobject_cast<QComboBox*>(found))
    {
      this->link_option(
        key, [list] { return list->currentIndex(); },
        [list](const QVariant& value)
        {
          if (value.toInt() < list->count())
          {
            list->setCurrentIndex(value.toInt());
          }
        });
      QObject::connect(list, QOverload<int>::of(&QComboBox::activated), this, store_choice);
    }
    else if (auto* group = qobject_cast<QButtonGroup*>(found))
    {
      this->link_option(
        key, [group] { return group->checkedId(); },
        [group](const QVariant& value)
        {
          if (QAbstractButton* button = group->button(value.toInt()))
          {
            button->setChecked(true);
            Q_EMIT group->idClicked(value.toInt());
          }
        });
      QObject::connect(group, &QButtonGroup::idClicked, this, store_choice);
    }
    else if (auto* row = qobject_cast<parts::ValueRow*>(found))
    {
      this->link_option(
        key, [row] { return row->value(); },
        [row](const QVariant& value) { row->choose(value.toDouble()); });
      QObject::connect(row, &parts::ValueRow::value_chosen, this, store_choice);
      QObject::connect(
        row->slider(), &QSlider::sliderReleased, this, [this] { this->document_->end_merge(); });
    }
  }
  QObject::connect(document, &Document::option_changed, this, &OptionLinks::option_changed);
}

void OptionLinks::link_option(const QString& key, const std::function<QVariant()>& value,
  const std::function<void(const QVariant&)>& set)
{
  this->links_[key] = { value, set, {} };
}

void OptionLinks::group_options(const QStringList& keys)
{
  for (const QString& key : keys)
  {
    this->links_[key].grouped_keys = keys;
  }
}

void OptionLinks::store_all_except(const QStringList& keys)
{
  for (const auto& [key, link] : this->links_)
  {
    if (!keys.contains(key))
    {
      this->document_->set_option_without_undo(key, link.value());
    }
  }
}

void OptionLinks::chosen(const QString& key)
{
  if (this->is_updating_widgets_)
  {
    return;
  }
  const QStringList& grouped_keys = this->links_[key].grouped_keys;
  const QStringList keys = grouped_keys.isEmpty() ? QStringList{ key } : grouped_keys;
  this->store_all_except(keys);
  Options values;
  for (const QString& each : keys)
  {
    values[each] = this->links_[each].value();
  }
  this->document_->set_options(values, key);
}

void OptionLinks::set_without_undo(const QString& key, const QVariant& value)
{
  this->document_->set_option_without_undo(key, value);
  this->option_changed(key, value);
}

void OptionLinks::option_changed(const QString& key, const QVariant& value)
{
  const auto link = this->links_.find(key);
  if (link != this->links_.end() && link->second.value() != value)
  {
    this->is_updating_widgets_ = true;
    link->second.set(value);
    this->is_updating_widgets_ = false;
  }
}

} // namespace app::window
