#include "document/edit.h"

Edit::Edit(
  Document* document, const QString& name, Work after, const QString& merge, Document::Live live)
  : QUndoCommand(name), document_(document), before_(document->work()), after_(std::move(after)),
    merge_(merge), live_(live)
{
}

void Edit::undo()
{
  Q_EMIT this->document_->about_to_change();
  Work work = this->document_->work();
  apply_edit(this->after_, this->before_, work);
  this->document_->in_history_ = true;
  this->document_->become(work, Document::Live::to_be_written);
  this->document_->in_history_ = false;
}

void Edit::redo()
{
  if (this->done_)
  {
    Q_EMIT this->document_->about_to_change();
  }
  Work work = this->document_->work();
  apply_edit(this->before_, this->after_, work);
  this->document_->in_history_ = this->done_;
  this->document_->become(work, this->done_ ? Document::Live::to_be_written : this->live_);
  this->document_->in_history_ = false;
  this->done_ = true;
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
