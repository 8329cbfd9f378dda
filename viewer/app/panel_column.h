#ifndef panel_column_h
#define panel_column_h

#include <QWidget>

class QButtonGroup;
class QFrame;
class SidePanel;
class VolumePanel;

/// The column right of the picture: the panel to bind and pose with, and, while a volume is open,
/// the panel to inspect it with; buttons on top choose when there is work for both.
class PanelColumn : public QWidget
{
  Q_OBJECT

public:
  explicit PanelColumn(QWidget* parent = nullptr);

  SidePanel* side() const { return this->side_; }
  VolumePanel* volume() const { return this->volume_; }
  /// What is open decides what can be chosen.
  void set_open(bool volume, bool shape);
  void show_volume(bool shown);

private:
  QFrame* choice_;
  QButtonGroup* buttons_;
  SidePanel* side_;
  VolumePanel* volume_;
};

#endif
