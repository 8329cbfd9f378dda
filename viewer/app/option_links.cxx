// Only signals of a person's choice make steps: clicked, activated, value_chosen.
#include "option_links.h"

#include "document/document.h"
#include "value_row.h"

#include <QAbstractButton>
#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QSlider>
#include <QWidget>

OptionLinks::OptionLinks(Document* document, QWidget* root) : QObject(root), document_(document)
{
  for (const OptionInfo& option : option_table())
  {
    const QString key = option.key;
    QObject* found = root->findChild<QObject*>(key);
    const auto tell = [this, key] { this->chosen(key); };
    if (auto* box = qobject_cast<QCheckBox*>(found))
    {
      this->links_[key] = { [box] { return box->isChecked(); },
        [box](const QVariant& value) { box->setChecked(value.toBool()); } };
      QObject::connect(box, &QCheckBox::clicked, this, tell);
    }
    else if (auto* list = qobject_cast<QComboBox*>(found))
    {
      this->links_[key] = { [list] { return list->currentIndex(); },
        [list](const QVariant& value)
        {
          if (value.toInt() < list->count())
          {
            list->setCurrentIndex(value.toInt());
          }
        } };
      QObject::connect(list, QOverload<int>::of(&QComboBox::activated), this, tell);
    }
    else if (auto* group = qobject_cast<QButtonGroup*>(found))
    {
      this->links_[key] = { [group] { return group->checkedId(); },
        [group](const QVariant& value)
        {
          if (QAbstractButton* button = group->button(value.toInt()))
          {
            button->setChecked(true);
            Q_EMIT group->idClicked(value.toInt());
          }
        } };
      QObject::connect(group, &QButtonGroup::idClicked, this, tell);
    }
    else if (auto* row = qobject_cast<ValueRow*>(found))
    {
      this->links_[key] = { [row] { return row->value(); },
        [row](const QVariant& value)
        {
          row->set_value(value.toDouble());
          Q_EMIT row->value_chosen(value.toDouble());
        } };
      QObject::connect(row, &ValueRow::value_chosen, this, tell);
      QObject::connect(
        row->slider(), &QSlider::sliderReleased, this, [this] { this->document_->end_merge(); });
    }
  }
  QObject::connect(document, &Document::option_changed, this, &OptionLinks::option_changed);
}

void OptionLinks::note_all(const QString& but)
{
  for (const auto& [key, link] : this->links_)
  {
    if (key != but)
    {
      this->document_->note_option(key, link.value());
    }
  }
}

void OptionLinks::chosen(const QString& key)
{
  this->note_all(key);
  this->document_->set_option(key, this->links_[key].value());
}

void OptionLinks::option_changed(const QString& key, const QVariant& value)
{
  const auto link = this->links_.find(key);
  if (link != this->links_.end() && link->second.value() != value)
  {
    link->second.set(value);
  }
}
