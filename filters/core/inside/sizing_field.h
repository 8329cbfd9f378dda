#ifndef bindpose_inside_sizing_field_h
#define bindpose_inside_sizing_field_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// How long edges may be where: the smallest of (a site's length + growth * distance to the site)
/// over all sites, and never more than `largest`. Between two points it differs by at most growth
/// times their distance. Build O(n log n), a value some microseconds at 100k sites.
class SizingField
{
public:
  /// #S x 3 sites, #S lengths > 0, growth >= 0 (0.3: a neighbour is at most a third larger).
  SizingField(const Points& sites, const Eigen::VectorXd& lengths, double growth, double largest);

  /// Thread-safe.
  double at(const Vec3& p) const;
  double largest() const { return this->largest_; }
  double growth() const { return this->growth_; }
  void set_growth(double growth) { this->growth_ = growth; }
  double scale() const { return this->scale_; }
  /// Multiplies the sites' lengths by `scale`; initially 1.
  void set_scale(double scale) { this->scale_ = scale; }

private:
  struct Node
  {
    Box box;
    double smallest = 0.0; ///< length of a site in it
    Index begin = 0, end = 0; ///< sites, in order_
    Index right = -1; ///< second child, the first is the next node; -1: a leaf
  };
  void build(Index begin, Index end);
  double bound(const Node& node, const Vec3& p) const;

  Points sites_;
  Eigen::VectorXd lengths_;
  double growth_, largest_;
  double scale_ = 1.0; ///< of the lengths
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

} // namespace bindpose

#endif
