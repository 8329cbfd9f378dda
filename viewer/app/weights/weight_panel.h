#ifndef app_weights_weight_panel_h
#define app_weights_weight_panel_h

#include "app/weights/bind_job.h"

#include <QFrame>
#include <QStringList>

#include <vector>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class vtkDataSet;

namespace app::parts
{
class ValueRow;
} // namespace app::parts

namespace app::weights
{

/// Return the method with which the weights of a surface were computed, according to their report.
/// The result is an index of bindpose::weight_methods(); -1: unknown.
int method_of_weights(vtkDataSet* surface);

/// The panel to the right of the 3D view for inspecting weights. In it the user chooses the
/// displayed quantity, the type of display, another method for comparison, and a slice through the
/// volume. Like SidePanel, it emits signals when the user requests something, and stores no data of
/// the document.
class WeightPanel : public QFrame
{
  Q_OBJECT

public:
  /// The quantity to display. The values are ids of buttons, from left to right.
  enum Quantity
  {
    weights,
    row_sums,
    difference
  };

  explicit WeightPanel(QWidget* parent = nullptr);

  /// Set the names of the columns. The column with the name of the chosen column stays chosen.
  void set_columns(const QStringList& names);
  /// The state that determines which widgets are enabled.
  struct State
  {
    bool has_weights = false;
    bool has_raw_weights = false;
    /// The handles to which the columns belong are open, so another method can compute weights.
    bool has_handles = false;
    bool has_volume = false;
    bool has_picture = false; ///< the surface is a planar shape, cut out of a picture
    bool has_texture = false; ///< the colors are drawn over textures
    bool comparing = false;
    bool compared = false;
    /// The method of the weights, an index of bindpose::weight_methods(); -1: unknown.
    int method = -1;
  };
  void set_state(const State& state);
  /// Set the three lines about the method and the column's certificate.
  void set_certificate(const QString& text);
  void set_extrema(const QString& text);
  void set_progress(double fraction, const QString& phase);
  /// Set the two lines about the difference between the surface's weights and those of the compared
  /// method.
  void set_comparison(const QString& text);
  void set_position(double position, double lowest, double highest);

  int quantity() const;
  void show_quantity(int quantity);
  /// Return the selected column; -1: all columns.
  int column() const;
  void choose_column(int column);
  bool raw() const;
  bool bands() const;
  bool isolines() const;
  bool extrema() const;
  bool slice() const;

Q_SIGNALS:
  /// Emitted with the opacity of the colors over the texture, 0 to 1.
  void tint_opacity_chosen(double opacity);
  /// Emitted when another column was selected; -1: all columns.
  void column_chosen(int column);
  /// Emitted when the result of any getter has changed.
  void display_changed();
  /// Emitted to request a comparison with this method, an index of bindpose::weight_methods().
  void comparison_requested(int method);
  void cancel_requested();
  void orientation_chosen(int orientation); ///< orientation: one of PlaneHandle::Orientation
  void position_chosen(double position);

private:
  QButtonGroup* add_choice(const char* key, const QStringList& tips);
  void enable();

  QComboBox* column_;
  QButtonGroup* quantity_group_;
  QButtonGroup* normalization_group_;
  QLabel* certificate_;
  QCheckBox* bands_;
  QCheckBox* isolines_;
  QCheckBox* extrema_;
  QLabel* extrema_note_;
  QWidget* tint_row_; ///< row with the slider of the opacity, shown for textured surfaces
  parts::ValueRow* tint_;
  QComboBox* method_;
  QPushButton* compare_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* comparison_;
  QLabel* inside_;
  QCheckBox* slice_;
  QButtonGroup* orientations_;
  parts::ValueRow* position_;
  State state_;
};

} // namespace app::weights

#endif
