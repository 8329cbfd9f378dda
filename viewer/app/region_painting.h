#ifndef region_painting_h
#define region_painting_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

#include <string>

class Document;
class Viewport;
class vtkDataArray;
class vtkRegionBrushRepresentation;

/// Regions painted on the surface: the brush of the viewport, the colours of the regions, and a
/// step of the document for every stroke. The first stroke of a region makes its handle, with its
/// pivot in the middle of what was painted; erasing the last of it takes the handle away.
class RegionPainting : public QObject
{
  Q_OBJECT

public:
  RegionPainting(Document* document, Viewport* viewport);

  void set_active(bool active);
  bool is_painting() const;
  /// Takes the stroke that is going on back.
  void cancel();
  /// The document has others: surface, handles or labels.
  void document_changed();
  /// Strokes go on with this region; any other handle, or -1: they begin a new one.
  void choose(int handle);
  bool has_region() const { return !this->region_.empty(); }
  QString region() const { return QString::fromStdString(this->region_); }
  /// Of the brush, over the surface's diagonal.
  double radius() const;
  void set_radius(double part);

Q_SIGNALS:
  /// The brush or the region is another, or a stroke begins or ends.
  void changed();
  /// A stroke was kept; it is of this region, or of none.
  void painted(const QString& region);
  void refused(const QString& sentence);

private:
  vtkRegionBrushRepresentation* brush() const;
  vtkDataArray* labels() const;
  void stroke_began();
  void stroke_goes_on();
  void stroke_ended();
  bool keep_stroke(std::string& region);
  void show_labels();
  void radius_changed();

  Document* document_;
  Viewport* viewport_;
  bool active_ = false;
  vtkSmartPointer<vtkPolyData> painted_; ///< the document's surface, with labels of its own
  std::string region_; ///< name of the region's handle
};

#endif
