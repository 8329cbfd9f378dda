#ifndef conversion_h
#define conversion_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/mesh.h"
#include "pose/pose.h"
#include "weights/domain.h"
#include "weights/handles.h"

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkDataSet;
class vtkIdTypeArray;
class vtkObject;
class vtkPoints;
class vtkPolyData;
class vtkPointSet;
class vtkUnstructuredGrid;

namespace bindpose
{

/// A matrix that looks into VTK's memory when the layout allows it and owns a copy otherwise.
template <typename Matrix>
class SharedMatrix
{
public:
  using View = MatrixView<Matrix>;

  void share(
    vtkSmartPointer<vtkObject> keep, const typename Matrix::Scalar* data, Index rows, Index cols)
  {
    this->keep_ = std::move(keep);
    this->data_ = data;
    this->rows_ = rows;
    this->cols_ = cols;
  }
  void own(Matrix matrix)
  {
    this->keep_ = nullptr;
    this->owned_ = std::move(matrix);
  }
  View view() const
  {
    return this->keep_ || this->is_part_
      ? View(Eigen::Map<const Matrix>(this->data_, this->rows_, this->cols_))
      : View(this->owned_);
  }
  /// Rows [begin, end), shared as the whole is: an owned copy must outlive them.
  SharedMatrix rows(Index begin, Index end) const
  {
    SharedMatrix part;
    const View all = this->view();
    part.keep_ = this->keep_;
    part.data_ = all.data() + begin * all.cols();
    part.rows_ = end - begin;
    part.cols_ = all.cols();
    part.is_part_ = true;
    return part;
  }
  /// True when no copy was made.
  bool shared() const { return this->keep_ != nullptr; }

private:
  vtkSmartPointer<vtkObject> keep_;
  bool is_part_ = false; // of another one
  const typename Matrix::Scalar* data_ = nullptr;
  Index rows_ = 0;
  Index cols_ = 0;
  Matrix owned_;
};

/// Points of any dataset: shared when they are doubles side by side.
BINDPOSEFILTERS_EXPORT SharedMatrix<Points> to_points(vtkDataSet* data);

struct SurfaceInput
{
  SharedMatrix<Points> points;
  SharedMatrix<Triangles> triangles;
  /// Cell that each triangle comes from; empty when triangle i is cell i.
  std::vector<Index> cell_of_triangle;
  Index triangulated_cells = 0; ///< polygons, quads and strips that were split into triangles
  Index ignored_cells = 0; ///< vertices, lines and volume cells
};

/// The 2D cells of a polydata or unstructured grid as triangles; strips and polygons are split.
/// Checks ids and coordinates. invalid_input when there is no 2D cell, naming what there is.
BINDPOSEFILTERS_EXPORT Status to_surface(vtkDataSet* data, SurfaceInput& surface);

struct TetInput
{
  SharedMatrix<Points> points;
  SharedMatrix<Tets> tets;
};

/// invalid_input unless every cell is a tet, naming the first that is not.
BINDPOSEFILTERS_EXPORT Status to_tets(vtkDataSet* data, TetInput& tets);

/// A point or cell array as #tuples x #components doubles; shared when it is a vtkDoubleArray.
BINDPOSEFILTERS_EXPORT SharedMatrix<Weights> to_matrix(vtkDataArray* array);

BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPoints> to_vtk_points(PointsView points);
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> to_polydata(
  PointsView points, TrianglesView triangles);
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  PointsView points, TetsView tets);
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  PointsView points, TrianglesView triangles);

/// What weights live on: the tets of an unstructured grid that has a volume cell, else the 2D cells
/// of a polydata or grid as triangles. Coordinates and ids are checked.
/// @param cell_of_element the cell that each element comes from, when that is not its own number.
BINDPOSEFILTERS_EXPORT Status to_domain(
  vtkDataSet* data, Domain& domain, std::vector<Index>& cell_of_element);

/// Handles of a handle dataset, cell by cell: vertices are points, 2-point lines are bones, unless
/// the cell array HandleKind says otherwise. Missing arrays get defaults: names p1…, b1…, no
/// parent. Checks them with check_handles(). Cage elements are left out of the list.
/// columns[i] is the cell of handle i.
BINDPOSEFILTERS_EXPORT Status to_handles(
  vtkPolyData* data, Handles& handles, std::vector<Index>* cells = nullptr);

/// The handle dataset with all documented cell arrays, in the rest pose, mode full.
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> to_polydata(const Handles& handles);

/// Mode, Transform, Stretch and Twist of the cells; what is missing reads as rest, mode full.
/// invalid_input for numbers that are not finite or arrays of a wrong size, naming the handle.
BINDPOSEFILTERS_EXPORT Status to_pose(
  vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells, Pose& pose);

/// A cell array of one number a handle, 0 without it. invalid_input for one of several components
/// and, naming the handle, for a number that is not finite.
BINDPOSEFILTERS_EXPORT Status to_layers(vtkPolyData* data, const Handles& handles,
  const std::vector<Index>& cells, const std::string& name, Eigen::VectorXd& layers);

/// Writes a pose into the cell arrays of a handle dataset (fresh arrays; others stay shared).
BINDPOSEFILTERS_EXPORT void set_pose(
  vtkPolyData* data, const std::vector<Index>& cells, const Pose& pose);

/// The objects of a handle dataset that a bind depends on: points, cells and every handle array
/// but those of the pose.
BINDPOSEFILTERS_EXPORT std::vector<vtkObject*> bind_objects(vtkPolyData* handles);
/// The same for a mesh: points, cells and the named point arrays (null when absent).
BINDPOSEFILTERS_EXPORT std::vector<vtkObject*> bind_objects(
  vtkPointSet* mesh, const std::vector<std::string>& array_names);

} // namespace bindpose

#endif
