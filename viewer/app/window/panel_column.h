#ifndef app_window_panel_column_h
#define app_window_panel_column_h

#include <QList>
#include <QWidget>

class QButtonGroup;
class QFrame;
class QSplitter;

namespace app::handles
{
class HandleTree;
class SidePanel;
} // namespace app::handles
namespace app::tets
{
class TetPanel;
} // namespace app::tets
namespace app::volume
{
class VolumePanel;
} // namespace app::volume
namespace app::weights
{
class WeightPanel;
} // namespace app::weights

namespace app::window
{

/// The column to the right of the 3D view. It has four panels: pose, weights, tets and volume. If
/// several panels apply, buttons at the top select one. The list of handles is shown above the
/// panels pose and weights. The mouse can drag the border between the list and the panel.
class PanelColumn : public QWidget
{
  Q_OBJECT

public:
  explicit PanelColumn(QWidget* parent = nullptr);

  enum Panel
  {
    bind_and_pose,
    weights,
    tets,
    volume_slice
  };

  handles::SidePanel* side() const { return this->side_; }
  weights::WeightPanel* weight() const { return this->weight_; }
  tets::TetPanel* tet() const { return this->tet_; }
  volume::VolumePanel* volume() const { return this->volume_; }
  handles::HandleTree* handles() const { return this->handles_; }
  /// Set which types of data are open. They determine the panels that can be selected. `shape`: a
  /// surface or handles are open.
  void set_open(bool volume, bool shape, bool surface);
  void show_panel(int panel);
  int shown_panel() const;

Q_SIGNALS:
  void panel_shown(int panel);

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  QWidget* scrolled(QFrame* panel, int width);
  void show_handles();
  void distribute_height();

  QFrame* button_row_;
  QSplitter* splitter_;
  handles::HandleTree* handles_;
  QButtonGroup* buttons_;
  QList<QWidget*> panels_; // one widget per Panel: the panel or its scroll area
  handles::SidePanel* side_;
  weights::WeightPanel* weight_;
  tets::TetPanel* tet_;
  volume::VolumePanel* volume_;
  bool has_shape_ = false; ///< true: a surface or handles are open
  bool height_set_by_user_ = false;
};

} // namespace app::window

#endif
