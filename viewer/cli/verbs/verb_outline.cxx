// Implements bindpose outline IMAGE_OR_CURVES, which triangulates the shape in an image or the
// region inside of curves.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"
#include "pictures/picture_file.h"

#include "vtkNew.h"
#include "vtkPlanarShape.h"

namespace bindpose::cli
{

namespace
{
vtkSmartPointer<vtkDataSet> read_input(Session& session, const std::string& path)
{
  if (!is_picture_file(path))
  {
    return session.read(path);
  }
  vtkSmartPointer<vtkImageData> image;
  const Status status = read_picture(path, image);
  if (!status.ok())
  {
    session.fail(status);
    return nullptr;
  }
  return image;
}
} // namespace

void run_outline(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  if (!session.check_output(output, "vtp vtk"))
  {
    return;
  }
  const std::string path = arguments.text("IMAGE_OR_CURVES");
  const auto data = read_input(session, path);
  if (!data)
  {
    return;
  }
  if (!data->IsA("vtkPolyData") && !data->IsA("vtkImageData"))
  {
    session.invalid(path + " must contain an image or curves");
    return;
  }
  vtkNew<vtkPlanarShape> shape;
  shape->SetInputData(0, data);
  if (arguments.has("handles"))
  {
    const auto handles = session.read_handles(arguments.text("handles"), nullptr);
    if (!handles)
    {
      return;
    }
    shape->SetInputData(1, handles);
  }
  set_planar_shape_options(arguments, shape.Get());
  if (session.run(shape, "outline", 0.0, 1.0, Merge::all))
  {
    session.write(shape->GetOutput(), output);
  }
}

} // namespace bindpose::cli
