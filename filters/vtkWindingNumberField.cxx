// Connects the kernels of winding_field.h to VTK. The kernels compute the winding numbers; this
// filter determines the samples and the form of the output. The pipeline needs the grid before it
// requests data. The grid depends on the bounds of the surface, so RequestInformation() updates the
// surface. Execute() computes the grid again from its input surface. If the result differs from the
// announced grid, Execute() ignores the requested extent and computes the winding numbers of the
// whole grid.
//
// Arrays of doubles are filled directly by the kernels; arrays of floats are filled block by block
// through a buffer. The values do not depend on the blocks.
#include "vtkWindingNumberField.h"

#include "base/execution.h"
#include "base/large_pages.h"
#include "base/parallel.h"
#include "bind_key.h"
#include "conversion.h"
#include "grid_request.h"
#include "output_type.h"
#include "winding_field.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
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
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include <unistd.h>

vtkStandardNewMacro(vtkWindingNumberField);

namespace
{
/// Cache of the arrays of the last grid. The cache stores weak pointers, so the arrays are
/// available only while an output uses them. With several processes, ParaView requests the field
/// and then, in a second request, the boundary with ghost levels, which only unstructured outputs
/// can have. Without this cache the second request would compute the field again.
struct CachedGrid
{
  vtkMTimeType parameters = 0;
  std::array<bindpose::Index, 6> extent{};
  std::vector<vtkWeakPointer<vtkDataArray>> arrays;
  double sum = 0.0;
  bindpose::Status status;
};
} // namespace

struct vtkWindingNumberField::Cache
{
  bool valid = false;
  bindpose::BindKey key;
  bindpose::WindingField::Options options;
  bindpose::Box box;
  int flat_axis = -1; // axis perpendicular to a curve's plane; -1: no curve
  bindpose::WindingField field;
  bindpose::Status status;
  CachedGrid last;
};

namespace
{
using bindpose::ExecutionContext;
using bindpose::Index;
using bindpose::SampleGrid;
using bindpose::Samples;
using bindpose::Status;
using bindpose::Vec3;
using bindpose::WindingField;
using SDDP = vtkStreamingDemandDrivenPipeline;

/// Number of samples per block if the output has floats. The buffer of doubles then has 32 MiB.
constexpr Index samples_per_block = Index(1) << 22;

bindpose::BindKey key_of(vtkPointSet* surface, const std::string& area_array)
{
  bindpose::BindKey key;
  for (vtkObject* object : bindpose::bind_objects(surface, { area_array }))
  {
    key.add(object);
  }
  if (auto* polydata = vtkPolyData::SafeDownCast(surface))
  {
    key.add(polydata->GetLines());
  }
  key.add(surface->GetPointData()->GetNormals());
  key.add(surface->GetPointData()->GetArray("Normals"));
  return key;
}

using Arrays = std::vector<vtkSmartPointer<vtkDataArray>>;

/// Create an array for the values of all samples. It uses large pages, so that memory is released
/// quickly after a cancel.
template <typename Array>
vtkSmartPointer<Array> make_large_array(const char* name, int components, Index count)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  const auto values = static_cast<std::size_t>(array->GetNumberOfValues());
  if (values > 0)
  {
    bindpose::request_large_pages(array->GetPointer(0), values * sizeof(*array->GetPointer(0)));
  }
  return array;
}

/// The requested arrays, filled block by block.
struct Outputs
{
  vtkSmartPointer<vtkDataArray> values;
  vtkSmartPointer<vtkDataArray> gradient; ///< array of gradients; null: not requested
  vtkSmartPointer<vtkUnsignedCharArray> on_surface;
  vtkSmartPointer<vtkUnsignedCharArray> inside; ///< array of inside flags; null: not requested
  double threshold = 0.5;

