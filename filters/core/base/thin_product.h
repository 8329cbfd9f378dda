#ifndef bindpose_base_thin_product_h
#define bindpose_base_thin_product_h

#include "base/mesh.h"

namespace bindpose
{

/// A matrix with a column for each coordinate.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// A X and A^T X for three columns, where a library's product for any size spends more time on
/// rearranging A than on the product. Each number of A is read once; the same bits on any
/// processor.
Coordinates thin_product(const Eigen::MatrixXd& a, const Coordinates& x);
Coordinates transposed_thin_product(const Eigen::MatrixXd& a, const Coordinates& x);

} // namespace bindpose

#endif
