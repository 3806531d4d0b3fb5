#include "coefficients.hpp"

#include <algorithm>
#include <cmath>

namespace flaprig {

LiftDrag dickinson_1999(double alpha) {
  constexpr double kDegree = M_PI / 180;
  const double a = alpha / kDegree;
  return {0.225 + 1.58 * std::sin((2.13 * a - 7.20) * kDegree),
          1.92 - 1.55 * std::cos((2.04 * a - 9.82) * kDegree)};
}

LiftDrag lee_2016(double alpha, double reynolds, double rossby, double aspect_ratio) {
  const double rotation = -0.205 * std::atan(0.587 * (rossby - 3.105)) + 0.870;
  const double aspect = 32.9 - 32.0 * std::pow(aspect_ratio, -0.00361);
  const double scale = rotation * aspect;
  return {(1.966 - 3.94 * std::pow(reynolds, -0.429)) * std::sin(2 * alpha) * scale,
          (0.031 + 10.48 * std::pow(reynolds, -0.764) +
           (1.873 - 3.14 * std::pow(reynolds, -0.369)) * (1 - std::cos(2 * alpha))) *
              scale};
}

LiftDrag interpolated(double alpha, const CoefficientTable& table) {
  const auto& a = table.alpha;
  const auto above = std::upper_bound(a.begin(), a.end(), alpha);
  if (above == a.begin()) return {table.lift.front(), table.drag.front()};
  if (above == a.end()) return {table.lift.back(), table.drag.back()};
  const size_t i = above - a.begin();
  const double t = (alpha - a[i - 1]) / (a[i] - a[i - 1]);
  return {table.lift[i - 1] + t * (table.lift[i] - table.lift[i - 1]),
          table.drag[i - 1] + t * (table.drag[i] - table.drag[i - 1])};
}

}  // namespace flaprig
