#ifndef app_handles_region_painting_h
#define app_handles_region_painting_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

#include <string>

class Document;
class vtkDataArray;
class vtkRegionBrushRepresentation;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::handles
{

/// Painting of regions on the surface, with the brush of the viewport and one color per region.
/// Every stroke is an undo step of the document. The first stroke of a region creates its handle,
/// with its pivot at the mean of the painted vertices. Erasing the last vertex of a region removes
/// its handle.
class RegionPainting : public QObject
{
  Q_OBJECT

public:
  RegionPainting(Document* document, view::Viewport* viewport);

  void set_active(bool active);
  bool is_painting() const;
  /// Cancel the current stroke.
  void cancel();
  /// Update after a change of the document's surface, handles or labels.
  void document_changed();
  /// Let the next stroke paint the label of this handle. If the handle is not a region, or if
  /// `handle` is -1, the stroke begins a new region.
  void set_region(int handle);
  bool has_region() const { return !this->region_.empty(); }
  QString region() const { return QString::fromStdString(this->region_); }
  /// Return the radius of the brush as a fraction of the surface's diagonal.
  double radius() const;
  void set_radius(double fraction);

Q_SIGNALS:
  /// Emitted when the brush or the region has changed, or a stroke has begun or ended.
  void changed();
  /// Emitted when a stroke was stored. `region` is the name of the painted region or, after
  /// erasing, the name of the selected region; empty: no region is selected.
  void region_painted(const QString& region);
  void edit_refused(const QString& message);

private:
  vtkRegionBrushRepresentation* brush() const;
  vtkDataArray* labels() const;
  void stroke_began();
  void stroke_continued();
  void stroke_ended();
  bool commit_stroke(std::string& region);
  void show_labels();
  void radius_changed();

  Document* document_;
  view::Viewport* viewport_;
  bool active_ = false;
  vtkSmartPointer<vtkPolyData>
    painted_surface_; ///< shallow copy of the surface, with a separate array RegionId
  std::string region_; ///< name of the region's handle
};

} // namespace app::handles

#endif
