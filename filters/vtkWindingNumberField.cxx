// The kernel does the numbers. What is left here is where and in which form: the grid follows from
// the surface's bounds, which the pipeline must know before it asks for data; so RequestInformation
// updates the surface. Execute() computes the grid again from the surface it gets and falls back to
// all of it when that is not the grid that was announced.
//
// Samples are evaluated straight into arrays of doubles, or, for floats, block after block through
// a buffer; the values do not depend on the blocks.
#include "vtkWindingNumberField.h"

#include "base/execution.h"
#include "base/parallel.h"
#include "bind_key.h"
#include "conversion.h"
#include "inside/surface_repair.h"
#include "inside/winding_number.h"
#include "output_type.h"
#include "grid_request.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellArray.h"
#include "vtkCellCenters.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include <unistd.h>

vtkStandardNewMacro(vtkWindingNumberField);

struct vtkWindingNumberField::Cache
{
  bool valid = false;
  bindpose::BindKey key;
  int method = AUTO;
  double tolerance = 0.0;
  bool orient = false;
  bindpose::Box box; // of the surface
  bindpose::WindingNumber winding;
  bindpose::Status status;
  vtkNew<vtkPolyData> boundary;
};

namespace
{
using bindpose::ExecutionContext;
using bindpose::Index;
using bindpose::SampleGrid;
using bindpose::Status;
using bindpose::Vec3;
using bindpose::WindingNumber;
using SDDP = vtkStreamingDemandDrivenPipeline;

/// Samples of a block on the way to floats: 32 MiB of values.
constexpr Index block_samples = Index(1) << 22;

bindpose::BindKey key_of(vtkPointSet* surface)
{
  bindpose::BindKey key;
  for (vtkObject* object : bindpose::bind_objects(surface, {}))
  {
    key.add(object);
  }
  return key;
}

/// Where to evaluate: a grid, or points. Both are cut into blocks of whole layers (a z of the grid,
/// a point).
struct Samples
{
  std::optional<SampleGrid> grid;
  bindpose::SharedMatrix<bindpose::Points> points;

  Index count() const { return this->grid ? this->grid->count() : this->points.view().rows(); }
  Index layer() const { return this->grid ? this->grid->size(0) * this->grid->size(1) : 1; }

  /// Calls body(SampleGrid or PointsView) with the layers [begin, end).
  template <typename Body>
  Status with(Index begin, Index end, const Body& body) const
  {
    if (this->grid)
    {
      SampleGrid part = *this->grid;
      part.extent[5] = part.extent[4] + end - 1;
      part.extent[4] += begin;
      return body(part);
    }
    const bindpose::PointsView all = this->points.view();
    return body(bindpose::PointsView(
      Eigen::Map<const bindpose::Points>(all.data() + 3 * begin, end - begin, 3)));
  }
};

/// The samples of a dataset: an image's are a grid unless it is turned.
Samples samples_of(vtkDataSet* data, bool cell_centers)
{
  Samples samples;
  if (cell_centers)
  {
    vtkNew<vtkDoubleArray> centers;
    centers->SetNumberOfComponents(3);
    centers->SetNumberOfTuples(data->GetNumberOfCells());
    vtkCellCenters::ComputeCellCenters(data, centers);
    samples.points.share(centers.Get(), centers->GetPointer(0), data->GetNumberOfCells(), 3);
    return samples;
  }
  auto* image = vtkImageData::SafeDownCast(data);
  if (image && image->GetDirectionMatrix()->IsIdentity())
  {
    SampleGrid grid;
    grid.origin = Vec3(image->GetOrigin());
    grid.spacing = Vec3(image->GetSpacing());
    std::copy_n(image->GetExtent(), 6, grid.extent.begin());
    samples.grid = grid;
    return samples;
  }
  samples.points = bindpose::to_points(data);
  return samples;
}

/// The arrays that a user wants, filled block by block.
struct Outputs
{
  vtkSmartPointer<vtkDataArray> values;
  vtkSmartPointer<vtkDataArray> gradient; ///< null: not wanted
  vtkSmartPointer<vtkUnsignedCharArray> on_surface;
  vtkSmartPointer<vtkUnsignedCharArray> inside; ///< null: not wanted
  double threshold = 0.5;

