#ifndef panel_column_h
#define panel_column_h

#include <QWidget>

class QButtonGroup;
class QFrame;
class SidePanel;
class TetPanel;
class VolumePanel;
class WeightPanel;

/// The column right of the picture: the panel to bind and pose with, those to inspect weights and
/// tets and defects with, and, while a volume is open, the panel to inspect that with; buttons on
/// top choose when there is work for several.
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
  /// What is open decides what can be chosen.
  void set_open(bool volume, bool shape, bool surface);
  void show_panel(int panel);
  int shown_panel() const;

Q_SIGNALS:
  void panel_shown(int panel);

private:
  QFrame* choice_;
  QButtonGroup* buttons_;
  SidePanel* side_;
  WeightPanel* weight_;
  TetPanel* tet_;
  VolumePanel* volume_;
};

#endif
