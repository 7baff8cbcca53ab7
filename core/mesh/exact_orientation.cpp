#include "core/mesh/exact_orientation.h"

namespace etalon {

namespace {

/// An exact sum of doubles as non-overlapping parts of growing magnitude; no overflow or underflow for the products of finite floats,
/// which are multiples of 2^-298 below 2^257.
class Expansion {
 public:
  void add(double x) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const double sum = x + part_[i];  // Knuth's two-sum: sum + error = x + part exactly
      const double part = sum - x;
      const double error = (x - (sum - part)) + (part_[i] - part);
      x = sum;
      if (error != 0) part_[kept++] = error;
    }
    if (x != 0) part_[kept++] = x;
    count_ = kept;
  }
  /// The largest part outweighs all others together.
  [[nodiscard]] int sign() const { return count_ == 0 ? 0 : (part_[count_ - 1] > 0 ? 1 : -1); }

 private:
  double part_[8] = {};
  int count_ = 0;
};

double product(float x, float y) { return static_cast<double>(x) * static_cast<double>(y); }

}  // namespace

int orientation(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  Expansion sum;
  sum.add(product(a.x, b.y));
  sum.add(-product(a.y, b.x));
  sum.add(product(b.x, c.y));
  sum.add(-product(b.y, c.x));
  sum.add(product(c.x, a.y));
  sum.add(-product(c.y, a.x));
  return sum.sign();
}

bool is_collinear(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 && orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orientation({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

double doubled_area(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  const double x0 = static_cast<double>(b.x) - a.x, y0 = static_cast<double>(b.y) - a.y;
  const double x1 = static_cast<double>(c.x) - a.x, y1 = static_cast<double>(c.y) - a.y;
  return x0 * y1 - y0 * x1;
}

}  // namespace etalon
