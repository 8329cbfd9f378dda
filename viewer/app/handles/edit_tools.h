#ifndef app_handles_edit_tools_h
#define app_handles_edit_tools_h

#include <QFrame>
#include <QList>

class QAction;
class QCheckBox;
class QLabel;
class QPushButton;
class QSlider;
class QToolButton;

namespace app::handles
{

/// The row of tools above the 3D view: groups of buttons, one button per action. If the row is too
/// narrow for all texts, only the buttons of the first group have text. If the row is too narrow
/// for these texts, too, all buttons show only their icons.
class EditTools : public QFrame
{
  Q_OBJECT

public:
  EditTools(const QList<QList<QAction*>>& groups, QWidget* parent);

  QSize minimumSizeHint() const override;

protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

private:
  void show_button_texts(int groups);
  int width_with_texts(int groups) const;
  void fit();

  QList<QList<QToolButton*>> buttons_;
};

/// A bar with the options of the current edit mode, over the upper left corner of the 3D view.
class ModeBar : public QFrame
{
  Q_OBJECT

public:
  explicit ModeBar(QAction* inside, QWidget* parent);

  /// The options that the bar shows, and their values.
  struct State
  {
    QString title;
    /// True: show the check box for placing points and bones inside the surface instead of on it.
    bool shows_inside = false;
    bool cage = false;
    bool making_cage = false;
    bool shows_brush = false;
    bool has_region = false; ///< true: the next stroke paints the label of an existing region
    double radius = 0.0; ///< radius of the brush, as a fraction of the shape's diagonal
  };
  void show_state(const State& state);

Q_SIGNALS:
  void end_cage_requested();
  void new_region_requested();
  void radius_chosen(double radius);
  void done_requested();

private:
  QLabel* title_;
  QCheckBox* inside_;
  QPushButton* end_cage_;
  QLabel* brush_;
  QSlider* radius_;
  QPushButton* new_region_;
};

} // namespace app::handles

#endif
