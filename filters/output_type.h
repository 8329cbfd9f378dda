#ifndef output_type_h
#define output_type_h

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

#include <string>

namespace bindpose
{

/// For RequestDataObject: makes the output of a port an empty object of the same class as `like`,
/// unless it is one already. Nothing when `like` is null.
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
