#ifndef pqHandlesPropertyWidget_h
#define pqHandlesPropertyWidget_h

#include "pqInteractivePropertyWidget.h"
#include "pqProxy.h"

#include "vtkSmartPointer.h"

#include <string>

class QBoxLayout;
class QCheckBox;
class QLabel;
class QPlainTextEdit;
class QToolButton;
class QVBoxLayout;
class pqPipelineSource;
class vtkDataObject;
class vtkHandleSetRepresentation;
class vtkHandleSetWidget;
class vtkObject;
class vtkSMProperty;

/// Base class of the panels with a handle widget in the render view. A panel edits one text
/// property, either with the widget or in a text field.
///
/// An edit with the mouse is applied without the Apply button when it ends. If
/// applies_during_drag() is true, it is also applied during the drag. Each edit is one undo step,
/// and a Python trace records the property once. If the proxy was never applied, edits wait for
/// the Apply button, like changes of other properties.
class pqHandlesPropertyWidget : public pqInteractivePropertyWidget
{
  Q_OBJECT
  typedef pqInteractivePropertyWidget Superclass;

public:
  /// @param representation  name of the widget's proxy in the group "representations"
  /// @param function  function of the text property in the property group
  pqHandlesPropertyWidget(const char* representation, const char* function, vtkSMProxy* smproxy,
    vtkSMPropertyGroup* smgroup, QWidget* parent = nullptr);
  ~pqHandlesPropertyWidget() override;

protected Q_SLOTS:
  void placeWidget() override {}
  /// Update buttons and labels to the state of the widget.
  virtual void show_state();

protected:
  // Overridden because the superclass does not show the handles again after the panel was hidden
  // twice.
  void hideEvent(QHideEvent* event) override;
  void showEvent(QShowEvent* event) override;
  vtkHandleSetWidget* handle_widget() const;
  /// Return the representation on the client, which draws and edits the handles.
  vtkHandleSetRepresentation* handles() const;
  /// Return the pipeline source of the proxy; null if the proxy is not registered.
  pqPipelineSource* source() const;
  vtkSMProperty* text_property() const { return this->property_; }
  /// Report whether the proxy has been applied at least once. If not, only the Apply button applies
  /// edits.
  bool is_applied() const;

  QVBoxLayout* column() const { return this->column_; }
  QToolButton* add_button(QBoxLayout* row, const QString& text, const QString& tip);
  /// Append the message and the text field. Derived classes call this function after all other
  /// widgets have been added.
  void add_message_and_text(const QString& tip);
  /// Return the names of the selected handles for a label: "b3", or "4 handles".
  QString selection_text() const;

  /// Apply an edit that was made by a button. `text` is the new value of the property.
  void apply_edit(const QString& step, const std::string& text);
  /// Set the text property while the undo set of an edit is open. Derived classes set further
  /// properties, which become part of the same undo step.
  virtual void set_properties(const std::string& text);
  /// Update the data of all views. Draw the views, except the view of the widget.
  void update_views();
  /// Give the keyboard focus to the view, whose keys control the widget.
  void focus_view();
  void show_warning(const QString& sentence);

  /// Return the data of an output port on the client; null if there is none. The data may be the
  /// output of an algorithm, which changes with the next update.
  static vtkSmartPointer<vtkDataObject> fetch(vtkSMProxy* producer, int port);

  virtual bool applies_during_drag() const = 0;
  /// Return the text of the drawn handles.
  virtual std::string drawn_text() const = 0;
  /// Return one sentence with the reason why the text cannot be used; empty if there is none.
  virtual QString message() const = 0;
  /// Return the name of the undo step of the last drag.
  virtual QString step_name() const = 0;

private Q_SLOTS:
  void continue_drag();
  void finish_drag();
  void warn(vtkObject* caller, unsigned long event, void* sentence);

private:
  Q_DISABLE_COPY(pqHandlesPropertyWidget)

  void begin_drag();
  void apply_silently(const std::string& text);
  void commit(const QString& step, const std::string& text);

  vtkSMProperty* property_;
  QVBoxLayout* column_;
  QCheckBox* shown_;
  bool shows_handles_ = true; // whether the user wants the handles to be shown
  QLabel* message_ = nullptr;
  QToolButton* text_button_ = nullptr;
  QPlainTextEdit* text_ = nullptr;
  QString warning_; ///< message about the last edit; if not empty, shown instead of message()
  std::string start_text_; ///< applied value of the property when the drag began
  std::string start_unchecked_text_; ///< value in the panel when the drag began
  pqProxy::ModifiedState start_state_ = pqProxy::UNMODIFIED;
  unsigned long start_observer_ = 0;
};

#endif
