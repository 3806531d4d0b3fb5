// Velocity of one straight vortex segment (Biot-Savart; Katz & Plotkin 2001, section 10.4.5).
#pragma once

#include "vec3.hpp"

namespace flaprig {

// velocity at p of a segment a -> b of unit circulation; the core smooths as h^2/(h^2 + core^2),
// h the distance to the segment's line
inline Vec3 segment_velocity(Vec3 a, Vec3 b, Vec3 p, double core) {
  constexpr double kQuarterPi = 0.07957747154594767;  // 1/(4 pi)
  const Vec3 r1 = p - a, r2 = p - b, r0 = b - a;
  const Vec3 n = cross(r1, r2);
  const double l1 = norm(r1), l2 = norm(r2);
  const double area2 = dot(n, n) + core * core * dot(r0, r0);
  const double lengths = l1 * l2;
  // at an end of the segment or on its line there is no direction: no velocity either
  if (!(area2 > 1e-24 * lengths * lengths) || lengths == 0) return {};
  const double along = (l1 + l2) * (1 - dot(r1, r2) / lengths);
  return (kQuarterPi * along / area2) * n;
}

}  // namespace flaprig
