#ifndef bindpose_geometry_exact_h
#define bindpose_geometry_exact_h

// Exact signs in the plane and double-double arithmetic (about 106 bits), for cases in which the
// rounding of doubles would decide on which side a point is. All functions use plain double
// arithmetic (no fused operations, no long double), so every machine computes the same bits.

#include <array>
#include <cmath>

namespace bindpose
{

/// Compute a + b = high + low, exactly.
inline void two_sum(double a, double b, double& high, double& low)
{
  high = a + b;
  const double b_virtual = high - a;
  low = (a - (high - b_virtual)) + (b - b_virtual);
}

/// Compute a * b = high + low, exact except for underflow (Dekker's splitting, without fused
/// multiply-add).
inline void two_product(double a, double b, double& high, double& low)
{
  constexpr double splitter = 134217729.0; // 2^27 + 1 splits a double into two halves
  const double ta = splitter * a;
  const double tb = splitter * b;
  const double a_high = ta - (ta - a);
  const double b_high = tb - (tb - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  high = a * b;
  low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

/// A number of about 106 bits, the unevaluated sum of two doubles.
struct DoubleDouble
{
  double high = 0.0;
  double low = 0.0;

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}
  DoubleDouble(double h, double l) { two_sum(h, l, this->high, this->low); }
  double value() const { return this->high + this->low; }
};

inline DoubleDouble operator-(const DoubleDouble& a)
{
  return { -a.high, -a.low };
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b)
{
  double high, low, high_of_lows, low_of_lows;
  two_sum(a.high, b.high, high, low);
  two_sum(a.low, b.low, high_of_lows, low_of_lows);
  const DoubleDouble sum(high, low + high_of_lows);
  return { sum.high, sum.low + low_of_lows };
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b)
{
  return a + (-b);
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b)
{
  double high, low;
  two_product(a.high, b.high, high, low);
  return { high, low + (a.high * b.low + a.low * b.high) };
}

/// Return the square root of a number that is not negative.
inline DoubleDouble sqrt(const DoubleDouble& a)
{
  if (a.high <= 0.0)
  {
    return {};
  }
  // One Newton step doubles the number of correct digits.
  const double root = std::sqrt(a.high);
  const DoubleDouble rest = a - DoubleDouble(root) * DoubleDouble(root);
  return { root, rest.value() / (2.0 * root) };
}

/// Computes the sign of a sum of products, exact except for underflow. The sum is an expansion of
/// doubles that do not overlap (Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997).
template <int MaximumProducts>
class ExactSum
{
public:
  void add_product(double a, double b)
  {
    double high, low;
    two_product(a, b, high, low);
    this->add(low);
    this->add(high);
  }
  int sign() const
  {
    const double top = this->count_ > 0 ? this->parts_[this->count_ - 1] : 0.0;
    return (top > 0.0) - (top < 0.0);
  }

private:
  void add(double value)
  {
    if (value == 0.0)
    {
      return;
    }
    int new_count = 0;
    double carry = value;
    for (int i = 0; i < this->count_; ++i)
    {
      double low;
      two_sum(carry, this->parts_[i], carry, low);
      if (low != 0.0)
      {
        this->parts_[new_count++] = low;
      }
    }
    if (carry != 0.0)
    {
      this->parts_[new_count++] = carry;
    }
    this->count_ = new_count;
  }

  std::array<double, 2 * MaximumProducts> parts_{};
  int count_ = 0;
};

/// Return +1 if the points a, b, c are in counter-clockwise order, -1 if they are in clockwise
/// order, and 0 if they are collinear. The result is exact.
inline int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy)
{
  const double left = (ax - cx) * (by - cy);
  const double right = (ay - cy) * (bx - cx);
  const double determinant = left - right;
  // Error bound of the determinant, relative to |left| + |right|: (3 + 16 e) e, with e = 2^-53.
  constexpr double bound = 3.3306690738754716e-16;
  if (std::abs(determinant) > bound * (std::abs(left) + std::abs(right)))
  {
    return determinant > 0.0 ? 1 : -1;
  }
  ExactSum<6> sum;
  sum.add_product(ax, by);
  sum.add_product(-ax, cy);
  sum.add_product(-cx, by);
  sum.add_product(-ay, bx);
  sum.add_product(ay, cx);
  sum.add_product(cy, bx);
  return sum.sign();
}

} // namespace bindpose

#endif
