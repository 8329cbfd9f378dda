#ifndef document_dataset_view_h
#define document_dataset_view_h

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

/// Return a new dataset that shares only the memory of the numbers with `data`: a vtkPolyData, a
/// vtkImageData, or a vtkUnstructuredGrid of cells without faces; null for other data. No number is
/// copied. Another thread can use the view, including ranges and pipelines, while no one changes
/// the numbers. The view must be destroyed before `data`.
vtkSmartPointer<vtkDataSet> view_of(vtkDataSet* data);

#endif
