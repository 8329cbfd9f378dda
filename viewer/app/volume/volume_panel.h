#ifndef app_volume_volume_panel_h
#define app_volume_volume_panel_h

#include <QFrame>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace app::parts
{
class ValueRow;
} // namespace app::parts

namespace app::volume
{

/// The panel to the right of the 3D view for a volume, i.e. winding numbers on a grid. In this
/// panel the user computes the winding numbers of the surface, shows the volume as a slice, an
/// isosurface and a cloud (volume rendering), and chooses how the surface is drawn. Like SidePanel,
/// the panel emits signals when the user requests something, and stores no data of the document.
class VolumePanel : public QFrame
{
  Q_OBJECT

public:
  explicit VolumePanel(QWidget* parent = nullptr);

  /// Set the state that determines which widgets are enabled.
  void set_state(bool has_surface, bool computing, bool has_volume);
  void set_progress(double fraction, const QString& phase);
  /// Set a line of text about the current or the last computation.
  void set_note(const QString& text);
  /// Return the number of samples along the longest side of the next volume.
  int samples() const;
  /// Set the range of a new volume's values. The level becomes 0.5, or the nearest value in the
  /// range.
  void set_values(double lowest, double highest);
  void set_position(double position, double lowest, double highest);
  void set_area(double area);
  double level() const;
  int surface_appearance() const;

Q_SIGNALS:
  void compute_requested();
  void cancel_requested();
  void slice_requested(bool shown);
  void orientation_chosen(int orientation); ///< orientation: one of PlaneHandle::Orientation
  void position_chosen(double position);
  void isosurface_requested(bool shown);
  void level_chosen(double level);
  void cloud_requested(bool shown);
  void surface_appearance_chosen(
    int appearance); ///< appearance: one of Viewport::SurfaceAppearance
  void close_requested();

private:
  void enable();

  QComboBox* samples_;
  QPushButton* compute_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* note_;
  QCheckBox* slice_;
  QButtonGroup* orientations_;
  parts::ValueRow* position_;
  QCheckBox* isosurface_;
  parts::ValueRow* level_;
  QLabel* area_;
  QCheckBox* cloud_;
  QLabel* surface_heading_;
  QComboBox* surface_;
  QPushButton* close_;
  bool has_volume_ = false;
};

} // namespace app::volume

#endif
