#ifndef winding_field_h
#define winding_field_h

#include "base/status.h"
#include "conversion.h"
#include "geometry/mesh.h"
#include "geometry/sample_grid.h"

#include "vtkPolyData.h"

#include <memory>
#include <optional>

class vtkPointSet;

namespace bindpose
{
class ExecutionContext;

/// Return the expected time to build the acceleration structure, as a fraction of the total time,
/// in [0, 1). The function's constants were measured on clean surfaces (characters) and on triangle
/// soups (foliage).
double winding_build_fraction(Index triangles, Index queries);

/// The points of an evaluation: a grid or a list of points. Both can be split into layers. A layer
/// is one z slice of a grid, or one point of a list.
class Samples
{
public:
  explicit Samples(const SampleGrid& grid) : grid_(grid) {}
  /// Use the points of a dataset, or the centers of its cells if `cell_centers` is true. The points
  /// of an image are stored as a grid unless its direction is rotated.
  Samples(vtkDataSet* data, bool cell_centers);

  /// Return the grid; null if the samples are a list of points.
  const SampleGrid* grid() const { return this->grid_ ? &*this->grid_ : nullptr; }
  PointsView points() const { return this->points_.view(); }
  Index count() const;
  /// Return the number of samples in one layer.
  Index layer_size() const;
  Samples layers(Index begin, Index end) const;

private:
  Samples() = default;

  std::optional<SampleGrid> grid_;
  SharedMatrix<Points> points_;
};

/// Evaluates the generalized winding number (Jacobson, Kavan, Sorkine-Hornung 2013) of a dataset.
/// If the dataset has 2D cells, they are the surface. Otherwise its lines are a curve in a plane
/// perpendicular to x, y or z. If it has no lines either, its points with normals are samples of a
/// surface.
class WindingField
{
public:
  struct Options
  {
    int method = 0; ///< vtkWindingNumberField::MethodType
    double tolerance = 1e-3;
    bool orient = false; ///< whether to orient the triangles first; used only for surfaces
    std::string area_array = "Area"; ///< point array of areas; estimated if it is missing
    /// Expected total number of evaluated points (a gradient counts as several points); 0: very
    /// many. Used only for surfaces, to choose the fastest acceleration structure.
    Index expected_queries = 0;
    /// Box that contains most of the evaluated points; empty: a box around the whole surface. Used
    /// only for surfaces.
    Box query_region;

    /// Compare all options except expected_queries and query_region, which only affect the speed of
    /// an evaluation.
    bool operator==(const Options& other) const
    {
      return this->method == other.method && this->tolerance == other.tolerance &&
        this->orient == other.orient && this->area_array == other.area_array;
    }
    bool expects_same_queries(const Options& other) const
    {
      return this->expected_queries == other.expected_queries &&
        this->query_region.lower == other.query_region.lower &&
        this->query_region.upper == other.query_region.upper;
    }
  };

  WindingField();
  ~WindingField();
  WindingField(WindingField&&) noexcept;
  WindingField& operator=(WindingField&&) noexcept;

  /// Compute the bounding box of the input without building an acceleration structure. `flat_axis`
  /// is the axis perpendicular to a curve's plane, -1 for other inputs. Return invalid_input in the
  /// same cases as build().
  static Status extent(vtkPointSet* input, Box& box, int& flat_axis);

  Status build(ExecutionContext& context, vtkPointSet* input, const Options& options);

  /// Compute the winding numbers of all samples, and flags for samples that are on the surface.
  Status evaluate(ExecutionContext& context, const Samples& samples, double* out,
    unsigned char* on_surface) const;
  /// Compute the gradients: 3 x samples.count() derivatives.
  Status evaluate_gradient(ExecutionContext& context, const Samples& samples, double* out) const;

  /// Report whether Options::expected_queries and query_region affect the computed values (within
  /// the tolerance). If so, the field must be built again after one of these options changes.
  bool depends_on_expected_queries() const;

  /// Return the open boundary of a surface; empty for curves and points.
  vtkPolyData* boundary() const { return this->boundary_; }

private:
  struct Kernel;
  template <typename Winding>
  struct GridKernel;
  struct Surface;
  struct Curve;
  struct Cloud;

  std::unique_ptr<Kernel> kernel_;
  vtkSmartPointer<vtkPolyData> boundary_;
};

} // namespace bindpose

#endif
