#ifndef app_tets_defect_view_h
#define app_tets_defect_view_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::tets
{

/// Shows the defects of a surface in the 3D view, with a legend of their types and counts.
class DefectView
{
public:
  explicit DefectView(view::Viewport* viewport);

  /// Set the defects, as vtkSurfaceDefects outputs them; null: none.
  void set_defects(vtkPolyData* defects);
  vtkPolyData* defects() const { return this->defects_; }
  void show(bool shown);
  bool is_shown() const { return this->shown_ && this->defects_; }

private:
  void update();

  view::Viewport* viewport_;
  vtkSmartPointer<vtkPolyData> defects_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
  bool shown_ = false;
};

} // namespace app::tets

#endif