  Outputs(Index count, bool single, bool with_gradient, bool with_inside)
  {
    const auto floating = [&](const char* name, int components) -> vtkSmartPointer<vtkDataArray>
    {
      if (single)
      {
        return make_large_array<vtkFloatArray>(name, components, count);
      }
      return make_large_array<vtkDoubleArray>(name, components, count);
    };
    const auto flags = [&](const char* name)
    { return make_large_array<vtkUnsignedCharArray>(name, 1, count); };
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

  /// Return the requested arrays; the winding numbers are first.
  Arrays arrays() const
  {
    Arrays requested{ this->values, this->on_surface };
    if (this->inside)
    {
      requested.emplace_back(this->inside);
    }
    if (this->gradient)
    {
      requested.emplace_back(this->gradient);
    }
    return requested;
  }
};

void attach(const Arrays& arrays, vtkDataSetAttributes* attributes)
{
  for (const auto& array : arrays)
  {
    attributes->AddArray(array);
  }
  // SetScalars() would remove the scalars of the input points.
  attributes->SetActiveScalars(arrays.front()->GetName());
}

/// Return the arrays of the last grid if the parameters and the extent are the same and the arrays
/// still exist. Otherwise return no arrays.
Arrays cached(const CachedGrid& last, vtkMTimeType parameters, const SampleGrid& grid)
{
  const bool is_same_grid = last.parameters == parameters && last.extent == grid.extent;
  Arrays arrays;
  for (const auto& array : last.arrays)
  {
    if (!is_same_grid || !array)
    {
      return {};
    }
    arrays.emplace_back(array);
  }
  return arrays;
}

/// Return the memory into which the kernel writes values: the array's memory if it stores doubles,
/// otherwise a buffer.
double* output_buffer(vtkDataArray* array, Index first, Index count, std::vector<double>& buffer)
{
  if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
  {
    return doubles->GetPointer(first);
  }
  buffer.resize(static_cast<std::size_t>(count));
  return buffer.data();
}

void store_values(const double* from, vtkDataArray* array, Index first, Index count)
{
  if (auto* floats = vtkFloatArray::SafeDownCast(array))
  {
    std::transform(from, from + count, floats->GetPointer(first),
      [](double value) { return static_cast<float>(value); });
  }
}

/// Evaluate all samples into the outputs. The reports of the blocks are added up. `sum` is the sum
/// of all winding numbers.
Status evaluate(ExecutionContext& context, const WindingField& winding, const Samples& samples,
  Outputs& outputs, double& sum)
{
  const Index layer_size = samples.layer_size();
  const Index layers = samples.count() / layer_size;
  const bool in_blocks = vtkFloatArray::SafeDownCast(outputs.values) != nullptr;
  const Index step =
    in_blocks ? std::max<Index>(samples_per_block / layer_size, 1) : std::max<Index>(layers, 1);
  const double value_fraction = outputs.gradient ? 0.5 : 1.0;
  std::vector<double> buffer;
  std::map<std::string, std::int64_t> counts;
  Status total;
  sum = 0.0;
  // Run once even without samples, because the kernel's report is needed.
  for (Index begin = 0; begin < layers || begin == 0; begin += step)
  {
    const Index end = std::min(begin + step, layers);
    const Index first = begin * layer_size;
    const Index number = (end - begin) * layer_size;
    const double done = layers ? static_cast<double>(begin) / static_cast<double>(layers) : 0.0;
    const double end_fraction =
      layers ? static_cast<double>(end) / static_cast<double>(layers) : 1.0;
    const bindpose::ProgressRange range(context, done, end_fraction);
    unsigned char* const flags = outputs.on_surface->GetPointer(first);
    double* const values = output_buffer(outputs.values, first, number, buffer);
    Status status;
    {
      const bindpose::ProgressRange part(context, 0.0, value_fraction);
      status = winding.evaluate(context, samples.layers(begin, end), values, flags);
    }
    if (!status.ok())
    {
      return status;
    }
    bindpose::ExecutionContext silent_context;
    silent_context.set_threads(context.threads());
    unsigned char* const inside = outputs.inside ? outputs.inside->GetPointer(first) : nullptr;
    sum += bindpose::parallel_sum(silent_context, number, 65536,
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
    store_values(values, outputs.values, first, number);
    if (outputs.gradient)
    {
      const bindpose::ProgressRange part(context, value_fraction, 1.0);
      double* const gradients = output_buffer(outputs.gradient, 3 * first, 3 * number, buffer);
      const Status gradient =
        winding.evaluate_gradient(context, samples.layers(begin, end), gradients);
      if (!gradient.ok())
      {
        return gradient;
      }
      store_values(gradients, outputs.gradient, 3 * first, 3 * number);
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

/// Report whether a grid is one sample thin, so that its samples have no volume.
bool is_flat(const SampleGrid& grid)
{
  return grid.size(0) < 2 || grid.size(1) < 2 || grid.size(2) < 2;
}

/// Return invalid_input if the arrays would be larger than the machine's memory. Otherwise the
/// system might kill the process.
Status check_memory(Index samples, std::size_t bytes_per_sample)
{
  const double needed = static_cast<double>(samples) * static_cast<double>(bytes_per_sample);
  const double available =
    static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed <= available)
  {
    return {};
  }
  std::ostringstream text;
  text.precision(3);
  text << samples << " samples need " << needed / 0x1p30 << " GiB of memory, but this computer has "
       << available / 0x1p30 << " GiB; request a part of the grid or a coarser grid";
  return Status::invalid_input(text.str());
}
} // namespace

vtkWindingNumberField::vtkWindingNumberField() : BuildCache(this->GetBlock())
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
    // The output has the structure of the points on input 1. Copy this structure, because the
    // executive has copied the structure of input 0 (the surface).
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
    // VTK's composite executive calls this function once with the whole composite, and then once
    // per block. In the calls for blocks, the block replaces the producer's output; these calls
    // must not update the producer.
    return 1;
  }
  vtkExecutive* producer = vtkExecutive::PRODUCER()->GetExecutive(surface_info);
  if (producer && !this->GetBlock().composite)
  {
    // Request the whole surface, because another consumer may have requested only a piece.
    RequestWholeInput(surface_info);
    producer->Update(vtkExecutive::PRODUCER()->GetPort(surface_info));
    data = vtkDataObject::GetData(surface_info);
  }

  int grid_extent[6] = { 0, 0, 0, 0, 0, 0 };
  SampleGrid grid;
  // If this fails, Execute() reports the error.
  if (this->Grid(vtkPointSet::SafeDownCast(data), grid).ok())
  {
    std::copy(grid.extent.begin(), grid.extent.end(), grid_extent);
  }
  info->Set(SDDP::WHOLE_EXTENT(), grid_extent, 6);
  info->Set(vtkDataObject::ORIGIN(), grid.origin.data(), 3);
  info->Set(vtkDataObject::SPACING(), grid.spacing.data(), 3);
  info->Set(CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(
    info, this->OutputPrecision == SINGLE_PRECISION ? VTK_FLOAT : VTK_DOUBLE, 1);
  return 1;
}

int vtkWindingNumberField::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (this->GetPiecePort() >= 0)
  {
    return this->Superclass::RequestUpdateExtent(request, input, output);
  }
  RequestWholeInput(input[0]->GetInformationObject(0)); // every sample depends on the whole surface
  return 1;
}

bindpose::Status vtkWindingNumberField::Grid(vtkPointSet* input, bindpose::SampleGrid& grid)
{
  bindpose::Box box;
  int flat_axis = -1;
  if (input && this->BuildCache->valid &&
    this->BuildCache->key == key_of(input, this->AreaArrayName))
  {
    box = this->BuildCache->box;
    flat_axis = this->BuildCache->flat_axis;
  }
  else
  {
    const Status status = WindingField::extent(input, box, flat_axis);
    if (!status.ok())
    {
      return status;
    }
  }
  bindpose::GridRequest request;
  std::copy_n(this->Dimensions, 3, request.dimensions);
  std::copy_n(this->Spacing, 3, request.spacing);
  std::copy_n(this->Bounds, 6, request.bounds);
  request.count = this->TargetNumberOfSamples;
  request.samples_along_longest_side = this->Resolution;
  request.padding = this->Padding;
  request.flat_axis = flat_axis;
  return bindpose::make_grid(request, box, grid);
}

namespace
{
/// Round a number of points to a power of 4. The acceleration structure depends only on the rounded
/// number, so that values do not depend on earlier evaluations.
bindpose::Index size_class(bindpose::Index points)
{
  return bindpose::Index(1) << 2 *
    std::lround(0.5 * std::log2(static_cast<double>(std::max<bindpose::Index>(1, points))));
}

/// Return a box that contains the points near the surface, or an empty box if the points fill more
/// than half of the space around the surface. The box consists of cells of a coarse grid, so points
/// that move a little need no new acceleration structure.
bindpose::Box query_region(vtkDataSet* points, vtkDataSet* surface)
{
  constexpr double padding = 0.1; // in bounding-box diagonals; the default Padding of grids
  constexpr double cells = 16.0; // number of cells of the coarse grid along each axis
  const double* bounds = points->GetBounds();
  const double* around = surface->GetBounds();
  const double diagonal = surface->GetLength();
  if (!std::isfinite(diagonal)) // unused points may have coordinates that are not finite
  {
    return {};
  }
  bindpose::Box region;
  double share = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    const double lower = around[2 * k] - padding * diagonal;
    const double cell = (around[2 * k + 1] + padding * diagonal - lower) / cells;
    const double first = std::max(0.0, std::floor((bounds[2 * k] - lower) / cell));
    const double end = std::min(cells, std::floor((bounds[2 * k + 1] - lower) / cell) + 1.0);
    if (!(first < end)) // all points are far from the surface
    {
      return {};
    }
    region.lower[k] = lower + first * cell;
    region.upper[k] = lower + end * cell;
    share *= (end - first) / cells;
  }
  return share <= 0.5 ? region : bindpose::Box();
}
} // namespace

