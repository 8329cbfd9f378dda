#ifndef volume_panel_h
#define volume_panel_h

#include <QFrame>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;
class ValueRow;

/// The panel right of the picture for a volume: slice, isosurface, cloud, and how the surface is
/// shown along with them. Like SidePanel it only tells what the user wants.
class VolumePanel : public QFrame
{
  Q_OBJECT

public:
  explicit VolumePanel(QWidget* parent = nullptr);

  /// Another volume: its values' range. The level becomes 0.5, or what of the range is nearest.
  void set_values(double lowest, double highest);
  void set_position(double position, double lowest, double highest);
  void set_area(double area);
  /// Whether there is a surface besides the volume.
  void set_has_surface(bool there);

  double level() const;
  int surface_look() const;

Q_SIGNALS:
  void slice_wanted(bool shown);
  void orientation_chosen(int orientation); ///< of PlaneHandle
  void position_chosen(double position);
  void isosurface_wanted(bool shown);
  void level_chosen(double level);
  void cloud_wanted(bool shown);
  void surface_look_chosen(int look); ///< of Viewport
  void close_wanted();

private:
  QCheckBox* slice_;
  QButtonGroup* orientations_;
  ValueRow* position_;
  QCheckBox* isosurface_;
  ValueRow* level_;
  QLabel* area_;
  QCheckBox* cloud_;
  QLabel* surface_heading_;
  QComboBox* surface_;
};

#endif
