#ifndef document_work_inputs_h
#define document_work_inputs_h

#include "base/status.h"
#include "document/work.h"

class vtkDataArray;
class vtkDataSet;
class vtkPolyData;

// Functions that put the contents of files into a work. If the status is not ok, the work is
// unchanged.

/// Use a surface, or tets and their boundary surface. If the mesh has weights that fit the handles,
/// use them too. Return invalid_input for other data.
bindpose::Status use_mesh(vtkDataSet* mesh, const QString& name, const Source& source, Work& work);
/// Use new handles with the pose that is in their arrays. Bound weights are kept if at least one
/// new handle gets a column (see BoundColumns). Otherwise the weights of the mesh are used if they
/// fit the new handles.
bindpose::Status use_handles(vtkPolyData* handles, const Source& source, Work& work);
/// Use weights from a separate file for the surface. Return invalid_input, with one sentence, if
/// their size does not match the surface's points and the handles.
bindpose::Status use_weights(const bindpose::Weights& weights, const QString& name, Work& work);

/// Return the array of weights. Return null if the surface is null or has no weights.
vtkDataArray* weights_of(vtkPolyData* surface);

/// Return the SHA-256 of a file in hex; empty if the file cannot be read.
QByteArray checksum_of(const QString& path);

#endif