  Outputs(Index count, bool single, bool with_gradient, bool with_inside)
  {
    const auto floating = [&](const char* name, int components)
    {
      vtkSmartPointer<vtkDataArray> array;
      if (single)
      {
        array = vtkSmartPointer<vtkFloatArray>::New();
      }
      else
      {
        array = vtkSmartPointer<vtkDoubleArray>::New();
      }
      array->SetName(name);
      array->SetNumberOfComponents(components);
      array->SetNumberOfTuples(count);
      return array;
    };
    const auto flags = [&](const char* name)
    {
      auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
      array->SetName(name);
      array->SetNumberOfTuples(count);
      return array;
    };
    this->values = floating("WindingNumber", 1);
    this->on_surface = flags("OnSurface");
    if (with_gradient)
    {
      this->gradient = floating("WindingNumberGradient", 3);
      this->gradient->SetComponentName(0, "x");
      this->gradient->SetComponentName(1, "y");
      this->gradient->SetComponentName(2, "z");
    }
    if (with_inside)
    {
      this->inside = flags("Inside");
    }
  }

  void attach(vtkDataSetAttributes* attributes) const
  {
    attributes->SetScalars(this->values);
    attributes->AddArray(this->on_surface);
    if (this->inside)
    {
      attributes->AddArray(this->inside);
    }
    if (this->gradient)
    {
      attributes->AddArray(this->gradient);
    }
  }
};

/// Where numbers are computed: in the array itself when it holds doubles, else in a buffer.
double* place_for(vtkDataArray* array, Index first, Index count, std::vector<double>& buffer)
{
  if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
  {
    return doubles->GetPointer(first);
  }
  buffer.resize(static_cast<std::size_t>(count));
  return buffer.data();
}

void put(const double* from, vtkDataArray* array, Index first, Index count)
{
  if (auto* floats = vtkFloatArray::SafeDownCast(array))
  {
    std::transform(from, from + count, floats->GetPointer(first),
      [](double value) { return static_cast<float>(value); });
  }
}

/// Evaluates all samples into the outputs. What the blocks report is added up; `sum` is that of all
/// values.
Status evaluate(const WindingNumber& winding, const Samples& samples, ExecutionContext& context,
  Outputs& outputs, double& sum)
{
  const Index layer = std::max<Index>(samples.layer(), 1);
  const Index layers = samples.count() / layer;
  const bool in_blocks = vtkFloatArray::SafeDownCast(outputs.values) != nullptr;
  const Index step =
    in_blocks ? std::max<Index>(block_samples / layer, 1) : std::max<Index>(layers, 1);
  const double share = outputs.gradient ? 0.5 : 1.0;
  std::vector<double> buffer;
  std::map<std::string, std::int64_t> counts;
  Status total;
  sum = 0.0;
  // Once without samples, too: the kernel's report says so.
  for (Index begin = 0; begin < layers || begin == 0; begin += step)
  {
    const Index end = std::min(begin + step, layers);
    const Index first = begin * layer;
    const Index number = (end - begin) * layer;
    const double done = layers ? static_cast<double>(begin) / static_cast<double>(layers) : 0.0;
    const double then = layers ? static_cast<double>(end) / static_cast<double>(layers) : 1.0;
    const bindpose::ProgressRange range(context, done, then);
    unsigned char* const flags = outputs.on_surface->GetPointer(first);
    double* const values = place_for(outputs.values, first, number, buffer);
    Status status;
    {
      const bindpose::ProgressRange part(context, 0.0, share);
      status = samples.with(begin, end,
        [&](const auto& where) { return winding.evaluate(where, context, values, flags); });
    }
    if (!status.ok())
    {
      return status;
    }
    bindpose::ExecutionContext quiet;
    quiet.set_threads(context.threads());
    unsigned char* const inside = outputs.inside ? outputs.inside->GetPointer(first) : nullptr;
    sum += bindpose::parallel_sum(quiet, number, 65536,
      [&](Index from, Index to)
      {
        double partial = 0.0;
        for (Index i = from; i < to; ++i)
        {
          partial += values[i];
          if (inside)
          {
            inside[i] = values[i] >= outputs.threshold;
          }
        }
        return partial;
      });
    put(values, outputs.values, first, number);
    if (outputs.gradient)
    {
      const bindpose::ProgressRange part(context, share, 1.0);
      double* const gradients = place_for(outputs.gradient, 3 * first, 3 * number, buffer);
      const Status gradient = samples.with(begin, end,
        [&](const auto& where) { return winding.evaluate_gradient(where, context, gradients); });
      if (!gradient.ok())
      {
        return gradient;
      }
      put(gradients, outputs.gradient, 3 * first, 3 * number);
    }
    for (const char* key : { "counts.queries", "counts.on_surface", "counts.not_finite" })
    {
      if (status.report.find(key))
      {
        counts[key] += static_cast<std::int64_t>(status.report.number(key, 0.0));
      }
    }
    if (total.warnings.empty())
    {
      total.warnings = status.warnings;
    }
  }
  for (const auto& [key, count] : counts)
  {
    total.report.set(key, count);
  }
  return total;
}

/// The boundary's lines, and the table of components as field data.
void to_polydata(
  const bindpose::SurfaceBoundary& boundary, bindpose::PointsView points, vtkPolyData* polydata)
{
  std::map<Index, vtkIdType> id_of;
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> original;
  original->SetName("OriginalPointIds");
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> multiplicity;
  multiplicity->SetName("Multiplicity");
  vtkNew<vtkIdTypeArray> component;
  component->SetName("Component");
  for (const bindpose::SurfaceBoundary::BoundaryEdge& edge : boundary.edges)
  {
    vtkIdType ends[2];
    int k = 0;
    for (const Index v : { edge.from, edge.to })
    {
      const auto [found, is_new] = id_of.try_emplace(v, vertices->GetNumberOfPoints());
      if (is_new)
      {
        vertices->InsertNextPoint(points(v, 0), points(v, 1), points(v, 2));
        original->InsertNextValue(v);
      }
      ends[k++] = found->second;
    }
    lines->InsertNextCell(2, ends);
    multiplicity->InsertNextValue(static_cast<int>(edge.multiplicity));
    component->InsertNextValue(edge.component);
  }
  polydata->SetPoints(vertices);
  polydata->SetLines(lines);
  polydata->GetPointData()->AddArray(original);
  polydata->GetCellData()->SetScalars(multiplicity);
  polydata->GetCellData()->AddArray(component);

  vtkNew<vtkIdTypeArray> triangles;
  triangles->SetName("ComponentTriangles");
  vtkNew<vtkIdTypeArray> open_edges;
  open_edges->SetName("ComponentOpenEdges");
  vtkNew<vtkDoubleArray> volume;
  volume->SetName("ComponentVolume");
  for (const bindpose::SurfaceBoundary::Component& part : boundary.components)
  {
    triangles->InsertNextValue(part.triangles);
    open_edges->InsertNextValue(part.open_edges);
    volume->InsertNextValue(part.volume);
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{ triangles, open_edges, volume })
  {
    polydata->GetFieldData()->AddArray(array);
  }
}

/// Whether a grid is one sample thin, so that its samples span no volume.
bool is_flat(const SampleGrid& grid)
{
  return grid.size(0) < 2 || grid.size(1) < 2 || grid.size(2) < 2;
}

/// invalid_input when the arrays would be larger than the machine's memory: a sentence is better
/// than being killed.
Status check_memory(Index samples, std::size_t bytes_a_sample)
{
  const double needed = static_cast<double>(samples) * static_cast<double>(bytes_a_sample);
  const double there =
    static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed <= there)
  {
    return {};
  }
  std::ostringstream text;
  text.precision(3);
  text << samples << " samples need " << needed / 0x1p30 << " GiB, and there are " << there / 0x1p30
       << ": ask for part of the grid, or for a coarser one";
  return Status::invalid_input(text.str());
}
} // namespace

