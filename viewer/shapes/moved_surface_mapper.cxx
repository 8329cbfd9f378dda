// Uploads a surface with moved points to the graphics card. vtkOpenGLPolyDataMapper rebuilds its
// index buffers whenever the data set is newer than the buffers. The modification time of a data
// set includes the modification time of its points, so moved points would cause a rebuild.
#include "shapes/moved_surface_mapper.h"

#include "base/parallel.h"
#include "conversion.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkTexture.h"

#include <algorithm>
#include <chrono>

namespace bindpose
{

vtkStandardNewMacro(MovedSurfaceMapper);

namespace
{
/// Return the addresses and modification times of all inputs of the buffers, except the times of
/// points, normals and tangents, which may change without a rebuild.
std::vector<vtkMTimeType> state_of(MovedSurfaceMapper& mapper, vtkActor* actor)
{
  std::vector<vtkMTimeType> state;
  const auto add = [&state](vtkObjectBase* object, vtkMTimeType time)
  {
    state.push_back(reinterpret_cast<vtkMTimeType>(object));
    state.push_back(time);
  };
  const auto add_object = [&add](vtkObject* object)
  { add(object, object ? object->GetMTime() : 0); };
  vtkPolyData* surface = mapper.GetInput();
  add(surface, 0);
  add_object(&mapper); // the mapper's modification time includes that of the lookup table
  add_object(actor->GetProperty());
  add_object(actor->GetTexture());
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    add_object(cells);
  }
  vtkPoints* points = surface->GetPoints();
  add(
    points ? points->GetData() : nullptr, static_cast<vtkMTimeType>(surface->GetNumberOfPoints()));
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  vtkDataArray* tangents = surface->GetPointData()->GetTangents();
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(surface->GetPointData()),
         static_cast<vtkDataSetAttributes*>(surface->GetCellData()) })
  {
    add(data->GetScalars(), 0);
    add(data->GetNormals(), 0);
    add(data->GetTCoords(), 0);
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
    {
      vtkAbstractArray* array = data->GetAbstractArray(k);
      const bool may_move = array == normals || array == tangents;
      add(array, may_move ? 0 : array->GetMTime());
    }
  }
  return state;
}

/// Convert the values to floats, on all cores.
void copy_as_floats(vtkDoubleArray* from, vtkFloatArray* to)
{
  to->SetNumberOfComponents(from->GetNumberOfComponents());
  to->SetNumberOfTuples(from->GetNumberOfTuples());
  const double* source = from->GetPointer(0);
  float* target = to->GetPointer(0);
  ExecutionContext context;
  parallel_for(context, from->GetNumberOfValues(), 16384,
    [&](Index begin, Index end)
    {
      std::transform(source + begin, source + end, target + begin,
        [](double each) { return static_cast<float>(each); });
    });
  to->Modified();
}
} // namespace

void MovedSurfaceMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  const auto start = std::chrono::steady_clock::now();
  this->choose_shift();
  if (this->CurrentInput && this->uploaded_state_ == state_of(*this, actor) && this->upload_moved())
  {
    ++this->move_count_;
    this->VBOBuildTime.Modified();
  }
  else
  {
    this->Superclass::BuildBufferObjects(renderer, actor);
    this->uploaded_state_.clear();
    if (this->CurrentInput)
    {
      // Record the state after the upload: the first upload creates the lookup table, and the state
      // contains the modification time of this table.
      this->uploaded_state_ = state_of(*this, actor);
    }
  }
  this->microseconds_ =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

void MovedSurfaceMapper::ComputeBounds()
{
  vtkPolyData* surface = this->GetInput();
  if (!surface || surface->GetNumberOfPoints() == 0)
  {
    this->Superclass::ComputeBounds();
    return;
  }
  const vtkMTimeType time = std::max(surface->GetMTime(), this->MTime.GetMTime());
  if (time == this->bounds_time_)
  {
    return;
  }
  this->bounds_time_ = time;
  const Box box = bounding_box(to_points(surface).view());
  vtkBoundingBox(box.lower[0], box.upper[0], box.lower[1], box.upper[1], box.lower[2], box.upper[2])
    .GetBounds(this->Bounds);
}

/// Disable VTK's shift and scale if single precision is accurate without them.
void MovedSurfaceMapper::choose_shift()
{
  double bounds[6];
  this->GetBounds(bounds);
  const vtkBoundingBox box(bounds);
  // VTK's own limit: distance from the origin, in bounding-box diagonals.
  constexpr double far = 1000.0;
  double center[3] = { 0.0, 0.0, 0.0 };
  if (box.IsValid())
  {
    box.GetCenter(center);
  }
  const bool needs_shift = Eigen::Map<const Vec3>(center).norm() > far * box.GetDiagonalLength();
  using Buffer = vtkOpenGLVertexBufferObject;
  // If shifting is disabled, VTK keeps the last shift. Shifting may therefore be disabled only
  // after an upload in which VTK needed no shift.
  Buffer* buffer = this->VBOs->GetVBO("vertexMC");
  const bool has_shift = buffer && buffer->GetCoordShiftAndScaleEnabled();
  const int method =
    needs_shift || has_shift ? Buffer::AUTO_SHIFT_SCALE : Buffer::DISABLE_SHIFT_SCALE;
  if (method != this->GetVBOShiftScaleMethod())
  {
    this->SetVBOShiftScaleMethod(method);
    this->uploaded_state_.clear();
  }
}

/// Upload only the positions, normals and tangents of the moved points.
/// @return false if the buffers cannot be updated in place
bool MovedSurfaceMapper::upload_moved()
{
  auto* positions = vtkDoubleArray::SafeDownCast(this->CurrentInput->GetPoints()->GetData());
  auto* normals = vtkFloatArray::SafeDownCast(this->CurrentInput->GetPointData()->GetNormals());
  vtkOpenGLVertexBufferObject* position_buffer = this->VBOs->GetVBO("vertexMC");
  vtkOpenGLVertexBufferObject* normal_buffer = this->VBOs->GetVBO("normalMC");
  vtkDataArray* tangents = this->CurrentInput->GetPointData()->GetTangents();
  vtkOpenGLVertexBufferObject* tangent_buffer = this->VBOs->GetVBO("tangentMC");
  if (!positions || !normals || !position_buffer || !normal_buffer ||
    (tangents && !tangent_buffer) || position_buffer->GetCoordShiftAndScaleEnabled() ||
    this->GetVBOShiftScaleMethod() != vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE)
  {
    return false;
  }
  if (position_buffer->GetUploadTime() < positions->GetMTime())
  {
    copy_as_floats(positions, this->positions_);
    // VTK uses one buffer for all mappers of these points, and another mapper may have enabled the
    // shift in this buffer.
    position_buffer->SetCoordShiftAndScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    position_buffer->UploadDataArray(this->positions_);
  }
  if (normal_buffer->GetUploadTime() < normals->GetMTime())
  {
    normal_buffer->UploadDataArray(normals);
  }
  if (tangents && tangent_buffer->GetUploadTime() < tangents->GetMTime())
  {
    tangent_buffer->UploadDataArray(tangents);
  }
  return true;
}

} // namespace bindpose
