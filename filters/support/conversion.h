#ifndef conversion_h
#define conversion_h

#include "BindposeFiltersModule.h" // for export macro
#include "domain/domain.h"
#include "geometry/mesh.h"
#include "handles/handles.h"
#include "pose/pose.h"

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

// Conversion between VTK datasets and the types of the kernels (points, triangles, tets, handles
// and poses). Memory is shared instead of copied if the layout of the arrays allows it.

/// The HandleKind of a pseudo-edge's cell, a line between two point handles. A pseudo-edge is not a
/// handle; it only determines how its points rotate in a pose.
constexpr int pseudo_edge_kind = -2;

/// Convert a value of a VTK array to an integer. @return false if the value is not an integer from
/// -2^53 to 2^53.
bool to_integer(double number, Index& integer);

/// A matrix that refers to VTK's memory if the layout allows it, and otherwise owns a copy.
template <typename Matrix>
class SharedMatrix
{
public:
  using View = MatrixView<Matrix>;

  void set_shared(
    vtkSmartPointer<vtkObject> owner, const typename Matrix::Scalar* data, Index rows, Index cols)
  {
    this->owner_ = std::move(owner);
    this->data_ = data;
    this->rows_ = rows;
    this->cols_ = cols;
  }
  void set_owned(Matrix matrix)
  {
    this->owner_ = nullptr;
    this->matrix_ = std::move(matrix);
  }
  View view() const
  {
    return this->owner_ || this->is_row_range_
      ? View(Eigen::Map<const Matrix>(this->data_, this->rows_, this->cols_))
      : View(this->matrix_);
  }
  /// Return rows [begin, end) as a matrix that shares memory with this matrix. If this matrix owns
  /// a copy, this matrix must outlive the result.
  SharedMatrix rows(Index begin, Index end) const
  {
    SharedMatrix part;
    const View all = this->view();
    part.owner_ = this->owner_;
    part.data_ = all.data() + begin * all.cols();
    part.rows_ = end - begin;
    part.cols_ = all.cols();
    part.is_row_range_ = true;
    return part;
  }
  /// Report whether the matrix refers to VTK's memory.
  bool shared() const { return this->owner_ != nullptr; }

private:
  vtkSmartPointer<vtkObject> owner_;
  bool is_row_range_ = false; // true: the matrix is a range of rows of another matrix
  const typename Matrix::Scalar* data_ = nullptr;
  Index rows_ = 0;
  Index cols_ = 0;
  Matrix matrix_;
};

/// Return the points of any dataset. The memory is shared if the points are contiguous doubles.
BINDPOSEFILTERS_EXPORT SharedMatrix<Points> to_points(vtkDataSet* data);

struct SurfaceInput
{
  SharedMatrix<Points> points;
  SharedMatrix<Triangles> triangles;
  /// Cell of each triangle; empty if triangle i is cell i.
  std::vector<Index> cell_of_triangle;
  /// Number of polygons, quads and strips that were split into triangles.
  Index triangulated_cells = 0;
  Index ignored_cells = 0; ///< total number of ignored cells: vertices, lines and volume cells
};

/// Convert the 2D cells of a polydata or unstructured grid to triangles; strips and polygons are
/// split. Ids and coordinates are checked by WorkingFrame::choose(). If there is no 2D cell, return
/// invalid_input with a message that names the cell types of the dataset.
BINDPOSEFILTERS_EXPORT Status to_surface(vtkDataSet* data, SurfaceInput& surface);

struct TetInput
{
  SharedMatrix<Points> points;
  SharedMatrix<Tets> tets;
};

/// Convert tets. If a cell is not a tet, return invalid_input with a message that names the first
/// such cell.
BINDPOSEFILTERS_EXPORT Status to_tets(vtkDataSet* data, TetInput& tets);

/// Return a point or cell array as #tuples x #components doubles. The memory is shared if the array
/// is a vtkDoubleArray.
BINDPOSEFILTERS_EXPORT SharedMatrix<Weights> to_matrix(vtkDataArray* array);

BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPoints> to_vtk_points(PointsView points);
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> to_polydata(
  PointsView points, TrianglesView triangles);
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  PointsView points, TetsView tets);
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  PointsView points, TrianglesView triangles);

/// Convert the domain of weights: the tets of an unstructured grid that has a volume cell,
/// otherwise the 2D cells of a polydata or grid as triangles. Coordinates and ids are checked.
/// @param cell_of_element  the cell of each element; empty if element i is cell i
BINDPOSEFILTERS_EXPORT Status to_domain(
  vtkDataSet* data, Domain& domain, std::vector<Index>& cell_of_element);

/// Return the handles of a handle dataset in the order of their cells. The cell array HandleKind
/// contains the type of each handle. If it is missing, vertices are points, and lines with two
/// points are bones. Other missing arrays have defaults: the names p1, p2, … and b1, b2, …, and no
/// parent. Edges and faces of cages are not in the list of handles. check_handles() checks the
/// result. cells[i] is the cell of handle i.
BINDPOSEFILTERS_EXPORT Status to_handles(
  vtkPolyData* data, Handles& handles, std::vector<Index>* cells = nullptr);

/// Convert handles to a dataset with all documented cell arrays. All handles are in the rest pose
/// and in mode full.
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> to_polydata(const Handles& handles);

/// Return Mode, Transform, Stretch and Twist of the cells. If an array is missing, its values are
/// those of the rest pose and mode full. Return invalid_input, with the handle's name, for values
/// that are not finite or arrays of a wrong size.
BINDPOSEFILTERS_EXPORT Status to_pose(
  vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells, Pose& pose);

/// Return the layer of each handle from the cell array `name`; all layers are 0 if the array is
/// missing. Return invalid_input if the array has several components or if a value is not finite;
/// in the second case, the message names the handle.
BINDPOSEFILTERS_EXPORT Status to_layers(vtkPolyData* data, const Handles& handles,
  const std::vector<Index>& cells, const std::string& name, Eigen::VectorXd& layers);

/// Write a pose into the cell arrays of a handle dataset. The written arrays are new objects; all
/// other arrays of the dataset stay the same objects.
BINDPOSEFILTERS_EXPORT void set_pose(
  vtkPolyData* data, const std::vector<Index>& cells, const Pose& pose);

/// Return the objects of a handle dataset on which a bind depends: points, cells and all handle
/// arrays except those of the pose.
BINDPOSEFILTERS_EXPORT std::vector<vtkObject*> bind_objects(vtkPolyData* handles);
/// Return the objects of a mesh on which a bind depends: points, cells and the named point arrays
/// (null if absent).
BINDPOSEFILTERS_EXPORT std::vector<vtkObject*> bind_objects(
  vtkPointSet* mesh, const std::vector<std::string>& array_names);

} // namespace bindpose

#endif
