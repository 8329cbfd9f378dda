/**
 * @class   vtkPlacedHandles
 * @brief   handles that are given as text: points, bones and cages that a user places
 *
 * A source of a handle dataset (see filters/README.md). HandlesText describes the handles in the
 * format of .tgf files, which vtkHandleFileReader documents:
 * <pre>
 *   1 0 0 0 hip
 *   2 0 1 0
 *   3 0 2 0
 *   #
 *   2 3 1 0 0
 * </pre>
 * A program in which users place handles sets the text after every change. The program can store
 * the text in a state file, and restore an earlier text for undo. bindpose::to_tgf() (C++) returns
 * the text of a handle dataset.
 *
 * An empty text has no handles. The output is then empty.
 *
 * The status is INVALID_INPUT for a text that cannot be parsed and for invalid handles (see
 * vtkHandleFileReader). The message begins with "the text of the handles: " and names the line.
 *
 * Report: `counts.handles`.
 *
 * @sa vtkHandleFileReader vtkFarthestPointHandles vtkAutomaticHandles
 */

#ifndef vtkPlacedHandles_h
#define vtkPlacedHandles_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"
#include <string> // for std::string

class BINDPOSEFILTERS_EXPORT vtkPlacedHandles : public vtkBindposeAlgorithm
{
public:
  static vtkPlacedHandles* New();
  vtkTypeMacro(vtkPlacedHandles, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The handles as text in the format of .tgf files. Default: empty.
  void SetHandlesText(const std::string& text);
  std::string GetHandlesText() { return this->HandlesText; }
  ///@}

protected:
  vtkPlacedHandles();
  ~vtkPlacedHandles() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkPlacedHandles(const vtkPlacedHandles&) = delete;
  void operator=(const vtkPlacedHandles&) = delete;

  std::string HandlesText;
};

#endif
