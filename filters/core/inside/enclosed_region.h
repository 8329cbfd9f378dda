#ifndef bindpose_inside_enclosed_region_h
#define bindpose_inside_enclosed_region_h

#include "helper/mesher_format.h"
#include "surface/surface_repair.h"
#include "winding/winding_number.h"

#include <string>

namespace bindpose
{

/// The region {winding number >= threshold} in the bounding box of a surface. This class computes
/// the winding numbers by which tets are labeled inside or outside, and it checks whether a volume
/// matches that of the region.
class EnclosedRegion
{
public:
  /// Build the winding number and estimate the volume. If the surface encloses more volume with the
  /// negative orientation than with the positive one, all its triangles are flipped and `flipped`
  /// is set. (Closed components are already oriented outwards; open components may not be.) The
  /// volume is estimated from sample points in the box. Points are added until 20,000 of them are
  /// inside, or until more would take longer than about two seconds.
  Status build(
    ExecutionContext& context, RepairedSurface& surface, double threshold, bool& flipped);

  const WindingNumber& winding() const { return this->winding_; }
  /// Return the volume: exact for a clean surface of one component, sampled otherwise.
  double volume() const { return this->volume_; }
  /// Return the relative standard error of volume() from sampling, 0 if the volume is exact.
  double volume_error() const { return this->volume_error_; }
  /// Return the volume in which the winding number is within 0.25 of the threshold, as a multiple
  /// of volume(). It is near 0 if triangles form the boundary of the region, and over 1 if openings
  /// of the surface form most of the boundary.
  double near_threshold_fraction() const { return this->near_threshold_fraction_; }
  /// Report whether a volume matches volume() within 10 % plus the sampling error.
  bool fits(double volume) const;
  /// Return |log(volume / volume())|. The misfit is 0 for equal volumes, log 2 for a volume that is
  /// twice or half as large, and infinity for an empty volume.
  double misfit(double volume) const;
  /// Return a sentence that compares the volume of tets with volume(). It contains a percentage
  /// instead of the volumes, because the kernel may compute in scaled coordinates (WorkingFrame).
  std::string relative_volume(double tet_volume) const;
  /// Report whether labels of tets are exact, which is the case for a closed surface. If labels are
  /// exact and no tet is inside, smaller tets will not be inside either.
  bool labels_are_exact() const { return this->closed_; }
  /// Return the error for a surface that encloses no volume. The message contains the largest
  /// winding number sampled so far.
  Status nothing_enclosed_error() const;
  /// Return the error for a method that found no tet inside. The code is `unavailable` if the
  /// surface encloses a volume that is too thin for the tets of the method.
  Status no_tets_error() const;

  /// Return an error if the surface consists of at least 10,000 mostly disconnected triangles that
  /// enclose only specks: tiny volumes between neighboring triangles, thinner than a tenth of a
  /// triangle's size. Meshing specks takes minutes, and the tets represent no shape. Otherwise
  /// return ok.
  Status check_not_specks(const RepairedSurface& surface) const;

  /// Compute the winding number of each tet. If the surface is closed, the winding number of a
  /// region's largest tet is assigned to all tets of the region. Otherwise the winding number is
  /// evaluated at the tet's center. If the tet is large and this value is near the threshold, the
  /// mean of four points is used instead. The winding number is 0 if the center is outside the
  /// surface's bounding box.
  Status label(ExecutionContext& context, const MesherData& data, Eigen::VectorXd& w);

private:
  Status sample(ExecutionContext& context, const RepairedSurface& surface, double& negative);
  Status label_regions(ExecutionContext& context, const MesherData& data, Eigen::VectorXd& w) const;
  Status label_tets(ExecutionContext& context, const MesherData& data, Eigen::VectorXd& w) const;

  WindingNumber winding_;
  Box box_;
  double threshold_ = 0.5;
  bool closed_ = false;
  double volume_ = 0.0;
  double volume_error_ = 1.0; ///< relative standard error of volume_
  double near_threshold_fraction_ = 0.0;
  double largest_winding_ = 0.0;
};

} // namespace bindpose

#endif
