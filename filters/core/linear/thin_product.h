#ifndef bindpose_linear_thin_product_h
#define bindpose_linear_thin_product_h

// Products A X and A^T X of a large dense matrix A and a matrix X with three columns.

#include "base/mesh_types.h"

namespace bindpose
{

/// A matrix with one column per coordinate.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Return A X (thin_product) or A^T X (transposed_thin_product). A general matrix product of a
/// library would spend more time on rearranging A than on the product. These functions read each
/// entry of A once. The bits are the same on every processor.
Coordinates thin_product(const Eigen::MatrixXd& a, const Coordinates& x);
Coordinates transposed_thin_product(const Eigen::MatrixXd& a, const Coordinates& x);

} // namespace bindpose

#endif
