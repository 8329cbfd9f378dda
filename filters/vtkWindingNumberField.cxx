// The kernel does the numbers. What is left here is the grid: where it lies follows from the
// surface's bounds, which the pipeline must know before it asks for data; so RequestInformation
// updates the surface. Execute() computes the grid again from the surface it gets and falls back to
// all of it when that is not the grid that was announced.
#include "vtkWindingNumberField.h"

#include "base/execution.h"
#include "base/parallel.h"
#include "conversion.h"
#include "inside/winding_number.h"
#include "output_type.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkWindingNumberField);

namespace
{
using bindpose::Index;
using bindpose::Status;
using bindpose::Vec3;
using SDDP = vtkStreamingDemandDrivenPipeline;

constexpr char array_name[] = "WindingNumber";
/// 8 GiB a thousand times over: beyond it a typing error is more likely than a wish.
constexpr double most_samples = 1e12;

struct GridOptions
{
  int dimensions[3];
  int samples_along_longest_side;
  double bounds[6];
  double padding;
};

/// The grid that options and surface ask for; its extent starts at 0.
Status make_grid(
  const GridOptions& options, const bindpose::Box& surface, bindpose::SampleGrid& grid)
{
  const double* b = options.bounds;
  const int* n = options.dimensions;
  const bool has_bounds = b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5];
  const bool has_dimensions = n[0] != 0 || n[1] != 0 || n[2] != 0;
  if (has_dimensions && (n[0] < 1 || n[1] < 1 || n[2] < 1))
  {
    return Status::invalid_input("each of the grid's dimensions must be at least 1");
  }
  bindpose::Box box = surface;
  if (has_bounds)
  {
    box.lower = Vec3(b[0], b[2], b[4]);
    box.upper = Vec3(b[1], b[3], b[5]);
    if (!box.lower.allFinite() || !box.upper.allFinite())
    {
      return Status::invalid_input("the grid's bounds must be finite numbers");
    }
  }
  else
  {
    const double padding = options.padding * surface.diagonal();
    box.lower.array() -= padding;
    box.upper.array() += padding;
  }

  const Vec3 size = box.size();
  Vec3 count;
  if (has_dimensions)
  {
    count = Vec3(n[0], n[1], n[2]);
    // A single sample spans nothing: it lies in the middle.
    const Vec3 step =
      (count.array() > 1.0).select((size.array() / (count.array() - 1.0)).matrix(), Vec3::Zero());
    const double largest = step.maxCoeff() > 0.0 ? step.maxCoeff() : 1.0;
    grid.spacing = Vec3::Constant(largest);
    if (has_bounds)
    {
      grid.spacing = (step.array() > 0.0).select(step, grid.spacing);
    }
  }
  else
  {
    const double longest = size.maxCoeff();
    const double step =
      longest > 0.0 ? longest / static_cast<double>(options.samples_along_longest_side - 1) : 1.0;
    grid.spacing.setConstant(step);
    // The longest side is N - 1 steps but for rounding, which must not add a sample.
    count = ((size / step).array() - 1e-9).ceil().max(0.0) + 1.0;
  }
  if (count.prod() > most_samples || count.maxCoeff() > VTK_INT_MAX)
  {
    return Status::invalid_input("the grid would have " + std::to_string(count.prod()) +
      " samples; choose fewer along its longest side");
  }
  for (int k = 0; k < 3; ++k)
  {
    grid.extent[2 * k] = 0;
    grid.extent[2 * k + 1] = static_cast<Index>(count[k]) - 1;
  }
  grid.origin = box.center() - 0.5 * grid.spacing.cwiseProduct(count - Vec3::Ones());
  return {};
}

/// Whether a grid is one sample thin, so that its samples span no volume.
bool is_flat(const bindpose::SampleGrid& grid)
{
  return grid.size(0) < 2 || grid.size(1) < 2 || grid.size(2) < 2;
}
} // namespace

