#ifndef pqPlacedHandlesPropertyWidget_h
#define pqPlacedHandlesPropertyWidget_h

#include "pqHandlesPropertyWidget.h"

#include <QList>
#include <QPointer>

class QButtonGroup;
class QComboBox;
class QToolButton;
class pqOutputPort;
class pqRepresentation;
class vtkPVPlacedHandlesRepresentation;

/// The panel of Placed Handles for its handles (property HandlesText): points, bones and cages are
/// placed, moved, connected and deleted in the render view.
///
/// Handles are placed on or in one of the shapes that the view shows. A filter downstream may need
/// seconds for new handles, so a drag is applied only when it ends.
class pqPlacedHandlesPropertyWidget : public pqHandlesPropertyWidget
{
  Q_OBJECT
  typedef pqHandlesPropertyWidget Superclass;

public:
  pqPlacedHandlesPropertyWidget(
    vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parent = nullptr);
  ~pqPlacedHandlesPropertyWidget() override;

  void showEvent(QShowEvent* event) override;

public Q_SLOTS:
  void setView(pqView* view) override;

protected Q_SLOTS:
  void show_state() override;

protected:
  bool applies_during_drag() const override { return false; }
  std::string drawn_text() const override;
  QString message() const override;
  QString step_name() const override;

private Q_SLOTS:
  void leave_mode();
  void list_shapes();
  void read_shape();

private:
  Q_DISABLE_COPY(pqPlacedHandlesPropertyWidget)

  vtkPVPlacedHandlesRepresentation* representation() const;
  void add_shapes();
  void add_modes();
  void add_edits();
  void set_mode(int mode);
  pqOutputPort* chosen_shape() const;

  QComboBox* shapes_;
  QList<QPointer<pqOutputPort>> ports_; ///< the entries of shapes_ after "None"
  bool is_shape_outdated_ = false; ///< the shape has changed while the panel was hidden
  QButtonGroup* modes_;
  QToolButton* connect_ = nullptr;
  QToolButton* delete_ = nullptr;
  QToolButton* end_cage_ = nullptr;
};

#endif
