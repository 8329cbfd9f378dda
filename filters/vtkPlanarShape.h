/**
 * @class   vtkPlanarShape
 * @brief   fills the shape of an image, or the region that planar curves enclose, with well-shaped
 *   triangles
 *
 * The filter meshes shapes for deformation in the plane. A shape is the part of an image that its
 * alpha selects, a whole image, or a line drawing. A line drawing may be open and may cross itself.
 *
 * **Input 0**: one of
 * - a vtkImageData with one layer along z. Its alpha is the point array `Alpha` (one component) or
 *   the last component of scalars with 2 or 4 components. Full alpha is the maximum of an unsigned
 *   integer type, and 1 for other types. The shape is the region where alpha is at least 0.5: a
 *   contour between the pixels' centers, simplified by no more than Simplify, with holes. Without
 *   alpha, or with Rectangle on, the shape is the whole image. An image extends half a spacing
 *   beyond its outer points.
 * - a vtkPolyData with lines or polygons in a plane z = const (other cells are ignored and
 *   counted). The curves run counter-clockwise around the inside and clockwise around holes. The
 *   filter splits them exactly where they cross. The generalized winding number determines the
 *   inside (WindingThreshold).
 *
 * **Input 1** (optional): handles (see vtkHandleFileReader); z is ignored. Inside the shape,
 * points, cage vertices and the ends of bones become points of the mesh, and bones and cage edges
 * become chains of edges.
 *
 * **Output**: a vtkPolyData of triangles, counter-clockwise seen from +z, with the point arrays
 * `TCoords` (texture coordinates: 0 to 1 over the image, or over the curves' bounds) and
 * `OriginalPointIds` (id of the input point, or of the point of an image's outline, ascending; -1
 * for new points) and the cell array `WindingNumber` (double, at the triangles' centers).
 *
 * Report: counts.{points, segments, crossings, open_ends, vertices, triangles, kept_points,
 * outside_handles, ignored_cells, pixels, inside_pixels, contour_points, outline_points, loops},
 * area, min_angle (degrees), longest_edge, turned (1: the curves ran clockwise and were reversed),
 * grid (distance below which points were merged; usually 0, i.e. no merging), domain ("alpha",
 * "rectangle" or "curves"), handles[].{name, vertex} (the id of the handle's point, for a bone of
 * its head; -1 outside), seconds.{outline, arrange, winding, fill}.
 *
 * Errors: invalid_input for an image without pixels, with several layers, with a rotated direction,
 * or transparent everywhere; for curves that are missing, not in a plane z = const, all on one
 * line, not finite, with ids out of range, or that enclose nothing; and for parameters out of
 * range. The status is unavailable without the helper program bindpose-mesher (built with the
 * packages libcgal-dev and libtet1.5-dev).
 *
 * @par Thanks:
 * Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding
 * Numbers", ACM Transactions on Graphics 32(4), 2013. Shewchuk, "Delaunay Refinement Algorithms for
 * Triangular Mesh Generation", Computational Geometry 22, 2002.
 *
 * @sa vtkTetrahedralizeSurface vtkWindingNumberField vtkHandleFileReader
 */

#ifndef vtkPlanarShape_h
#define vtkPlanarShape_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkPlanarShape : public vtkBindposeAlgorithm
{
public:
  static vtkPlanarShape* New();
  vtkTypeMacro(vtkPlanarShape, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Set the connection of the handles; null for no handles.
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }

  ///@{
  /// Mesh the whole image and ignore its alpha. Default: off.
  vtkSetMacro(Rectangle, bool);
  vtkGetMacro(Rectangle, bool);
  vtkBooleanMacro(Rectangle, bool);
  ///@}

  ///@{
  /// Largest distance in pixels by which simplification may move an image's outline, 0 to 1;
  /// default 0.5.
  vtkSetMacro(Simplify, double);
  vtkGetMacro(Simplify, double);
  ///@}

  ///@{
  /**
   * Winding number of the curves at or above which a point is inside, above 0; default 0.5. The
   * value 1.5 keeps only regions that are enclosed twice.
   */
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  ///@{
  /**
   * Smallest angle of a triangle in degrees, 0 to 33; default 30. Smaller angles of the input
   * itself remain.
   */
  vtkSetMacro(MinAngle, double);
  vtkGetMacro(MinAngle, double);
  ///@}

  ///@{
  /**
   * Longest edge of a triangle, as a fraction of the shape's diagonal, 1e-4 or more; default 0.02;
   * 0: no limit.
   */
  vtkSetMacro(Edge, double);
  vtkGetMacro(Edge, double);
  ///@}

  ///@{
  /// Time limit of the helper process in seconds, above 0; default 120.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// Limit of the helper process's address space in MiB; 0 (default): no limit.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

protected:
  vtkPlanarShape();
  ~vtkPlanarShape() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkPlanarShape(const vtkPlanarShape&) = delete;
  void operator=(const vtkPlanarShape&) = delete;

  bool Rectangle = false;
  double Simplify = 0.5;
  double WindingThreshold = 0.5;
  double MinAngle = 30.0;
  double Edge = 0.02;
  double TimeLimit = 120.0;
  int MemoryLimit = 0;
};

#endif
