#ifndef document_dataset_view_h
#define document_dataset_view_h

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

/// A dataset of its own that shares nothing but the numbers of `data`, a vtkPolyData or a
/// vtkUnstructuredGrid of cells without faces: no number is copied, and another thread may use the
/// view, ranges and pipelines included, as long as nobody changes the numbers. To be dropped before
/// `data`; null for other data.
vtkSmartPointer<vtkDataSet> view_of(vtkDataSet* data);

#endif
