#ifndef output_type_h
#define output_type_h

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// Replace the data object of an output port by an empty object of the class of `like`. Keep the
/// current object if it already has this class. Do nothing if `like` is null. Call this function in
/// RequestDataObject.
inline void match_output_type(vtkDataObject* like, vtkInformationVector* output, int port = 0)
{
  vtkInformation* info = output->GetInformationObject(port);
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
