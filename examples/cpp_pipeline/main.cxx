// The complete pipeline: a capsule is filled with tets, gets bounded weights for two bones, and is
// bent at the middle. The program prints the report of each stage and exits with a nonzero code if
// a stage fails.
#include <vtkBoundedBiharmonicWeights.h>
#include <vtkPoseHandles.h>
#include <vtkSkinningDeformation.h>
#include <vtkTetrahedralizeSurface.h>

#include <vtkCapsuleSource.h>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>

#include <iostream>

namespace
{
/// Two bones along the y axis, joined at the origin. Lines become bones b1 and b2.
vtkSmartPointer<vtkPolyData> two_bones()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, -1.0, 0.0);
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  vtkNew<vtkCellArray> lines;
  const vtkIdType lower[2] = { 0, 1 };
  const vtkIdType upper[2] = { 1, 2 };
  lines->InsertNextCell(2, lower);
  lines->InsertNextCell(2, upper);
  auto handles = vtkSmartPointer<vtkPolyData>::New();
  handles->SetPoints(points);
  handles->SetLines(lines);
  return handles;
}

bool print_status(const char* stage, vtkBindposeAlgorithm* filter)
{
  std::cout << stage << ": " << filter->GetStatusAsString() << " " << filter->GetStatusMessage()
            << "\n";
  return filter->GetStatus() == vtkBindposeAlgorithm::OK;
}
} // namespace

int main()
{
  vtkNew<vtkCapsuleSource> capsule;
  capsule->SetRadius(0.4);
  capsule->SetCylinderLength(2.0);
  capsule->SetThetaResolution(16);
  capsule->SetPhiResolution(12);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(capsule->GetOutputPort());
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());

  const auto handles = two_bones();
  vtkNew<vtkTetrahedralizeSurface> tets;
  tets->SetInputConnection(clean->GetOutputPort());
  vtkNew<vtkBoundedBiharmonicWeights> weights;
  weights->SetInputConnection(0, tets->GetOutputPort());
  weights->SetInputData(1, handles);
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(0, handles);
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputConnection(0, weights->GetOutputPort());
  skinning->SetInputConnection(1, pose->GetOutputPort());

  for (int degrees = 0; degrees <= 90; degrees += 30)
  {
    pose->SetPoseJSON("{\"handles\": {\"b2\": {\"rotate\": {\"axis\": [0, 0, 1], \"degrees\": " +
      std::to_string(degrees) + "}}}}");
    skinning->Update();
    double bounds[6];
    skinning->GetOutput()->GetBounds(bounds);
    std::cout << degrees << " degrees: x from " << bounds[0] << " to " << bounds[1] << "\n";
  }
  std::cout << "binds: " << weights->GetNumberOfBinds() << " weights, "
            << skinning->GetNumberOfBinds() << " skinning\n";
  const bool good = print_status("tets", tets) && print_status("weights", weights) &&
    print_status("pose", pose) && print_status("skinning", skinning) &&
    weights->GetNumberOfBinds() == 1;
  return good ? 0 : 1;
}
