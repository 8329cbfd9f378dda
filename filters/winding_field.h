#ifndef winding_field_h
#define winding_field_h

#include "base/mesh.h"
#include "base/sample_grid.h"
#include "base/status.h"
#include "conversion.h"

#include "vtkPolyData.h"

#include <memory>
#include <optional>

class vtkPointSet;

namespace bindpose
{
class ExecutionContext;

/// Return the expected fraction of the total time that the build takes, in [0, 1). Measured on
/// clean figures and on soups of leaves.
double winding_build_fraction(Index triangles, Index queries);

/// Where to evaluate: a grid, or points. Both can be had in parts of whole layers (a z of the grid,
/// a point).
class Samples
{
public:
  explicit Samples(const SampleGrid& grid) : grid_(grid) {}
  /// The points of a dataset, or the centers of its cells. An image's are a grid unless it is
  /// turned.
  Samples(vtkDataSet* data, bool cell_centers);

  /// The grid, or null.
  const SampleGrid* grid() const { return this->grid_ ? &*this->grid_ : nullptr; }
  PointsView points() const { return this->points_.view(); }
  Index count() const;
  /// Samples of a layer.
  Index layer() const;
  Samples layers(Index begin, Index end) const;

private:
  Samples() = default;

  std::optional<SampleGrid> grid_;
  SharedMatrix<Points> points_;
};

/// What a dataset winds around points: its 2D cells as a surface; without them its lines as a curve
/// in a plane across x, y or z; without those its points with normals.
class WindingField
{
public:
  struct Options
  {
    int method = 0; ///< vtkWindingNumberField::MethodType
    double tolerance = 1e-3;
    bool orient = false; ///< surfaces only
    std::string area_array = "Area"; ///< of points; estimated when there is none
    /// Points to evaluate in total, gradients counted several times; 0: very many. Surfaces only.
    Index expected_queries = 0;

    /// All but expected_queries, which decides how fast an evaluation is.
    bool operator==(const Options& other) const
    {
      return this->method == other.method && this->tolerance == other.tolerance &&
        this->orient == other.orient && this->area_array == other.area_array;
    }
  };

  WindingField();
  ~WindingField();
  WindingField(WindingField&&) noexcept;
  WindingField& operator=(WindingField&&) noexcept;

  /// The box of what winds, without building anything; `flat` is the axis across a curve's plane,
  /// else -1. invalid_input as build() would say.
  static Status extent(vtkPointSet* input, Box& box, int& flat);

  Status build(vtkPointSet* input, const Options& options, ExecutionContext& context);

  /// samples.count() winding numbers, and flags of those on the surface.
  Status evaluate(const Samples& samples, ExecutionContext& context, double* out,
    unsigned char* on_surface) const;
  /// 3 x samples.count() derivatives.
  Status evaluate_gradient(const Samples& samples, ExecutionContext& context, double* out) const;

  /// Whether values depend, within the tolerance, on Options::expected_queries.
  bool depends_on_expected_queries() const;

  /// Where a surface is open; empty for the others.
  vtkPolyData* boundary() const { return this->boundary_; }

private:
  struct Kernel;
  struct Surface;
  struct Curve;
  struct Cloud;

  std::unique_ptr<Kernel> kernel_;
  vtkSmartPointer<vtkPolyData> boundary_;
};

} // namespace bindpose

#endif
