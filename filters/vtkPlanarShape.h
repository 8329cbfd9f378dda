/**
 * @class   vtkPlanarShape
 * @brief   quality triangles of what an image shows, or of what curves in a plane enclose
 *
 * What has to bend in the plane becomes a mesh: the cut-out of an image by its alpha, the whole
 * image, or a drawing of lines, however open or crossing.
 *
 * **Input 0**: one of
 * - a vtkImageData of one layer across z. Its alpha is the point array `Alpha` (one component) or
 *   the last component of scalars with 2 or 4; unsigned integers count from 0 to the largest of
 *   their type, others from 0 to 1. The shape is where alpha is at least 0.5: contour between the
 *   pixels' centres, simplified by no more than Simplify, holes kept. Without alpha, or with
 *   Rectangle on, it is the whole image. An image reaches half a spacing beyond its outer points.
 * - a vtkPolyData with lines or polygons in a plane z = const (other cells are ignored and
 * counted). They run counter-clockwise around what is inside, clockwise around holes, and are split
 * exactly where they cross; the generalized winding number decides what is inside
 * (WindingThreshold).
 *
 * **Input 1** (optional): handles (see vtkHandleFileReader); z is ignored. Points, cage vertices
 * and the ends of bones become points of the mesh, bones and cage edges rows of edges, as far as
 * they lie inside.
 *
 * **Output**: a vtkPolyData of triangles, counter-clockwise seen from +z, with the point arrays
 * `TCoords` (texture coordinates: 0 to 1 over the image, or over the curves' bounds) and
 * `OriginalPointIds` (id of the input point, or of the point of an image's outline, ascending; -1
 * for new points) and the cell array `WindingNumber` (double, at the triangles' centres).
 *
 * Report: counts.{points, segments, crossings, open_ends, vertices, triangles, kept_points,
 * outside_handles, ignored_cells, pixels, inside_pixels, contour_points, outline_points, loops},
 * area, min_angle (degrees), longest_edge, turned (1: the curves ran clockwise and were turned),
 * grid (what is nearer was merged, 0 mostly), domain ("alpha", "rectangle" or "curves"),
 * handles[].{name, vertex} (the point's id, of a bone the head's, -1 outside), seconds.{outline,
 * arrange, winding, fill}.
 *
 * Errors: invalid_input for an image without pixels, with several layers, turned or transparent
 * everywhere; for curves that are not there, not in a plane z = const, all on one line, not finite,
 * with ids out of range, or that enclose nothing; for parameters out of range. unavailable without
 * the helper program bindpose-mesher (built with the packages libcgal-dev and libtet1.5-dev).
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

  /// The handles, by a connection; null for none.
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }

  ///@{
  /// The whole image, whatever its alpha. Default: off.
  vtkSetMacro(Rectangle, bool);
  vtkGetMacro(Rectangle, bool);
  vtkBooleanMacro(Rectangle, bool);
  ///@}

  ///@{
  /// Pixels that simplifying may move an image's outline by, 0 to 1; default 0.5.
  vtkSetMacro(Simplify, double);
  vtkGetMacro(Simplify, double);
  ///@}

  ///@{
  /**
   * Inside is where the curves' winding number is at least this, above 0; default 0.5. 1.5 keeps
   * only what is enclosed twice.
   */
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  ///@{
  /**
   * Smallest angle of a triangle in degrees, 0 to 33; default 30. Where the input's own angles are
   * smaller they stay.
   */
  vtkSetMacro(MinAngle, double);
  vtkGetMacro(MinAngle, double);
  ///@}

  ///@{
  /**
   * Longest edge of a triangle, as a fraction of the shape's diagonal, 1e-4 or more; default 0.02;
   * 0: no bound.
   */
  vtkSetMacro(Edge, double);
  vtkGetMacro(Edge, double);
  ///@}

  ///@{
  /// Seconds that the helper process may take, above 0; default 120.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// MiB of address space that the helper process may take; 0 (default): no limit.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

protected:
  vtkPlanarShape();
  ~vtkPlanarShape() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

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
