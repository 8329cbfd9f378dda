#ifndef bindpose_tests_filters_same_data_h
#define bindpose_tests_filters_same_data_h

// Comparison of datasets bit by bit.

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <cmath>
#include <string>
#include <utility>

namespace bindpose::test
{

/// Return the name of the first array that differs, or an empty text. Arrays of reports are
/// ignored, because they contain the number of binds.
inline std::string different_array(vtkFieldData* a, vtkFieldData* b)
{
  const auto is_report = [](vtkAbstractArray* array)
  { return array->GetName() && std::string(array->GetName()).compare(0, 7, "Report.") == 0; };
  int others = 0;
  for (int i = 0; i < b->GetNumberOfArrays(); ++i)
  {
    others += is_report(b->GetAbstractArray(i)) ? 0 : 1;
  }
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* left = a->GetAbstractArray(i);
    if (is_report(left))
    {
      continue;
    }
    others -= 1;
    const std::string name = left->GetName() ? left->GetName() : "(unnamed)";
    vtkAbstractArray* right = b->GetAbstractArray(name.c_str());
    if (!right || left->GetNumberOfTuples() != right->GetNumberOfTuples() ||
      left->GetNumberOfComponents() != right->GetNumberOfComponents() ||
      left->GetDataType() != right->GetDataType())
    {
      return name;
    }
    for (int c = 0; c < left->GetNumberOfComponents(); ++c)
    {
      const char* left_name = left->GetComponentName(c);
      const char* right_name = right->GetComponentName(c);
      if (std::string(left_name ? left_name : "") != (right_name ? right_name : ""))
      {
        return name;
      }
    }
    auto* numbers = vtkDataArray::SafeDownCast(left);
    auto* texts = vtkStringArray::SafeDownCast(left);
    for (vtkIdType t = 0; t < left->GetNumberOfTuples(); ++t)
    {
      for (int c = 0; c < left->GetNumberOfComponents(); ++c)
      {
        const double x = numbers ? numbers->GetComponent(t, c) : 0.0;
        const double y = numbers ? vtkDataArray::SafeDownCast(right)->GetComponent(t, c) : 0.0;
        const vtkIdType value = t * left->GetNumberOfComponents() + c;
        if ((x != y && !(std::isnan(x) && std::isnan(y))) ||
          (texts && texts->GetValue(value) != vtkStringArray::SafeDownCast(right)->GetValue(value)))
        {
          return name;
        }
      }
    }
  }
  return others == 0 ? "" : "(number of arrays)";
}

/// Return what differs between two datasets, or an empty text.
inline std::string difference(vtkDataObject* first, vtkDataObject* second)
{
  auto* a = vtkDataSet::SafeDownCast(first);
  auto* b = vtkDataSet::SafeDownCast(second);
  if (!a || !b || std::string(a->GetClassName()) != b->GetClassName())
  {
    return "class";
  }
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints() ||
    a->GetNumberOfCells() != b->GetNumberOfCells())
  {
    return "number of points or cells";
  }
  for (vtkIdType v = 0; v < a->GetNumberOfPoints(); ++v)
  {
    double p[3];
    double q[3];
    a->GetPoint(v, p);
    b->GetPoint(v, q);
    if (p[0] != q[0] || p[1] != q[1] || p[2] != q[2])
    {
      return "point " + std::to_string(v);
    }
  }
  vtkNew<vtkIdList> left;
  vtkNew<vtkIdList> right;
  for (vtkIdType cell = 0; cell < a->GetNumberOfCells(); ++cell)
  {
    a->GetCellPoints(cell, left);
    b->GetCellPoints(cell, right);
    bool same = a->GetCellType(cell) == b->GetCellType(cell) &&
      left->GetNumberOfIds() == right->GetNumberOfIds();
    for (vtkIdType k = 0; same && k < left->GetNumberOfIds(); ++k)
    {
      same = left->GetId(k) == right->GetId(k);
    }
    if (!same)
    {
      return "cell " + std::to_string(cell);
    }
  }
  for (const auto& [x, y] :
    { std::pair<vtkFieldData*, vtkFieldData*>(a->GetPointData(), b->GetPointData()),
      std::pair<vtkFieldData*, vtkFieldData*>(a->GetCellData(), b->GetCellData()),
      std::pair<vtkFieldData*, vtkFieldData*>(a->GetFieldData(), b->GetFieldData()) })
  {
    const std::string array = different_array(x, y);
    if (!array.empty())
    {
      return "array " + array;
    }
  }
  return "";
}

} // namespace bindpose::test

#endif
