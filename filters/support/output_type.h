#ifndef output_type_h
#define output_type_h

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// Make an output port's object an empty object of the class of `like`; keep the current object if
/// it has this class. Call this in RequestDataObject. Do nothing if `like` is null.
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