vtkWindingNumberField::vtkWindingNumberField()
{
  this->SetNumberOfInputPorts(2);
}

vtkWindingNumberField::~vtkWindingNumberField() = default;

void vtkWindingNumberField::SetPointsData(vtkDataSet* data)
{
  this->SetInputData(1, data);
}

int vtkWindingNumberField::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkDataSet");
  if (port == 1)
  {
    info->Set(INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkWindingNumberField::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataSet");
  return 1;
}

int vtkWindingNumberField::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkDataSet* points = vtkDataSet::GetData(input[1]);
  bindpose::match_output_type(points ? points : vtkNew<vtkImageData>().Get(), output);
  return 1;
}

int vtkWindingNumberField::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkInformation* info = output->GetInformationObject(0);
  if (vtkInformation* points = input[1]->GetInformationObject(0))
  {
    // The output is as the points are; what the executive copied was input 0's.
    for (vtkInformationKey* key : std::initializer_list<vtkInformationKey*>{ SDDP::WHOLE_EXTENT(),
           vtkDataObject::ORIGIN(), vtkDataObject::SPACING(), vtkDataObject::DIRECTION(),
           CAN_PRODUCE_SUB_EXTENT(), CAN_HANDLE_PIECE_REQUEST() })
    {
      info->CopyEntry(points, key);
    }
    return 1;
  }

  vtkInformation* surface_info = input[0]->GetInformationObject(0);
  vtkDataObject* data = vtkDataObject::GetData(surface_info);
  if (vtkCompositeDataSet::SafeDownCast(data))
  {
    // This pass is for the whole; another follows for each block, with the block in place of the
    // producer's output, which must not be updated then.
    this->CompositeTime.Modified();
    return 1;
  }
  const bool is_block =
    this->GetProgressScale() != 1.0 || this->CompositeTime.GetMTime() > this->MTime.GetMTime();
  vtkExecutive* producer = vtkExecutive::PRODUCER()->GetExecutive(surface_info);
  if (producer && !is_block)
  {
    producer->Update(vtkExecutive::PRODUCER()->GetPort(surface_info));
    data = vtkDataObject::GetData(surface_info);
  }

  bindpose::SurfaceInput surface;
  bindpose::SampleGrid grid;
  GridOptions options;
  std::copy_n(this->Dimensions, 3, options.dimensions);
  std::copy_n(this->Bounds, 6, options.bounds);
  options.samples_along_longest_side = this->SamplesAlongLongestSide;
  options.padding = this->Padding;
  int whole[6] = { 0, 0, 0, 0, 0, 0 };
  Status status = bindpose::to_surface(vtkDataSet::SafeDownCast(data), surface);
  if (status.ok())
  {
    status = make_grid(
      options, bindpose::bounding_box(surface.points.view(), surface.triangles.view()), grid);
  }
  if (status.ok()) // else Execute() tells
  {
    std::copy(grid.extent.begin(), grid.extent.end(), whole);
  }
  info->Set(SDDP::WHOLE_EXTENT(), whole, 6);
  info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
  info->Set(vtkDataObject::SPACING(), grid.spacing.data(), 3);
  info->Set(CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_DOUBLE, 1);
  return 1;
}

int vtkWindingNumberField::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector*)
{
  // Every sample depends on the whole surface.
  vtkInformation* info = input[0]->GetInformationObject(0);
  info->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
  info->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
  info->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (info->Has(SDDP::WHOLE_EXTENT()))
  {
    info->Set(SDDP::UPDATE_EXTENT(), info->Get(SDDP::WHOLE_EXTENT()), 6);
  }
  return 1;
}

