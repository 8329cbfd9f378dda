#ifndef document_dataset_view_h
#define document_dataset_view_h

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

/// Return a new dataset that shares only the memory of the values with `data`, without copying any
/// values. `data` is a vtkPolyData, a vtkImageData, or a vtkUnstructuredGrid of cells without
/// faces; the result is null for other data. Another thread can use the view, including ranges and
/// pipelines, as long as nothing changes the values. The view must be destroyed before `data`.
vtkSmartPointer<vtkDataSet> view_of(vtkDataSet* data);

#endif
