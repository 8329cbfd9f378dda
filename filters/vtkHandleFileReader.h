/**
 * @class   vtkHandleFileReader
 * @brief   reads handles: points and bones from a .tgf file, all kinds from .vtp and .glb files
 *
 * The output is a handle dataset: one handle a cell, one cell a column of the weights, with the
 * cell arrays HandleName, HandleKind, Parent, RegionId, Mode, Transform, Stretch and Twist.
 *
 * A .tgf file (Jacobson's Trivial Graph Format) has lines "id x y z [text]", a line "#", and edges
 * "from to [is_bone is_pseudo is_cage]". Every node that no bone uses is a point handle; its text
 * is its name, else p1, p2, … by order among the points. Bones are named b1, b2, … in file order.
 * Columns are points, then bones. A bone whose head is the tail of another has that one as parent
 * (the first in file order). Nodes of cage edges are cage vertices, along whose edges weights are
 * linear. Pseudo-edges between points are lines of HandleKind -2, which make no handle but tell how
 * points turn (vtkSkinningDeformation); all other edges are left out, and a warning counts them.
 *
 * A .vtp file is taken cell by cell (vertices are points, lines are bones unless HandleKind says
 * otherwise); missing arrays get their defaults, all others are kept.
 *
 * The joints of the skin in a .glb or .gltf file are handles as vtkGLTFSkinReader says.
 *
 * INVALID_INPUT, naming the file, for what cannot be read and for handles that cannot be used: an
 * empty or doubled name, a coordinate that is not finite, a bone of length zero, two handles at the
 * same place, a cycle of parents.
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

  /// The endings that can be read, lower case, without dots, parted by blanks.
  static const char* GetFileExtensions() { return "tgf vtp glb gltf"; }

protected:
  vtkHandleFileReader();
  ~vtkHandleFileReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkHandleFileReader(const vtkHandleFileReader&) = delete;
  void operator=(const vtkHandleFileReader&) = delete;

  char* FileName = nullptr;
};

#endif
