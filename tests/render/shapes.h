#ifndef bindpose_tests_render_shapes_h
#define bindpose_tests_render_shapes_h

// Datasets for pictures, all with closed forms.

#include "scene/picture.h"

#include "vtkSmartPointer.h"

class vtkImageData;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose::test
{

/// A sphere of radius 1 beside a cube of side 1.6: smooth and sharp.
vtkSmartPointer<vtkPolyData> sphere_and_cube();
/// A bent finger along x, [-2, 2], with Weights of two handles: "left" 1 - s, "right" s, where
/// s = (x + 2) / 4.
vtkSmartPointer<vtkPolyData> finger();
double right_weight(const Vec3& p);
/// 60 x 40 x 40 samples of the winding number of three spheres: two that overlap, one inside out.
vtkSmartPointer<vtkImageData> three_spheres();
/// Centres: +1, +1 (2 in the overlap), -1.
extern const Vec3 sphere_centers[3];
extern const double sphere_radius;
/// 49 x 49 x 49 samples over [-1.6, 1.6] of 1.5 - |p|: the level w is a sphere of radius 1.5 - w.
vtkSmartPointer<vtkImageData> cone_field();
/// Two circles of radius 1 around the y axis, each one line: at y = -0.5 with Multiplicity -1, at
/// y = 0.5 with 2.
vtkSmartPointer<vtkPolyData> two_circles();
/// A wavy box of 8 x 5 x 6 cells of 6 tets each, 1.6 x 1.0 x 1.2, Weights linear along x.
vtkSmartPointer<vtkUnstructuredGrid> tet_brick();
/// Points "a" full, "b" position, "c" free in a row along x, and a bone above them.
vtkSmartPointer<vtkPolyData> handle_row();

/// 400 x 300, no title, no legend.
PictureOptions small_picture();

} // namespace bindpose::test

#endif
