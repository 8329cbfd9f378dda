#ifndef document_dataset_view_h
#define document_dataset_view_h

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

/// Return a view of `data`: a new dataset that shares the memory of the values. `data` is a
/// vtkPolyData, a vtkImageData, or a vtkUnstructuredGrid of cells without faces; the result is null
/// for other data. The view has its own cached ranges and pipeline information. Another thread can
/// therefore use the view as long as nothing changes the values. The view must be destroyed before
/// `data`.
vtkSmartPointer<vtkDataSet> view_of(vtkDataSet* data);

#endif
