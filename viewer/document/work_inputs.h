#ifndef document_work_inputs_h
#define document_work_inputs_h

#include "base/status.h"
#include "document/work.h"

class vtkDataSet;

// What files hold, as parts of a work. With a status that is not ok the work stays as it is.

/// A surface, or tets, whose skin is taken; weights that belong to the handles are used.
/// invalid_input: neither.
bindpose::Status use_mesh(vtkDataSet* mesh, const QString& name, const Source& source, Work& work);
/// Handles with the pose that their arrays tell. Weights that are there stay in use where handles
/// are those that were bound (BoundColumns), or are used because they are theirs.
bindpose::Status use_handles(vtkPolyData* handles, const Source& source, Work& work);
/// Weights of another file for the surface; invalid_input, one sentence, when they are not as many
/// as its points and handles.
bindpose::Status use_weights(const bindpose::Weights& weights, const QString& name, Work& work);

/// SHA-256 in hex; empty when the file cannot be read.
QByteArray checksum_of(const QString& path);

#endif