vtkWindingNumberField::vtkWindingNumberField() : Built(new Cache)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
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

vtkPolyData* vtkWindingNumberField::GetBoundaryOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkWindingNumberField::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : "vtkPolyData");
  return 1;
}

int vtkWindingNumberField::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkDataSet* points = vtkDataSet::GetData(input[1]);
  bindpose::match_output_type(points ? points : vtkNew<vtkImageData>().Get(), output);
  bindpose::match_output_type(vtkNew<vtkPolyData>().Get(), output, 1);
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

  int whole[6] = { 0, 0, 0, 0, 0, 0 };
  SampleGrid grid;
  bindpose::Box box;
  if (this->SurfaceBox(vtkPointSet::SafeDownCast(data), box).ok() &&
    make_grid(this->Request(), box, grid).ok()) // else Execute() tells
  {
    std::copy(grid.extent.begin(), grid.extent.end(), whole);
  }
  info->Set(SDDP::WHOLE_EXTENT(), whole, 6);
  info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
  info->Set(vtkDataObject::SPACING(), grid.spacing.data(), 3);
  info->Set(CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(
    info, this->OutputPrecision == SINGLE_PRECISION ? VTK_FLOAT : VTK_DOUBLE, 1);
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

bindpose::GridRequest vtkWindingNumberField::Request() const
{
  bindpose::GridRequest request;
  std::copy_n(this->Dimensions, 3, request.dimensions);
  std::copy_n(this->Spacing, 3, request.spacing);
  std::copy_n(this->Bounds, 6, request.bounds);
  request.count = this->TargetNumberOfSamples;
  request.samples_along_longest_side = this->SamplesAlongLongestSide;
  request.padding = this->Padding;
  return request;
}

bindpose::Status vtkWindingNumberField::SurfaceBox(vtkPointSet* input, bindpose::Box& box)
{
  if (input && this->Built->valid && this->Built->key == key_of(input))
  {
    box = this->Built->box;
    return {};
  }
  bindpose::SurfaceInput surface;
  const Status status = bindpose::to_surface(input, surface);
  if (status.ok())
  {
    box = bindpose::bounding_box(surface.points.view(), surface.triangles.view());
  }
  return status;
}

bindpose::Status vtkWindingNumberField::Build(
  vtkPointSet* input, bindpose::ExecutionContext& context)
{
  if (input && this->Built->valid && this->Built->key == key_of(input) &&
    this->Built->method == this->Method && this->Built->tolerance == this->Tolerance &&
    this->Built->orient == this->OrientPatches)
  {
    // Warnings are given once, when there is news.
    Status again = this->Built->status;
    if (!again.warnings.empty())
    {
      again.report.set("warnings[]", again.warnings);
      again.warnings.clear();
    }
    return again;
  }
  bindpose::SurfaceInput surface;
  Status status = bindpose::to_surface(input, surface);
  if (!status.ok())
  {
    return status;
  }
  std::unique_ptr<Cache> made(new Cache);
  made->key = key_of(input);
  made->method = this->Method;
  made->tolerance = this->Tolerance;
  made->orient = this->OrientPatches;
  made->box = bindpose::bounding_box(surface.points.view(), surface.triangles.view());

  bindpose::RepairedSurface repaired;
  const double share = this->OrientPatches ? 0.5 : 0.0;
  if (this->OrientPatches)
  {
    const bindpose::ProgressRange range(context, 0.0, share);
    bindpose::RepairOptions options;
    options.count_self_intersections = false;
    status = bindpose::repair_surface(
      surface.points.view(), surface.triangles.view(), options, repaired, context);
    if (!status.ok())
    {
      return status;
    }
  }
  const bindpose::PointsView points =
    this->OrientPatches ? bindpose::PointsView(repaired.points) : surface.points.view();
  const bindpose::TrianglesView triangles =
    this->OrientPatches ? bindpose::TrianglesView(repaired.triangles) : surface.triangles.view();
  WindingNumber::Options options;
  options.method = this->Method == EXACT ? bindpose::WindingMethod::exact
    : this->Method == FAST               ? bindpose::WindingMethod::fast
                                         : bindpose::WindingMethod::automatic;
  options.tolerance = this->Tolerance;
  {
    const bindpose::ProgressRange range(context, share, 1.0);
    status = made->winding.build(points, triangles, context, options);
  }
  if (!status.ok())
  {
    return status;
  }
  to_polydata(made->winding.boundary(), points, made->boundary);
  if (this->OrientPatches)
  {
    if (vtkDataArray* ids = made->boundary->GetPointData()->GetArray("OriginalPointIds"))
    {
      for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
      {
        ids->SetTuple1(i,
          static_cast<double>(
            repaired.original_vertices[static_cast<std::size_t>(ids->GetTuple1(i))]));
      }
    }
    status.report.set("counts.turned_triangles", repaired.turned_triangles);
    status.report.set("counts.turned_components", repaired.turned_components);
  }
  if (surface.triangulated_cells > 0)
  {
    status.report.set("counts.triangulated_cells", surface.triangulated_cells);
  }
  if (surface.ignored_cells > 0)
  {
    status.report.set("counts.ignored_cells", surface.ignored_cells);
  }
  made->status = status;
  made->valid = true;
  this->Built = std::move(made);
  this->NumberOfBuilds += 1;
  return status;
}

bindpose::Status vtkWindingNumberField::Execute(
  vtkInformationVector** input, vtkInformationVector* output, bindpose::ExecutionContext& context)
{
  auto* surface = vtkPointSet::GetData(input[0]);
  vtkDataSet* points = vtkDataSet::GetData(input[1]);
  vtkInformation* info = output->GetInformationObject(0);
  vtkDataSet* result = vtkDataSet::GetData(info);
  SampleGrid whole;
  if (!points)
  {
    // Before the build, which may take long.
    bindpose::Box box;
    Status status = this->SurfaceBox(surface, box);
    status = status.ok() ? make_grid(this->Request(), box, whole) : status;
    if (!status.ok())
    {
      return status;
    }
  }
  Status status;
  {
    const bindpose::Phase phase(context, "build", 0.0, 0.2);
    status = this->Build(surface, context);
  }
  if (!status.ok())
  {
    return status;
  }
  const WindingNumber& winding = this->Built->winding;
  vtkPolyData::GetData(output, 1)->ShallowCopy(this->Built->boundary);

  const bindpose::Phase phase(context, "evaluate", 0.2, 1.0);
  Samples samples;
  if (points)
  {
    samples = samples_of(points, this->SampleCellCenters);
  }
  else
  {
    int announced[6] = { 0, -1, 0, -1, 0, -1 };
    int wanted[6] = { 0, -1, 0, -1, 0, -1 };
    info->Get(SDDP::WHOLE_EXTENT(), announced);
    info->Get(SDDP::UPDATE_EXTENT(), wanted);
    SampleGrid grid = whole;
    if (std::equal(whole.extent.begin(), whole.extent.end(), announced))
    {
      for (int k = 0; k < 3; ++k)
      {
        grid.extent[2 * k] = std::max<Index>(wanted[2 * k], announced[2 * k]);
        grid.extent[2 * k + 1] = std::min<Index>(wanted[2 * k + 1], announced[2 * k + 1]);
      }
    }
    samples.grid = grid;
  }
  const bool single = this->OutputPrecision == SINGLE_PRECISION;
  const Status fits = check_memory(samples.count(),
    (single ? 4 : 8) * (this->ComputeGradient ? 4 : 1) + (this->ComputeInside ? 2 : 1));
  if (!fits.ok())
  {
    return fits;
  }
  Outputs outputs(samples.count(), single, this->ComputeGradient, this->ComputeInside);
  outputs.threshold = this->Threshold;
  double sum = 0.0;
  const Status evaluated = evaluate(winding, samples, context, outputs, sum);
  if (!evaluated.ok())
  {
    return evaluated;
  }
  if (points)
  {
    result->ShallowCopy(points);
  }
  else
  {
    auto* image = vtkImageData::SafeDownCast(result);
    image->Initialize();
    image->SetOrigin(whole.origin.data());
    image->SetSpacing(whole.spacing.data());
    int extent[6];
    std::copy(samples.grid->extent.begin(), samples.grid->extent.end(), extent);
    image->SetExtent(extent);
    if (samples.grid->extent == whole.extent && !is_flat(whole))
    {
      status.report.set("winding_volume", sum * whole.spacing.prod());
    }
  }
  outputs.attach(points && this->SampleCellCenters
      ? static_cast<vtkDataSetAttributes*>(result->GetCellData())
      : result->GetPointData());
  status.report.set("builds", this->NumberOfBuilds);
  status.report.merge(evaluated.report);
  status.warnings.insert(
    status.warnings.end(), evaluated.warnings.begin(), evaluated.warnings.end());
  return status;
}

void vtkWindingNumberField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const methods[] = { "AUTO", "EXACT", "FAST" };
  os << indent << "Method: " << methods[this->Method] << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "OrientPatches: " << this->OrientPatches << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "Spacing: " << this->Spacing[0] << " " << this->Spacing[1] << " "
     << this->Spacing[2] << "\n";
  os << indent << "TargetNumberOfSamples: " << this->TargetNumberOfSamples << "\n";
  os << indent << "SamplesAlongLongestSide: " << this->SamplesAlongLongestSide << "\n";
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "Padding: " << this->Padding << "\n";
  os << indent << "SampleCellCenters: " << this->SampleCellCenters << "\n";
  os << indent << "ComputeGradient: " << this->ComputeGradient << "\n";
  os << indent << "ComputeInside: " << this->ComputeInside << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent
     << "OutputPrecision: " << (this->OutputPrecision == SINGLE_PRECISION ? "SINGLE" : "DOUBLE")
     << "\n";
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n";
}
