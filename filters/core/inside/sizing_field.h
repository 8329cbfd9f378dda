#ifndef bindpose_inside_sizing_field_h
#define bindpose_inside_sizing_field_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Target edge length as a function of position: the smallest of (length of a site + growth *
/// distance to the site) over all sites, and at most `largest`. The edge lengths at two points
/// differ by at most growth times the distance of the points. Cost: O(n log n) to build, some
/// microseconds per value at 100k sites.
class SizingField
{
public:
  /// Build the field from #S x 3 sites and #S lengths > 0. growth must be >= 0. (With 0.3,
  /// neighboring edges differ by at most a third.)
  SizingField(const Points& sites, const Eigen::VectorXd& lengths, double growth, double largest);

  /// Return the edge length at p. Thread-safe.
  double at(const Vec3& p) const;
  double largest() const { return this->largest_; }
  double growth() const { return this->growth_; }
  void set_growth(double growth) { this->growth_ = growth; }
  double scale() const { return this->scale_; }
  /// Set the factor by which the lengths of the sites are multiplied. The initial factor is 1.
  void set_scale(double scale) { this->scale_ = scale; }

private:
  struct Node
  {
    Box box;
    double smallest = 0.0; ///< smallest length of the node's sites
    Index begin = 0, end = 0; ///< range of the node's sites in order_
    /// Index of the second child, -1 for a leaf. The first child is the next node.
    Index right = -1;
  };
  void build(Index begin, Index end);
  double bound(const Node& node, const Vec3& p) const;

  Points sites_;
  Eigen::VectorXd lengths_;
  double growth_, largest_;
  double scale_ = 1.0; ///< factor of the sites' lengths, see set_scale()
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

} // namespace bindpose

#endif
