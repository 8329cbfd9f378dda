#include "timed_mapper.h"

#include "vtkObjectFactory.h"

#include <chrono>

vtkStandardNewMacro(TimedMapper);

void TimedMapper::BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  const auto start = std::chrono::steady_clock::now();
  this->Superclass::BuildBufferObjects(renderer, actor);
  this->microseconds_ =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}
