#ifndef output_type_h
#define output_type_h

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// For RequestDataObject: makes the first output an empty object of the same class as `like`,
/// unless it is one already. Nothing when `like` is null.
inline void match_output_type(vtkDataObject* like, vtkInformationVector* output)
{
  vtkInformation* info = output->GetInformationObject(0);
  vtkDataObject* current = vtkDataObject::GetData(info);
  if (like && (!current || std::string(current->GetClassName()) != like->GetClassName()))
  {
    vtkSmartPointer<vtkDataObject> fresh;
    fresh.TakeReference(like->NewInstance());
    info->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
}

} // namespace bindpose

#endif
