#ifndef document_edit_h
#define document_edit_h

#include "document/document.h"

#include <QUndoCommand>

/// One undo step: the work before and after an edit. Undo and redo change only the parts of the
/// work that the edit changed. QUndoStack calls redo() on push; at that first call handle_data()
/// may already contain the change.
class Edit : public QUndoCommand
{
public:
  Edit(
    Document* document, const QString& name, Work after, const QString& merge, Document::Live live);

  void undo() override;
  void redo() override;
  int id() const override { return this->merge_.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* next) override;

private:
  Document* document_;
  Work before_;
  Work after_;
  QString merge_;
  Document::Live live_;
  bool done_ = false;
};

#endif