bindpose::Status vtkWindingNumberField::Build(
  bindpose::ExecutionContext& context, vtkPointSet* input, vtkDataSet* points, long long queries)
{
  WindingField::Options options;
  options.method = this->Method;
  options.tolerance = this->Tolerance;
  options.orient = this->OrientPatches;
  options.area_array = this->AreaArrayName;
  // Count a sample with a gradient as nine queries, because a gradient takes several times as long
  // as a value.
  options.expected_queries = size_class(queries * (this->ComputeGradient ? 9 : 1));
  if (points)
  {
    options.query_region = query_region(points, input);
  }
  // The cached structure of an exact method is valid for any number of queries, because it is
  // extended when necessary.
  const bool fits = this->BuildCache->valid &&
    (this->BuildCache->options.expects_same_queries(options) ||
      !this->BuildCache->field.depends_on_expected_queries());
  if (input && fits && this->BuildCache->options == options &&
    this->BuildCache->key == key_of(input, this->AreaArrayName))
  {
    // Warnings are issued only by the update that builds the structure.
    Status cached = this->BuildCache->status;
    if (!cached.warnings.empty())
    {
      cached.report.set("warnings[]", cached.warnings);
      cached.warnings.clear();
    }
    return cached;
  }
  std::unique_ptr<Cache> new_cache(new Cache);
  Status status = new_cache->field.build(context, input, options);
  if (!status.ok())
  {
    return status;
  }
  new_cache->key = key_of(input, this->AreaArrayName);
  new_cache->options = options;
  WindingField::extent(input, new_cache->box, new_cache->flat_axis);
  new_cache->status = status;
  new_cache->valid = true;
  this->BuildCache.reset(std::move(new_cache));
  this->NumberOfBuilds += 1;
  return status;
}

