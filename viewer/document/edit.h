#ifndef document_edit_h
#define document_edit_h

#include "document/work.h"

#include <QUndoCommand>

#include <functional>

/// One undo step: the work before and after an edit. QUndoStack calls redo() on push.
class Edit : public QUndoCommand
{
public:
  /// A function that applies the difference between two works to the current work. `in_history` is
  /// true for undo and redo, and false for the first call, when the step is pushed.
  using Apply = std::function<void(const Work& before, const Work& after, bool in_history)>;

  /// @param merge  consecutive steps with the same `merge` become one step; empty: the step is
  /// never merged
  Edit(const QString& name, Work before, Work after, const QString& merge, Apply apply);

  void undo() override;
  void redo() override;
  int id() const override { return this->merge_.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* next) override;
  /// Report whether the step changes an option.
  bool changes_option(const QString& key) const;

private:
  Work before_;
  Work after_;
  QString merge_;
  Apply apply_;
  bool was_applied_ = false;
};

#endif
