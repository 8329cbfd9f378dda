#ifndef app_tets_tet_panel_h
#define app_tets_tet_panel_h

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

namespace app::tets
{

/// The panel to the right of the 3D view for tets and defects of a surface. In it the user computes
/// tets, cuts them open and inspects them. Like SidePanel, it emits signals when the user requests
/// something, and stores no data of the document.
class TetPanel : public QFrame
{
  Q_OBJECT

public:
  /// The meshing methods, in the order of the list in the panel.
  enum Method
  {
    automatic,
    constrained,
    remesh,
    embed,
    wrap,
    ftetwild,
    whole_hull
  };
  /// The values that are displayed as colors of the tets, in the order of the list in the panel.
  enum Colors
  {
    plain,
    winding_number,
    label,
    quality,
    method
  };

  explicit TetPanel(QWidget* parent = nullptr);

  void set_state(bool has_surface, bool is_making_tets, bool has_tets);
  void set_progress(double fraction, const QString& phase);
  /// Set the one or two lines under the button that computes tets.
  void set_note(const QString& text);
  void set_position(double position, double lowest, double highest);
  /// Set the text line below the widgets of the cut: the number of displayed tets and of all tets.
  void set_count(qlonglong shown, qlonglong all);
  void set_defects_note(const QString& text);

  bool wants_tets() const;
  void show_tets(bool shown);
  bool wants_defects() const;
  void show_defects(bool shown);
  void set_colors(int colors);

Q_SIGNALS:
  void tets_requested(int method);
  void cancel_requested();
  void show_tets_requested(bool shown);
  void cut_requested(bool cut);
  void other_side_requested(bool other);
  void orientation_chosen(int orientation); ///< orientation: one of PlaneHandle::Orientation
  void position_chosen(double position);
  void shrink_chosen(double factor);
  void colors_chosen(int colors);
  void defects_requested(bool shown);

private:
  void enable();

  QComboBox* method_;
  QPushButton* make_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* note_;
  QCheckBox* tets_;
  QComboBox* colors_;
  QCheckBox* cut_;
  QCheckBox* other_side_;
  QButtonGroup* orientations_;
  parts::ValueRow* position_;
  QLabel* count_;
  QLabel* shrink_label_;
  parts::ValueRow* shrink_;
  QCheckBox* defects_;
  QLabel* defects_note_;
  bool has_tets_ = false;
};

} // namespace app::tets

#endif
