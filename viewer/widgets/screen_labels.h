#ifndef screen_labels_h
#define screen_labels_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>

#include <string>
#include <vector>

class vtkTextActor;
class vtkTextProperty;
class vtkViewport;
class vtkWindow;

namespace bindpose
{

/// Short texts at display positions, all in one font. Actors are reused.
class ScreenLabels
{
public:
  vtkTextProperty* text() const { return this->text_; }
  void clear() { this->used_actors_ = 0; }
  /// Add a text.
  /// @param scale   factor on the font's size
  /// @param color  color of the text. The text is then bold and centered, without a background
  /// plate. If null, the properties of text() are used.
  void add(const std::string& text, const Eigen::Vector2d& display, double scale,
    const double* color = nullptr);
  int render(vtkViewport* viewport);
  void release(vtkWindow* window);

private:
  vtkNew<vtkTextProperty> text_;
  std::vector<vtkSmartPointer<vtkTextActor>> actors_;
  std::size_t used_actors_ = 0;
};

} // namespace bindpose

#endif
