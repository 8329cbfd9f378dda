#ifndef document_work_inputs_h
#define document_work_inputs_h

#include "base/status.h"
#include "document/work.h"

class vtkDataSet;

// Put the contents of files into a work. If the status is not ok, the work is unchanged.

/// Use a surface, or tets and their boundary surface. Use its weights if they fit the handles.
/// Return invalid_input for other data.
bindpose::Status use_mesh(vtkDataSet* mesh, const QString& name, const Source& source, Work& work);
/// Use handles with the pose that is in their arrays. Weights stay in use for handles that were
/// bound (BoundColumns). Unused weights are adopted if they fit the handles.
bindpose::Status use_handles(vtkPolyData* handles, const Source& source, Work& work);
/// Use weights from another file for the surface. Return invalid_input, with one sentence, if their
/// size does not match the surface's points and the handles.
bindpose::Status use_weights(const bindpose::Weights& weights, const QString& name, Work& work);

/// Return the SHA-256 of a file in hex; empty if the file cannot be read.
QByteArray checksum_of(const QString& path);

#endif
