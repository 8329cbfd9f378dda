#include "document/edit.h"

Edit::Edit(const QString& name, Work before, Work after, const QString& merge, Apply apply)
  : QUndoCommand(name), before_(std::move(before)), after_(std::move(after)), merge_(merge),
    apply_(std::move(apply))
{
}

void Edit::undo()
{
  this->apply_(this->after_, this->before_, true);
}

void Edit::redo()
{
  this->apply_(this->before_, this->after_, this->was_applied_);
  this->was_applied_ = true;
}

bool Edit::mergeWith(const QUndoCommand* next)
{
  const auto* edit = static_cast<const Edit*>(next);
  if (edit->merge_ != this->merge_)
  {
    return false;
  }
  apply_edit(edit->before_, edit->after_, this->after_);
  this->setText(edit->text());
  this->setObsolete(differences(this->before_, this->after_) == 0);
  return true;
}

bool Edit::changes_option(const QString& key) const
{
  return this->before_.options.value(key) != this->after_.options.value(key);
}
