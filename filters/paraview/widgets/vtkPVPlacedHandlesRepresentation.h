/**
 * @class   vtkPVPlacedHandlesRepresentation
 * @brief   handles that are placed interactively, with the handles as a text
 *
 * The representation of vtkHandleSetWidget in the panel of Placed Handles. The text has the format
 * of a .tgf file. It is the property HandlesText of vtkPlacedHandles. Setting the text replaces the
 * handles. After an edit with the mouse or by a function of this class, GetHandlesText() returns
 * the new text. A text that was set is returned unchanged until the handles are edited.
 *
 * Handles are placed in the edit modes of the base class: MOVE_REST, ADD_POINTS (the default),
 * ADD_BONES and ADD_CAGE. A .tgf file stores no pose, so the mode POSE is not used.
 *
 * @sa vtkPlacedHandles vtkHandleSetWidget vtkPVHandleSetRepresentation
 */

#ifndef vtkPVPlacedHandlesRepresentation_h
#define vtkPVPlacedHandlesRepresentation_h

#include "BindposeParaViewWidgetsModule.h" // for export macro
#include "vtkHandleSetRepresentation.h"
#include "vtkNew.h" // for vtkNew
#include <string> // for std::string

class vtkDataSet;

class BINDPOSEPARAVIEWWIDGETS_EXPORT vtkPVPlacedHandlesRepresentation
  : public vtkHandleSetRepresentation
{
public:
  static vtkPVPlacedHandlesRepresentation* New();
  vtkTypeMacro(vtkPVPlacedHandlesRepresentation, vtkHandleSetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The handles as the text of a .tgf file. Default: empty, no handles. A text that cannot be read
  /// does not change the handles, and GetTextMessage() returns the reason.
  void SetHandlesText(const char* text);
  const char* GetHandlesText();
  ///@}
  /// Return one sentence with the reason why the last text cannot be read, or why the last function
  /// of this class was refused; empty if there is none.
  std::string GetTextMessage() { return this->TextMessage; }

  /// Set the shape on or in which handles are placed: a surface, or tets, whose boundary is used.
  /// Return false if the dataset has neither; then there is no shape. Null: there is no shape.
  bool SetShape(vtkDataSet* shape);

  ///@{
  /// Edit the selected handles. DeleteSelectedHandles() removes them. ConnectSelectedHandles()
  /// connects the last two of them. Between two cage vertices it adds an edge, or removes the edge
  /// if it exists. Between points and bones it adds a bone: a point becomes an end of the bone, and
  /// a bone is connected at its tail. Return false if nothing has changed; GetTextMessage() returns
  /// the reason.
  bool DeleteSelectedHandles();
  bool ConnectSelectedHandles();
  ///@}

protected:
  vtkPVPlacedHandlesRepresentation();
  ~vtkPVPlacedHandlesRepresentation() override;

private:
  vtkPVPlacedHandlesRepresentation(const vtkPVPlacedHandlesRepresentation&) = delete;
  void operator=(const vtkPVPlacedHandlesRepresentation&) = delete;

  bool ReadText();
  bool FinishEdit(const std::string& refusal, vtkIdType selected);

  vtkNew<vtkPolyData> PlacedHandles; // edited by the widget
  std::string HandlesText;
  std::string TextMessage;
  // Modification time of PlacedHandles when HandlesText and PlacedHandles last agreed. If
  // PlacedHandles has a different time, GetHandlesText() formats the text again.
  vtkMTimeType FormattedTime = 0;
};

#endif