bindpose::Status vtkWindingNumberField::Execute(
  vtkInformationVector** input, vtkInformationVector* output, bindpose::ExecutionContext& context)
{
  bindpose::SurfaceInput surface;
  Status status = bindpose::to_surface(vtkDataSet::GetData(input[0]), surface);
  if (!status.ok())
  {
    return status;
  }
  vtkDataSet* points = vtkDataSet::GetData(input[1]);
  vtkInformation* info = output->GetInformationObject(0);
  bindpose::SampleGrid whole;
  if (!points)
  {
    GridOptions options;
    std::copy_n(this->Dimensions, 3, options.dimensions);
    std::copy_n(this->Bounds, 6, options.bounds);
    options.samples_along_longest_side = this->SamplesAlongLongestSide;
    options.padding = this->Padding;
    status = make_grid(
      options, bindpose::bounding_box(surface.points.view(), surface.triangles.view()), whole);
    if (!status.ok())
    {
      return status;
    }
  }

  bindpose::WindingNumber winding;
  {
    const bindpose::Phase phase(context, "build", 0.0, 0.2);
    status = winding.build(surface.points.view(), surface.triangles.view(), context);
  }
  if (!status.ok())
  {
    return status;
  }
  if (surface.triangulated_cells > 0)
  {
    status.report.set("counts.triangulated_cells", surface.triangulated_cells);
  }
  if (surface.ignored_cells > 0)
  {
    status.report.set("counts.ignored_cells", surface.ignored_cells);
  }

  const bindpose::Phase phase(context, "evaluate", 0.2, 1.0);
  vtkNew<vtkDoubleArray> values;
  values->SetName(array_name);
  vtkDataSet* result = vtkDataSet::GetData(info);
  Status evaluated;
  if (points)
  {
    const bindpose::SharedMatrix<bindpose::Points> queries = bindpose::to_points(points);
    values->SetNumberOfTuples(queries.view().rows());
    evaluated = winding.evaluate(queries.view(), context, values->GetPointer(0));
    result->ShallowCopy(points);
  }
  else
  {
    int announced[6] = { 0, -1, 0, -1, 0, -1 };
    int wanted[6] = { 0, -1, 0, -1, 0, -1 };
    info->Get(SDDP::WHOLE_EXTENT(), announced);
    info->Get(SDDP::UPDATE_EXTENT(), wanted);
    bindpose::SampleGrid grid = whole;
    if (std::equal(whole.extent.begin(), whole.extent.end(), announced))
    {
      for (int k = 0; k < 3; ++k)
      {
        grid.extent[2 * k] = std::max<Index>(wanted[2 * k], announced[2 * k]);
        grid.extent[2 * k + 1] = std::min<Index>(wanted[2 * k + 1], announced[2 * k + 1]);
      }
    }
    auto* image = vtkImageData::SafeDownCast(result);
    image->Initialize();
    image->SetOrigin(whole.origin.data());
    image->SetSpacing(whole.spacing.data());
    int extent[6];
    std::copy(grid.extent.begin(), grid.extent.end(), extent);
    image->SetExtent(extent);
    values->SetNumberOfTuples(grid.count());
    double* out = values->GetPointer(0);
    evaluated = winding.evaluate(grid, context, out);
    if (evaluated.ok() && grid.extent == whole.extent && !is_flat(whole))
    {
      bindpose::ExecutionContext quiet;
      quiet.set_threads(context.threads());
      const double sum = bindpose::parallel_sum(quiet, grid.count(), 4096,
        [out](Index begin, Index end)
        {
          double partial = 0.0;
          for (Index i = begin; i < end; ++i)
          {
            partial += out[i];
          }
          return partial;
        });
      status.report.set("winding_volume", sum * whole.spacing.prod());
    }
  }
  if (!evaluated.ok())
  {
    return evaluated;
  }
  result->GetPointData()->SetScalars(values);
  status.report.merge(evaluated.report);
  status.warnings.insert(
    status.warnings.end(), evaluated.warnings.begin(), evaluated.warnings.end());
  return status;
}

void vtkWindingNumberField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << (this->Method == AUTO ? "AUTO" : "EXACT") << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "SamplesAlongLongestSide: " << this->SamplesAlongLongestSide << "\n";
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "Padding: " << this->Padding << "\n";
}