bindpose::Status vtkWindingNumberField::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  auto* surface = vtkPointSet::GetData(input[0]);
  vtkDataSet* points = vtkDataSet::GetData(input[1]);
  vtkInformation* info = output->GetInformationObject(0);
  vtkDataSet* result = vtkDataSet::GetData(info);
  SampleGrid whole_grid;
  if (!points)
  {
    // Check the grid before the structure is built, because the build may take long.
    const Status status = this->Grid(surface, whole_grid);
    if (!status.ok())
    {
      return status;
    }
  }
  const Index queries = !points ? whole_grid.count()
    : this->SampleCellCenters   ? points->GetNumberOfCells()
                                : points->GetNumberOfPoints();
  const double built = bindpose::winding_build_fraction(surface->GetNumberOfCells(), queries);
  Status status;
  {
    const bindpose::Phase phase(context, "build", 0.0, built);
    status = this->Build(context, surface, points, queries);
  }
  if (!status.ok())
  {
    return status;
  }
  // Output 1, the boundary, is computed only for the first of several pieces.
  vtkPolyData* boundary = vtkPolyData::GetData(output, 1);
  boundary->Initialize();
  if (GetPiece(output->GetInformationObject(1)) == 0)
  {
    boundary->ShallowCopy(this->BuildCache->field.boundary());
  }

  const bindpose::Phase phase(context, "evaluate", built, 1.0);
  SampleGrid grid = whole_grid;
  if (!points)
  {
    int whole_extent[6] = { 0, -1, 0, -1, 0, -1 };
    int requested[6] = { 0, -1, 0, -1, 0, -1 };
    info->Get(SDDP::WHOLE_EXTENT(), whole_extent);
    info->Get(SDDP::UPDATE_EXTENT(), requested);
    if (std::equal(whole_grid.extent.begin(), whole_grid.extent.end(), whole_extent))
    {
      for (int k = 0; k < 3; ++k)
      {
        grid.extent[2 * k] = std::max<Index>(requested[2 * k], whole_extent[2 * k]);
        grid.extent[2 * k + 1] = std::min<Index>(requested[2 * k + 1], whole_extent[2 * k + 1]);
      }
    }
  }
  const Samples samples = points ? Samples(points, this->SampleCellCenters) : Samples(grid);
  const bool single = this->OutputPrecision == SINGLE_PRECISION;
  const Status fits = check_memory(samples.count(),
    (single ? 4 : 8) * (this->ComputeGradient ? 4 : 1) + (this->ComputeInside ? 2 : 1));
  if (!fits.ok())
  {
    return fits;
  }
  const vtkMTimeType parameters = this->MTime.GetMTime();
  CachedGrid& last = this->BuildCache->last;
  Arrays arrays = points ? Arrays() : cached(last, parameters, grid);
  Status evaluated = last.status;
  double sum = last.sum;
  result->Initialize(); // when streaming, frees the last block before the next one is allocated
  if (arrays.empty())
  {
    Outputs outputs(samples.count(), single, this->ComputeGradient, this->ComputeInside);
    outputs.threshold = this->WindingThreshold;
    evaluated = evaluate(context, this->BuildCache->field, samples, outputs, sum);
    if (!evaluated.ok())
    {
      return evaluated;
    }
    arrays = outputs.arrays();
    if (!points)
    {
      last = { parameters, grid.extent, { arrays.begin(), arrays.end() }, sum, evaluated };
      // The warnings were issued by this execution. Executions that reuse the arrays must not
      // repeat the warnings.
      last.status.warnings.clear();
    }
  }
  if (points)
  {
    result->ShallowCopy(points);
  }
  else
  {
    auto* image = vtkImageData::SafeDownCast(result);
    image->SetOrigin(whole_grid.origin.data());
    image->SetSpacing(whole_grid.spacing.data());
    int extent[6];
    std::copy(grid.extent.begin(), grid.extent.end(), extent);
    image->SetExtent(extent);
    if (grid.extent == whole_grid.extent && !is_flat(whole_grid))
    {
      status.report.set("winding_volume", sum * whole_grid.spacing.prod());
    }
  }
  attach(arrays,
    points && this->SampleCellCenters ? static_cast<vtkDataSetAttributes*>(result->GetCellData())
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
  os << indent << "AreaArrayName: " << this->AreaArrayName << "\n";
  os << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n";
  os << indent << "Spacing: " << this->Spacing[0] << " " << this->Spacing[1] << " "
     << this->Spacing[2] << "\n";
  os << indent << "TargetNumberOfSamples: " << this->TargetNumberOfSamples << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "Padding: " << this->Padding << "\n";
  os << indent << "SampleCellCenters: " << this->SampleCellCenters << "\n";
  os << indent << "ComputeGradient: " << this->ComputeGradient << "\n";
  os << indent << "ComputeInside: " << this->ComputeInside << "\n";
  os << indent << "WindingThreshold: " << this->WindingThreshold << "\n";
  os << indent
     << "OutputPrecision: " << (this->OutputPrecision == SINGLE_PRECISION ? "SINGLE" : "DOUBLE")
     << "\n";
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n";
}
