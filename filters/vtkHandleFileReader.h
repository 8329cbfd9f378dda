/**
 * @class   vtkHandleFileReader
 * @brief   reads handles: points and bones from .tgf files, all types from .vtp and .glb files
 *
 * The output is a handle dataset: one handle per cell, in the order of the columns of the weights,
 * with the cell arrays HandleName, HandleKind, Parent, RegionId, Mode, Transform, Stretch and
 * Twist.
 *
 * A .tgf file (Jacobson's Trivial Graph Format) has lines "id x y z [text]", a separator line "#",
 * and lines of edges "from to [is_bone is_pseudo is_cage]" with two node ids. Every node that no
 * bone uses is a point handle. The text of the node is the name of the handle; without text the
 * name is p1, p2, … by the order of the points. Bones are named b1, b2, … in file order. The
 * columns of the weights are points, then bones. If the head of a bone is the tail of another bone,
 * that bone (the first in file order) is its parent. Nodes of cage edges are cage vertices, and
 * weights are linear along the cage edges. Pseudo-edges between points are lines of HandleKind -2.
 * They are not handles but determine how points rotate (vtkSkinningDeformation). All other edges
 * are left out, and a warning counts them.
 *
 * A .vtp file is read cell by cell: vertices are points and lines are bones unless HandleKind
 * states another type. Missing arrays get their defaults; all other arrays are kept.
 *
 * The joints of the skin in a .glb or .gltf file become handles as in vtkGLTFSkinReader.
 *
 * The status is INVALID_INPUT, with the file name, for a file that cannot be read and for invalid
 * handles: an empty or duplicate name, a coordinate that is not finite, a bone of length zero, two
 * handles at the same position, a cycle of parents.
 *
 * Report: `counts.handles`, `handles[].name`, `handles[].kind`.
 */

#ifndef vtkHandleFileReader_h
#define vtkHandleFileReader_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkHandleFileReader : public vtkBindposeAlgorithm
{
public:
  static vtkHandleFileReader* New();
  vtkTypeMacro(vtkHandleFileReader, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Path of the file. Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// File name extensions that can be read, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "tgf vtp glb gltf"; }

protected:
  vtkHandleFileReader();
  ~vtkHandleFileReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkHandleFileReader(const vtkHandleFileReader&) = delete;
  void operator=(const vtkHandleFileReader&) = delete;

  char* FileName = nullptr;
};

#endif
