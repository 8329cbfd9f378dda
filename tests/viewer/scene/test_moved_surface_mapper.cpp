// MovedSurfaceMapper: after any change the picture equals the picture of a new VTK mapper. If only
// points have moved, only points and normals are sent to the graphics card.
#include "shapes/moved_surface_mapper.h"
#include "shapes/shaded_surface.h"

#include "conversion.h"
#include "support/meshes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

using namespace bindpose;

namespace
{
/// A window with one surface.
template <class Mapper>
class Scene
{
public:
  explicit Scene(vtkPolyData* surface)
  {
    this->mapper->SetInputData(surface);
    this->actor->SetMapper(this->mapper);
    this->renderer->AddActor(this->actor);
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(0.5, 1.0, 8.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    this->window->SetOffScreenRendering(true);
    this->window->SetMultiSamples(0);
    this->window->SetSize(120, 120);
    this->window->AddRenderer(this->renderer);
  }
  std::vector<unsigned char> picture()
  {
    this->renderer->ResetCameraClippingRange();
    this->window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->window->GetPixelData(0, 0, 119, 119, false, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  vtkNew<Mapper> mapper;
  vtkNew<vtkActor> actor;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
};

class MovedSurface : public testing::Test
{
protected:
  MovedSurface() { this->scene.picture(); }

  /// Compare the picture with the picture of a new VTK mapper.
  void expect_right_picture()
  {
    Scene<vtkOpenGLPolyDataMapper> reference(this->shaded.polydata());
    reference.mapper->SetScalarVisibility(this->scene.mapper->GetScalarVisibility());
    reference.actor->SetProperty(this->scene.actor->GetProperty());
    EXPECT_EQ(this->scene.picture(), reference.picture());
  }

  TriangleMesh mesh = test::join(test::cube(), test::sphere(2, 1.0, Vec3(2, 0, 0)));
  ShadedSurface shaded{ to_polydata(mesh.points, mesh.triangles) };
  Scene<MovedSurfaceMapper> scene{ shaded.polydata() };
};

TEST_F(MovedSurface, TakesTheShortWay)
{
  const std::vector<unsigned char> at_rest = this->scene.picture();
  ASSERT_EQ(this->scene.mapper->move_count(), 0);
  for (int frame = 1; frame <= 3; ++frame)
  {
    Points moved = this->mesh.points;
    moved.col(0) *= 1.0 + 0.2 * frame;
    this->shaded.move(moved);
    EXPECT_NE(this->scene.picture(), at_rest);
    EXPECT_EQ(this->scene.mapper->move_count(), frame);
    this->expect_right_picture();
  }
}

TEST_F(MovedSurface, SeesNewColorsTrianglesAndMaterials)
{
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  for (vtkIdType v = 0; v < this->shaded.polydata()->GetNumberOfPoints(); ++v)
  {
    heights->InsertNextValue(this->shaded.polydata()->GetPoint(v)[1]);
  }
  this->shaded.polydata()->GetPointData()->SetScalars(heights);
  this->expect_right_picture();
  this->shaded.move(Points(-this->mesh.points));
  heights->SetValue(0, -1.0);
  heights->Modified();
  this->expect_right_picture();
  this->scene.mapper->ScalarVisibilityOff();
  this->shaded.move(this->mesh.points);
  this->expect_right_picture();
  this->scene.actor->GetProperty()->SetInterpolationToFlat();
  this->shaded.move(Points(-this->mesh.points));
  this->expect_right_picture();
  this->scene.actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  this->expect_right_picture();
  EXPECT_EQ(this->scene.mapper->move_count(), 0);
}

/// Return the fraction of bytes at which two pictures differ. Differences of at most 2 levels,
/// which are round-off, do not count.
double difference(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
  if (a.size() != b.size())
  {
    return 1.0;
  }
  std::size_t differing_bytes = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    differing_bytes += std::abs(int(a[k]) - int(b[k])) > 2;
  }
  return static_cast<double>(differing_bytes) / static_cast<double>(a.size());
}

TEST(MovedSurfaceMapper, DrawsShapesOfAnySizeAtTheirPlaceWhileTheyGrow)
{
  // VTK's mapper shifts and scales points if the diagonal is above 31.6 or below 0.0316.
  for (const double size : { 1e-3, 1.0, 20.0, 1e4 })
  {
    const TriangleMesh mesh = test::sphere(3, 0.5 * size);
    ShadedSurface shaded(to_polydata(mesh.points, mesh.triangles));
    Scene<MovedSurfaceMapper> scene(shaded.polydata());
    const auto set_camera = [size](vtkCamera* camera)
    {
      camera->SetPosition(size, 0.0, 12.0 * size);
      camera->SetFocalPoint(size, 0.0, 0.0);
    };
    set_camera(scene.renderer->GetActiveCamera());
    scene.picture();
    for (int frame = 1; frame <= 3; ++frame)
    {
      Points moved = mesh.points;
      moved.col(0) *= 1.0 + frame;
      moved.col(0).array() += 0.5 * size * frame;
      shaded.move(moved);
      Scene<vtkOpenGLPolyDataMapper> reference(shaded.polydata());
      set_camera(reference.renderer->GetActiveCamera());
      EXPECT_LT(difference(scene.picture(), reference.picture()), 0.005) << size << ", " << frame;
      EXPECT_EQ(scene.mapper->move_count(), frame) << size;
    }
  }
}

TEST(MovedSurfaceMapper, AShapeMayBeMovedFarAwayAndBack)
{
  const TriangleMesh mesh = test::sphere(3);
  ShadedSurface shaded(to_polydata(mesh.points, mesh.triangles));
  Scene<MovedSurfaceMapper> scene(shaded.polydata());
  for (const double x : { 0.0, 1.0, 1e6, 2e6, 1.0, 0.0 })
  {
    Points moved = mesh.points;
    moved.col(0).array() += x;
    shaded.move(moved);
    Scene<vtkOpenGLPolyDataMapper> reference(shaded.polydata());
    for (vtkRenderer* renderer : { scene.renderer.Get(), reference.renderer.Get() })
    {
      renderer->GetActiveCamera()->SetPosition(x, 0.0, 5.0);
      renderer->GetActiveCamera()->SetFocalPoint(x, 0.0, 0.0);
    }
    EXPECT_LT(difference(scene.picture(), reference.picture()), 0.005) << x;
  }
}

TEST(MovedSurfaceMapper, ShapesFarFromTheOriginKeepTheirPlaces)
{
  // At x = 1e6, adjacent single-precision numbers differ by about 0.06.
  const TriangleMesh mesh = test::sphere(3);
  Points far = mesh.points;
  far.rowwise() += Eigen::RowVector3d(1e6, 0, 0);
  ShadedSurface shaded(to_polydata(far, mesh.triangles));
  Scene<MovedSurfaceMapper> scene(shaded.polydata());
  const auto set_camera = [](vtkCamera* camera)
  {
    camera->SetPosition(1e6, 0.0, 5.0);
    camera->SetFocalPoint(1e6, 0.0, 0.0);
  };
  set_camera(scene.renderer->GetActiveCamera());
  scene.picture();
  far.col(1) *= 0.5;
  shaded.move(far);
  Scene<vtkOpenGLPolyDataMapper> reference(shaded.polydata());
  set_camera(reference.renderer->GetActiveCamera());
  EXPECT_EQ(scene.picture(), reference.picture());
}

TEST(MovedSurfaceMapper, BoundsAreThoseOfWhatIsDrawn)
{
  TriangleMesh mesh = test::sphere(5, 2.0); // enough points for several parallel blocks
  const Index count = mesh.points.rows();
  mesh.points.conservativeResize(count + 1, 3);
  mesh.points.row(count) << 100.0, 100.0, 100.0; // no triangle uses this point
  ShadedSurface shaded(to_polydata(mesh.points, mesh.triangles));
  EXPECT_EQ(shaded.polydata()->GetNumberOfPoints(), count);
  vtkNew<MovedSurfaceMapper> mapper;
  mapper->SetInputData(shaded.polydata());
  Points moved = mesh.points;
  moved.col(2) *= 3.0;
  shaded.move(moved);
  double bounds[6];
  mapper->GetBounds(bounds);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(bounds[2 * axis], moved.topRows(count).col(axis).minCoeff());
    EXPECT_EQ(bounds[2 * axis + 1], moved.topRows(count).col(axis).maxCoeff());
  }
}
} // namespace
