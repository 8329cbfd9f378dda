#ifndef bindpose_inside_enclosed_region_h
#define bindpose_inside_enclosed_region_h

#include "helper/mesher_format.h"
#include "surface/surface_repair.h"
#include "winding/winding_number.h"

namespace bindpose
{

/// The region {winding number >= threshold} in the bounding box of a surface. It labels tets as
/// inside or outside and checks whether a volume fits the region.
class EnclosedRegion
{
public:
  /// Build the winding number and estimate the volume. If the surface encloses more volume with the
  /// negative orientation than with the positive one, it is turned inside out. (Closed components
  /// are already oriented; open ones may not be.) Sample points in the box are added until 20,000
  /// are inside, fewer if these would take seconds.
  Status build(RepairedSurface& surface, double threshold, bool& turned, ExecutionContext& context);

  const WindingNumber& winding() const { return this->winding_; }
  /// Return the volume: exact for a clean surface of one component, sampled otherwise.
  double volume() const { return this->volume_; }
  /// Return the relative standard error of volume() from sampling, 0 if the volume is exact.
  double volume_error() const { return this->volume_error_; }
  /// Return the volume in which the winding number is within 0.25 of the threshold, as a multiple
  /// of volume(). It is near 0 if the surface itself bounds the region, and over 1 if the openings
  /// of the surface do.
  double doubtful_share() const { return this->doubtful_share_; }
  /// Report whether a volume matches volume() within 10 % plus the sampling error.
  bool fits(double volume) const;
  /// Return |log(volume / volume())|: 0 for equal volumes, the same for half and double, infinity
  /// for no volume.
  double misfit(double volume) const;
  /// Report whether tets are labeled exactly, which is true for a closed surface. If no tet is
  /// inside, finer tets cannot change that.
  bool labels_are_exact() const { return this->closed_; }
  /// Return the error of a surface that encloses no volume. The message contains the largest
  /// winding number sampled so far.
  Status encloses_nothing() const;
  /// Return the error of a method whose tets of some size are all outside. The code is unavailable
  /// if the surface encloses a volume that is too thin for such tets.
  Status no_tets() const;

  /// Return the error of thousands of loose triangles that enclose only specks, between triangles
  /// near each other and thinner than a tenth of a triangle's size. Tets of such specks represent
  /// no shape and take minutes.
  Status only_specks(const RepairedSurface& surface) const;

  /// Compute the winding number of each tet. If the surface is closed, all tets of a region get the
  /// number of its largest tet. Otherwise a tet gets the number at its center, or, if it is large
  /// and near the threshold, the mean of four points. A tet whose center is outside the surface's
  /// box gets 0.
  Status label(const MesherData& data, Eigen::VectorXd& w, ExecutionContext& context);

private:
  Status sample(const RepairedSurface& surface, double& negative, ExecutionContext& context);
  Status label_regions(const MesherData& data, Eigen::VectorXd& w, ExecutionContext& context) const;
  Status label_tets(const MesherData& data, Eigen::VectorXd& w, ExecutionContext& context) const;

  WindingNumber winding_;
  Box box_;
  double threshold_ = 0.5;
  bool closed_ = false;
  double volume_ = 0.0;
  double volume_error_ = 1.0; ///< relative
  double doubtful_share_ = 0.0;
  double largest_winding_ = 0.0;
};

} // namespace bindpose

#endif
