#ifndef panel_column_h
#define panel_column_h

#include <QList>
#include <QWidget>

class QButtonGroup;
class QFrame;
class QSplitter;
class HandleTree;
class SidePanel;
class TetPanel;
class VolumePanel;
class WeightPanel;

/// The column right of the picture: the panel to bind and pose with, and those to inspect weights,
/// tets and defects, and volumes with; buttons on top choose when there is work for several. Above
/// the panels that are about handles is the list of handles; what is between both can be dragged.
class PanelColumn : public QWidget
{
  Q_OBJECT

public:
  explicit PanelColumn(QWidget* parent = nullptr);

  enum Panel
  {
    bind_and_pose,
    weights,
    tets,
    volume_slice
  };

  SidePanel* side() const { return this->side_; }
  WeightPanel* weight() const { return this->weight_; }
  TetPanel* tet() const { return this->tet_; }
  VolumePanel* volume() const { return this->volume_; }
  HandleTree* handles() const { return this->handles_; }
  /// What is open decides what can be chosen.
  void set_open(bool volume, bool shape, bool surface);
  void show_panel(int panel);
  int shown_panel() const;

Q_SIGNALS:
  void panel_shown(int panel);

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  QWidget* scrolled(QFrame* panel, int width);
  void show_handles();
  void share_height();

  QFrame* choice_;
  QSplitter* splitter_;
  HandleTree* handles_;
  QButtonGroup* buttons_;
  QList<QWidget*> panels_; // by their numbers; what scrolls them
  SidePanel* side_;
  WeightPanel* weight_;
  TetPanel* tet_;
  VolumePanel* volume_;
  bool has_shape_ = false; ///< a surface or handles
  bool shared_by_hand_ = false;
};

#endif
