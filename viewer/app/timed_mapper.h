#ifndef timed_mapper_h
#define timed_mapper_h

#include "vtkOpenGLPolyDataMapper.h"

/// A mapper that tells how long it takes to bring moved points and their normals to the graphics
/// card.
class TimedMapper : public vtkOpenGLPolyDataMapper
{
public:
  static TimedMapper* New();
  vtkTypeMacro(TimedMapper, vtkOpenGLPolyDataMapper);
  /// Of the last time that something had changed.
  double upload_microseconds() const { return this->microseconds_; }

protected:
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;

private:
  double microseconds_ = 0.0;
};

#endif
