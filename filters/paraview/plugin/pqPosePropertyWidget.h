#ifndef pqPosePropertyWidget_h
#define pqPosePropertyWidget_h

#include "pqHandlesPropertyWidget.h"

#include "vtkWeakPointer.h"

class QButtonGroup;
class QComboBox;
class QToolButton;
class vtkPVHandleSetRepresentation;

/// The panel of Pose Handles for the pose (property PoseJSON). In the render view, the user picks
/// and drags handles, or moves, turns and scales them with the gizmo.
///
/// The widget draws the handles of the filter's input at the pose of the panel. Handles cannot be
/// dragged if the pose comes from a file, is a sequence or has expressions. A button replaces such
/// a pose by the pose that is shown.
class pqPosePropertyWidget : public pqHandlesPropertyWidget
{
  Q_OBJECT
  typedef pqHandlesPropertyWidget Superclass;

public:
  pqPosePropertyWidget(vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parent = nullptr);
  ~pqPosePropertyWidget() override;

protected Q_SLOTS:
  void show_state() override;

protected:
  void set_properties(const std::string& text) override;
  bool applies_during_drag() const override { return true; }
  std::string drawn_text() const override;
  QString message() const override;
  QString step_name() const override;

private Q_SLOTS:
  void watch_input();
  void read_input();
  void read_output();

private:
  Q_DISABLE_COPY(pqPosePropertyWidget)

  vtkPVHandleSetRepresentation* representation() const;
  void add_tools();
  void add_selection_row();
  void reset_all();
  void take_shown_pose();

  QButtonGroup* gizmos_;
  QComboBox* mode_ = nullptr;
  QToolButton* reset_ = nullptr;
  QToolButton* reset_all_ = nullptr;
  QToolButton* take_pose_ = nullptr;
  bool clears_file_ = false; ///< whether applying the next text also clears FileName
  vtkWeakPointer<vtkSMProxy> input_; ///< the observed input
  unsigned long input_observer_ = 0;
};

#endif
