#ifndef pose_history_h
#define pose_history_h

#include "pose/pose.h"

#include <QUndoCommand>

#include <functional>

/// One step of the pose's history: all handles' poses before and after. The first redo, which
/// QUndoStack calls on push, does nothing: the pose is there already.
class PoseStep : public QUndoCommand
{
public:
  using Apply = std::function<void(const bindpose::Pose&)>;

  PoseStep(const QString& name, bindpose::Pose before, bindpose::Pose after, Apply apply)
    : QUndoCommand(name), before_(std::move(before)), after_(std::move(after)),
      apply_(std::move(apply))
  {
  }

  void undo() override { this->apply_(this->before_); }
  void redo() override
  {
    if (this->done_)
    {
      this->apply_(this->after_);
    }
    this->done_ = true;
  }

private:
  bindpose::Pose before_;
  bindpose::Pose after_;
  Apply apply_;
  bool done_ = false;
};

#endif
