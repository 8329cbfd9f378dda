#ifndef bindpose_inside_enclosed_region_h
#define bindpose_inside_enclosed_region_h

#include "helper/mesher_format.h"
#include "surface/surface_repair.h"
#include "winding/winding_number.h"

namespace bindpose
{

/// Where a surface winds often enough around a point: {winding number >= threshold} in the
/// surface's box. Says which tets are in it and whether a volume fits.
class EnclosedRegion
{
public:
  /// Builds the winding number and estimates the volume. A surface that winds the other way around
  /// more than it encloses is turned inside out (closed components are right by now, open ones may
  /// not be). #samples in the box: until 20,000 are inside, fewer when that would take seconds.
  Status build(RepairedSurface& surface, double threshold, bool& turned, ExecutionContext& context);

  const WindingNumber& winding() const { return this->winding_; }
  /// Exact for a clean surface of one component, sampled otherwise.
  double volume() const { return this->volume_; }
  /// Standard error of volume() from sampling, relative; 0 where it is exact.
  double volume_error() const { return this->volume_error_; }
  /// Volume where the number is within a quarter of the threshold, as a multiple of volume(): near
  /// 0 where the surface itself bounds what it encloses, over 1 where its openings do.
  double doubtful_share() const { return this->doubtful_share_; }
  /// Within 10 %, and what sampling may be wrong by.
  bool fits(double volume) const;
  /// |log(volume / volume())|: 0 for equal, the same for half and double, infinity for none.
  double misfit(double volume) const;
  /// A closed surface's tets are labelled exactly: when none is inside, no finer tet will be.
  bool labels_are_exact() const { return this->closed_; }
  /// The error of a surface that winds nowhere often enough, with the largest number met so far.
  Status encloses_nothing() const;
  /// The same of a method whose tets of some size found nothing inside; unavailable where the
  /// surface does enclose something, too thin for them.
  Status no_tets() const;

  /// The error of thousands of loose triangles that enclose only specks, thinner than a tenth of
  /// their size, where some come near each other: tets of them are no shape, and take minutes.
  Status only_specks(const RepairedSurface& surface) const;

  /// Winding number of each tet: of its region's largest tet when the surface is closed, else at
  /// its centre or, for large tets near the threshold, the mean of four points; 0 for a tet whose
  /// centre is outside of the surface's box.
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
