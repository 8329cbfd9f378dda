#ifndef edit_tools_h
#define edit_tools_h

#include <QFrame>
#include <QList>

class QAction;
class QCheckBox;
class QLabel;
class QPushButton;
class QSlider;
class QToolButton;

/// The row of tools above the picture: groups of buttons, each an action's. Where there is room
/// they have words, else the first group, else icons alone.
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
  void show_words(int groups);
  int width_with_words(int groups) const;
  void fit();

  QList<QList<QToolButton*>> buttons_;
};

/// What an edit mode has to choose from, over the picture's upper left corner, as long as it is on.
class ModeBar : public QFrame
{
  Q_OBJECT

public:
  explicit ModeBar(QAction* inside, QWidget* parent);

  /// What of it is shown.
  struct State
  {
    QString title;
    bool places = false; ///< points or bones: inside or on the surface
    bool cage = false;
    bool making_cage = false;
    bool paints = false;
    bool has_region = false; ///< the strokes go on with one
    double radius = 0.0; ///< of the brush, over the shape's diagonal
  };
  void show_state(const State& state);

Q_SIGNALS:
  void end_cage_wanted();
  void new_region_wanted();
  void radius_chosen(double radius);
  void done_wanted();

private:
  QLabel* title_;
  QCheckBox* inside_;
  QPushButton* end_cage_;
  QLabel* brush_;
  QSlider* radius_;
  QPushButton* new_region_;
};

#endif
