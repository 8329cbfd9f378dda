#ifndef volume_panel_h
#define volume_panel_h

#include <QFrame>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class ValueRow;

/// The panel right of the picture for a volume of winding numbers: computes that of a surface, and
/// shows a volume by slice, isosurface and cloud, and how the surface is seen along with them. Like
/// SidePanel it only tells what the user wants.
class VolumePanel : public QFrame
{
  Q_OBJECT

public:
  explicit VolumePanel(QWidget* parent = nullptr);

  /// What is there decides what can be done.
  void set_state(bool has_surface, bool computing, bool has_volume);
  void set_progress(double fraction, const QString& phase);
  /// A line about what is being computed, or was.
  void set_note(const QString& text);
  /// Along the longest side, of the volume that is computed next.
  int samples() const;
  /// Another volume: its values' range. The level becomes 0.5, or what of the range is nearest.
  void set_values(double lowest, double highest);
  void set_position(double position, double lowest, double highest);
  void set_area(double area);
  double level() const;
  int surface_look() const;

Q_SIGNALS:
  void compute_wanted();
  void cancel_wanted();
  void slice_wanted(bool shown);
  void orientation_chosen(int orientation); ///< of PlaneHandle
  void position_chosen(double position);
  void isosurface_wanted(bool shown);
  void level_chosen(double level);
  void cloud_wanted(bool shown);
  void surface_look_chosen(int look); ///< of Viewport
  void close_wanted();

private:
  void enable();

  QComboBox* samples_;
  QPushButton* compute_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* note_;
  QCheckBox* slice_;
  QButtonGroup* orientations_;
  ValueRow* position_;
  QCheckBox* isosurface_;
  ValueRow* level_;
  QLabel* area_;
  QCheckBox* cloud_;
  QLabel* surface_heading_;
  QComboBox* surface_;
  QPushButton* close_;
  bool has_volume_ = false;
};

#endif
