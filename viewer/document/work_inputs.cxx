#include "document/work_inputs.h"

#include "document/bound_columns.h"

#include "conversion.h"
#include "weights_arrays.h"

#include "vtkDataSetSurfaceFilter.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <QCryptographicHash>
#include <QFile>

using namespace bindpose;

namespace
{
/// Return the surface of a mesh. For tets it is their boundary, with the weights of the tets.
vtkSmartPointer<vtkPolyData> surface_of(vtkDataSet* mesh)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  if (auto* surface = vtkPolyData::SafeDownCast(mesh))
  {
    result->ShallowCopy(surface);
    return result;
  }
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(mesh);
  surface->Update();
  result->ShallowCopy(surface->GetOutput());
  return result;
}

Handles handles_of(vtkPolyData* data)
{
  Handles handles;
  if (data)
  {
    to_handles(data, handles);
  }
  return handles;
}

/// Use the weights of the mesh file for the current handles if they fit.
void adopt_weights(Work& work)
{
  if (!work.bound_handles && work.handles && weights_of(work.surface) &&
    weights_fit(weights_of(work.surface), handles_of(work.handles)))
  {
    work.bound_handles = work.handles;
  }
}
} // namespace

vtkDataArray* weights_of(vtkPolyData* surface)
{
  return surface ? surface->GetPointData()->GetArray("Weights") : nullptr;
}

Status use_mesh(vtkDataSet* mesh, const QString& name, const Source& source, Work& work)
{
  SurfaceInput surface;
  const vtkSmartPointer<vtkPolyData> skin =
    vtkPointSet::SafeDownCast(mesh) ? surface_of(mesh) : nullptr;
  Status status = to_surface(skin ? skin.Get() : mesh, surface);
  if (!status.ok())
  {
    return status;
  }
  TetInput tets;
  auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh);
  const bool has_tets = grid && to_tets(grid, tets).ok();
  work.name = name;
  work.surface = skin;
  work.mesh_tets = has_tets ? grid : nullptr;
  work.weighted_tets = work.mesh_tets;
  work.differs_from_file = source.path.isEmpty();
  work.picture = nullptr;
  work.look = nullptr;
  work.mesh_source = source;
  work.picture_source = Source();
  if (weights_of(skin))
  {
    work.bound_handles = nullptr;
    adopt_weights(work);
  }
  return status;
}

Status use_handles(vtkPolyData* data, const Source& source, Work& work)
{
  Handles handles;
  std::vector<Index> cells;
  Pose pose;
  Status status = to_handles(data, handles, &cells);
  if (status.ok())
  {
    status = to_pose(data, handles, cells, pose);
  }
  if (!status.ok())
  {
    return status;
  }
  work.handles = vtkSmartPointer<vtkPolyData>::New();
  work.handles->DeepCopy(data);
  work.pose = pose;
  work.handle_source = source;
  if (work.bound_handles && weights_of(work.surface) &&
    !BoundColumns(handles_of(work.bound_handles), handles).any())
  {
    work.bound_handles = nullptr;
  }
  adopt_weights(work);
  return status;
}

Status use_weights(const Weights& weights, const QString& name, Work& work)
{
  const std::string file = name.toStdString();
  if (!work.surface || !work.handles)
  {
    return Status::invalid_input(file + " contains weights; open the mesh and the handles first");
  }
  const Handles handles = handles_of(work.handles);
  if (weights.rows() != work.surface->GetNumberOfPoints() ||
    weights.cols() != static_cast<Index>(handles.size()))
  {
    return Status::invalid_input(file + " contains weights for " + std::to_string(weights.rows()) +
      " points and " + std::to_string(weights.cols()) + " handles, but the mesh has " +
      std::to_string(work.surface->GetNumberOfPoints()) + " points, and " +
      std::to_string(handles.size()) + " handles are open");
  }
  if (!weights.allFinite())
  {
    return Status::invalid_input(file + " contains a weight that is not finite");
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(work.surface);
  vtkNew<vtkFieldData> without_certificates;
  surface->SetFieldData(without_certificates);
  surface->GetPointData()->RemoveArray("RawWeights");
  surface->GetPointData()->AddArray(to_weights_array("Weights", weights, handles));
  work.surface = surface;
  work.weighted_tets = nullptr;
  work.bound_handles = work.handles;
  work.differs_from_file = true;
  return {};
}

QByteArray checksum_of(const QString& path)
{
  QFile file(path);
  QCryptographicHash hash(QCryptographicHash::Sha256);
  if (!file.open(QIODevice::ReadOnly) || !hash.addData(&file))
  {
    return {};
  }
  return hash.result().toHex();
}
