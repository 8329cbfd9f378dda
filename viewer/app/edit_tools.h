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

/// The row of tools above the picture: groups of buttons, one per action. All buttons have text if
/// there is room, otherwise only those of the first group, otherwise none.
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

/// The choices of the current edit mode, shown over the upper left corner of the picture.
class ModeBar : public QFrame
{
  Q_OBJECT

public:
  explicit ModeBar(QAction* inside, QWidget* parent);

  /// Which choices are shown.
  struct State
  {
    QString title;
    bool places = false; ///< points or bones: whether inside or on the surface
    bool cage = false;
    bool making_cage = false;
    bool paints = false;
    bool has_region = false; ///< the next stroke continues a region
    double radius = 0.0; ///< of the brush, as a fraction of the shape's diagonal
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
