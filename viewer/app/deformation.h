#ifndef deformation_h
#define deformation_h

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkBindposeAlgorithm;
class vtkReducedARAP;
class vtkSkinningDeformation;

/// The pose-time half of the window: a surface with weights, handles, and the filter that the user
/// chose between them. Moving a handle runs that filter only.
class Deformation
{
public:
  enum Method
  {
    linear_blend = 0,
    dual_quaternion = 1,
    reduced_arap = 2
  };

  Deformation();
  ~Deformation();

  /// Surface with the point array Weights, and the handles of its columns.
  void set_input(vtkPolyData* surface, vtkPolyData* handles);
  void clear();
  bool has_input() const { return this->surface_ != nullptr; }
  void set_method(Method method) { this->method_ = method; }
  Method method() const { return this->method_; }

  /// The posed surface, brought up to date; null without input or when the filter failed: error()
  /// then says why.
  vtkPolyData* posed();
  const std::string& error() const { return this->error_; }

  /// Of the last update that did work: milliseconds in all, and microseconds an iteration (0 for
  /// skinning, which does not iterate).
  double milliseconds() const { return this->milliseconds_; }
  double microseconds_per_iteration() const { return this->microseconds_; }

private:
  vtkBindposeAlgorithm* filter() const;

  Method method_ = linear_blend;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkNew<vtkSkinningDeformation> skinning_;
  vtkNew<vtkReducedARAP> arap_;
  std::string error_;
  double milliseconds_ = 0.0;
  double microseconds_ = 0.0;
};

#endif
