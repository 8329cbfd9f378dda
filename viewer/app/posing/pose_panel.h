#ifndef app_posing_pose_panel_h
#define app_posing_pose_panel_h

#include "app/posing/pose_ghost.h"
#include "poser/body.h"
#include "poser/pose_options.h"

#include <QWidget>

#include <vector>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace app::parts
{
class ValueRow;
} // namespace app::parts
namespace app::view
{
class Section;
} // namespace app::view

namespace app::posing
{

/// The panel for posing: the method with its options, a second method for comparison, and the
/// simulated body. The object name of a widget that sets an option is the key of the option. The
/// panel only stores the choices; other classes use them.
class PosePanel : public QWidget
{
  Q_OBJECT

public:
  explicit PosePanel(QWidget* parent = nullptr);

  /// Insert a widget below the method's options and above the rarely used options.
  void insert(QWidget* widget);
  /// Return the chosen options.
  bindpose::PoseOptions options() const;
  void set_method(int method);
  /// Return the method for comparison; -1: none.
  int compared_method() const;
  /// Report whether the compared method is the current method, so that there is nothing to compare.
  bool compares_same_method() const;
  PoseGhost::DisplayMode ghost_display_mode() const;
  bool simulates_motion() const;
  /// How the rotations of the method are shown as colors.
  enum RotationDisplay
  {
    no_rotations,
    clusters,
    angles
  };
  RotationDisplay shown_rotations() const;
  bindpose::BodyOptions body_options() const;

  struct State
  {
    bool ready = false; ///< a surface and handles are open
    bool bound = false; ///< the surface has weights
    bool tets = false; ///< the weights were solved on tets
    bool bones = false;
    bool endpoints = false; ///< the surface has the array EndpointWeights
  };
  void set_state(const State& state);
  /// Show or hide the progress bar for binds of the pose method.
  void set_binding(bool binding);
  void set_progress(double fraction, const QString& phase);
  void set_difference(const QString& text);
  void set_playing(bool playing);
  void set_time(const QString& text);

Q_SIGNALS:
  void method_chosen(int method);
  void options_changed();
  void comparison_changed();
  void simulation_changed();
  void body_changed();
  void play_requested(bool play);
  void step_requested();
  void restart_requested();
  void cancel_requested();

private:
  void add_methods(QVBoxLayout* column);
  void add_options(QVBoxLayout* column);
  void add_comparison(QVBoxLayout* column);
  void add_motion(QVBoxLayout* column);
  QWidget* option(QVBoxLayout* column, const QString& name, QWidget* widget, const QString& tip,
    std::vector<bindpose::PoseMethod> visible_methods);
  void show_options();
  bindpose::PoseMethod method() const;

  struct Option
  {
    QWidget* row;
    std::vector<bindpose::PoseMethod> methods;
  };
  std::vector<Option> options_;
  QVBoxLayout* inserted_layout_;
  State state_;
  QButtonGroup* methods_;
  QLabel* note_;
  QProgressBar* bar_;
  QPushButton* cancel_;
  QWidget* bind_row_;
  QComboBox* pseudo_edges_;
  QComboBox* endpoints_;
  QCheckBox* single_;
  QComboBox* energy_;
  parts::ValueRow* extra_;
  QComboBox* extra_kind_;
  QWidget* extra_kind_row_;
  parts::ValueRow* iterations_;
  parts::ValueRow* budget_;
  QCheckBox* in_tets_;
  QComboBox* rotations_;
  QComboBox* order_;
  QComboBox* boundary_;
  QComboBox* compared_;
  QButtonGroup* ghost_group_;
  QWidget* display_row_;
  QLabel* difference_;
  QCheckBox* simulate_box_;
  QWidget* motion_;
  QPushButton* play_;
  QPushButton* step_;
  QPushButton* restart_;
  QLabel* time_;
  parts::ValueRow* gravity_;
  QComboBox* down_;
  parts::ValueRow* stiffness_;
  parts::ValueRow* damping_;
};

/// Return the methods in the order of buttons, menu entries, keys (1 to 7) and `bindpose deform
/// --method`.
std::vector<bindpose::PoseMethod> pose_methods_in_order();
/// Return the name of a method for menus and lists, and one sentence about its purpose.
QString method_name(bindpose::PoseMethod method);
QString method_purpose(bindpose::PoseMethod method);

} // namespace app::posing

#endif
