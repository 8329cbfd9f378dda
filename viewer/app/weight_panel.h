#ifndef weight_panel_h
#define weight_panel_h

#include "bind_job.h"

#include <QFrame>
#include <QStringList>

#include <vector>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class ValueRow;
class vtkDataSet;

/// A method that weights can be compared with. Names are in English, of the context WeightPanel.
struct ComparedMethod
{
  BindMethod method;
  const char* word; ///< in reports and on the command line
  const char* name;
  const char* brief; ///< for a narrow line
};
const std::vector<ComparedMethod>& compared_methods();
/// Index in compared_methods() of the method that solved for a surface's weights, by their report;
/// -1: unknown.
int method_of_weights(vtkDataSet* surface);

/// The panel right of the picture to inspect weights: which, how, what another method does
/// otherwise, and a slice through their volume. Like SidePanel it only tells what the user wants.
class WeightPanel : public QFrame
{
  Q_OBJECT

public:
  /// What is looked at, in the order of its buttons.
  enum What
  {
    weights,
    row_sums,
    difference
  };

  explicit WeightPanel(QWidget* parent = nullptr);

  /// Other weights: a name a column. The column of the same name stays chosen.
  void set_columns(const QStringList& names);
  /// What is there decides what can be chosen.
  struct Facts
  {
    bool has_weights = false;
    bool has_raw = false;
    bool has_handles = false; ///< those of the columns, to solve with another method
    bool has_volume = false;
    bool has_picture = false; ///< that the colours lie over
    bool comparing = false;
    bool compared = false;
    int method = -1; ///< in compared_methods(), that solved for the weights; -1: unknown
  };
  void set_facts(const Facts& facts);
  /// Three lines: the method and the column's proof.
  void set_certificate(const QString& text);
  void set_extrema(const QString& text);
  void set_progress(double fraction, const QString& phase);
  /// Two lines: how far the other method is.
  void set_comparison(const QString& text);
  void set_position(double position, double lowest, double highest);

  int what() const;
  void show_what(int what);
  /// Column, or -1: all.
  int column() const;
  void choose_column(int column);
  bool raw() const;
  bool bands() const;
  bool isolines() const;
  bool extrema() const;
  bool slice() const;

Q_SIGNALS:
  /// How much of the colours is seen over the picture, 0 to 1.
  void tint_chosen(double share);
  /// Another column is shown; -1: all.
  void column_chosen(int column);
  /// Any of what the getters tell.
  void look_changed();
  /// A method, by its place in compared_methods().
  void comparison_wanted(int method);
  void cancel_wanted();
  void orientation_chosen(int orientation); ///< of PlaneHandle
  void position_chosen(double position);

private:
  QButtonGroup* add_choice(const QStringList& names, const QStringList& tips);
  void enable();

  QComboBox* column_;
  QButtonGroup* what_;
  QButtonGroup* raw_;
  QLabel* certificate_;
  QCheckBox* bands_;
  QCheckBox* isolines_;
  QCheckBox* extrema_;
  QLabel* extrema_note_;
  QWidget* tint_row_; ///< of pictures
  ValueRow* tint_;
  QComboBox* method_;
  QPushButton* compare_;
  QPushButton* cancel_;
  QProgressBar* bar_;
  QLabel* comparison_;
  QLabel* inside_;
  QCheckBox* slice_;
  QButtonGroup* orientations_;
  ValueRow* position_;
  Facts facts_;
};

#endif
