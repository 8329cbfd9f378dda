#ifndef bindpose_tests_render_shapes_h
#define bindpose_tests_render_shapes_h

// Datasets for pictures. All of them are given by closed-form expressions.

#include "pictures/picture.h"

#include "vtkSmartPointer.h"

class vtkImageData;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose::test
{

/// Return a smooth and a sharp shape: a sphere of radius 1 and, next to it, a cube of side 1.6.
vtkSmartPointer<vtkPolyData> sphere_and_cube();
/// Return a bent finger along x in [-2, 2], with the array Weights for two handles. For s = (x + 2)
/// / 4, the weight of "left" is 1 - s, and the weight of "right" is s.
vtkSmartPointer<vtkPolyData> finger();
double right_weight(const Vec3& p);
/// Return 100 x 56 x 40 samples of the winding number of three spheres. Two spheres overlap, and
/// the third sphere is inside out.
vtkSmartPointer<vtkImageData> three_spheres();
/// Centers of the spheres with winding numbers +1, +1 (2 in the overlap) and -1.
extern const Vec3 sphere_centers[3];
extern const double sphere_radius;
/// Return 49 x 49 x 49 samples of the field 1.5 - |p| over [-1.6, 1.6]. The isosurface of level w
/// is a sphere of radius 1.5 - w.
vtkSmartPointer<vtkImageData> cone_field();
/// Return two circles of radius 1 around the y axis, one polyline per circle. The array
/// Multiplicity is -1 at y = -0.5, and 2 at y = 0.5.
vtkSmartPointer<vtkPolyData> two_circles();
/// Return a wavy box of 1.6 x 1.0 x 1.2 with 8 x 5 x 6 cells of 6 tets each. The array Weights is
/// linear along x.
vtkSmartPointer<vtkUnstructuredGrid> tet_brick();
/// Return three point handles in a row along x and a bone above them. The points are "a" (mode
/// full), "b" (mode position) and "c" (mode free).
vtkSmartPointer<vtkPolyData> handle_row();

/// Return options for a picture of 400 x 300 pixels without title and legend.
PictureOptions small_picture();

} // namespace bindpose::test

#endif
