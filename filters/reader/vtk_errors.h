#ifndef vtk_errors_h
#define vtk_errors_h

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <algorithm>
#include <string>

namespace bindpose
{

/// Collects the first error or warning of VTK objects instead of printing it.
class VtkErrors
{
public:
  VtkErrors()
  {
    this->command_->SetClientData(this);
    this->command_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        auto& first = static_cast<VtkErrors*>(self)->first_;
        if (first.empty() && text)
        {
          first = static_cast<const char*>(text);
        }
      });
  }
  void watch(vtkObject* object)
  {
    object->AddObserver(vtkCommand::ErrorEvent, this->command_);
    object->AddObserver(vtkCommand::WarningEvent, this->command_);
  }
  vtkCommand* command() { return this->command_; }
  bool any() const { return !this->first_.empty(); }

  /// Return the text after "vtkClass (0x…): " in VTK's message, in one line.
  std::string message() const
  {
    std::string text = this->first_;
    const std::size_t object = text.find("): ");
    if (object != std::string::npos)
    {
      text.erase(0, object + 3);
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(" .") + 1);
    return text;
  }

private:
  vtkNew<vtkCallbackCommand> command_;
  std::string first_;
};

} // namespace bindpose

#endif
