#include "quasi_steady.hpp"

#include <cmath>

namespace flaprig {

QuasiSteady::QuasiSteady(const Planform& planform, const QuasiSteadySettings& settings,
                         double density, Vec3 wind_w)
    : settings_(settings),
      density_(density),
      rossby_(planform.second_moment_radius() / planform.mean_chord()),
      aspect_ratio_(planform.span() / planform.mean_chord()) {
  wind_w_ = wind_w;
  reference_radius_ = planform.second_moment_radius();
  const double width = planform.span() / settings.strips;
  for (int j = 0; j < settings.strips; ++j) {
    const Station s = planform.at(planform.root() + (j + 0.5) * width);
    strips_.push_back({s.radius, s.chord, s.leading_edge, width});
    if (settings.added_mass) add_strip_mass(strips_.back());
  }
}

LiftDrag QuasiSteady::coefficients(double alpha) const {
  switch (settings_.coefficients) {
    case QuasiSteadySettings::Coefficients::kLee2016:
      return lee_2016(alpha, settings_.reynolds, rossby_, aspect_ratio_);
    case QuasiSteadySettings::Coefficients::kTable:
      return interpolated(alpha, settings_.table);
    default:
      return dickinson_1999(alpha);
  }
}

// a flat strip's mass pi/4 rho c^2 at mid-chord and inertia pi/128 rho c^4 about it, per span
void QuasiSteady::add_strip_mass(const Strip& s) {
  const double c2 = s.chord * s.chord;
  const double mass = M_PI / 4 * density_ * c2 * s.width;
  const double inertia = M_PI / 128 * density_ * c2 * c2 * s.width;
  const double lever[3] = {1, s.radius, -(s.leading_edge + 0.5 * s.chord)};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) added_mass_[3 * r + c] += mass * lever[r] * lever[c];
  }
  added_mass_[8] += inertia;
}

// Lift and drag of the section's own motion (vx, vz) through the fluid, spanwise flow left out.
// Lift turns the relative wind towards the side that the wing leans on.
void QuasiSteady::add_translation(const Strip& s, double vx, double vz, double speed,
                                  Section& section, Wrench& load) const {
  if (speed < 1e-12) return;
  const double speed2 = speed * speed;
  const double ux = vx / speed, uz = vz / speed, side = vz > 0 ? -1 : 1;
  // on a wing that turns about its origin all strips meet the fluid at one angle: it and its sines
  // are taken again only where the direction changes by more than rounding
  constexpr double kSame = 1e-14;
  if (!(std::abs(ux - section.ux) + std::abs(uz - section.uz) <= kSame)) {
    // between the chord, seen from the leading edge, and the motion: 0 edge on, pi tail first
    const double alpha = std::atan2(std::abs(vz), -vx);
    section = {ux, uz, alpha, coefficients(alpha)};
  }
  const LiftDrag c = section.at;
  const double force = 0.5 * density_ * speed2 * s.chord * s.width;
  // drag against the motion; lift across it, towards the side that the fluid is pushed from
  const double fx = force * (-c.drag * ux + c.lift * side * uz);
  const double fz = force * (-c.drag * uz - c.lift * side * ux);
  // centre of pressure from the leading edge (Dickson, Straw, Poelma & Dickinson 2006)
  const double x = s.leading_edge + s.chord * (0.82 * section.alpha / M_PI + 0.05);
  load.force += {fx, 0, fz};
  load.torque += {s.radius * fz, -x * fz, -s.radius * fx};
}

// circulation pi (3/4 - x0) c^2 of the spin about the pitch axis, on the normal; no source
// gives its centre of pressure, mid-chord is what blade-element models commonly take
void QuasiSteady::add_rotation(const Strip& s, double speed, double spin, Wrench& load) const {
  const double axis = -s.leading_edge / s.chord;  // x0, the axis from the leading edge
  const double rotational = M_PI * (0.75 - axis);
  const double fz = density_ * rotational * speed * spin * s.chord * s.chord * s.width;
  const double x = s.leading_edge + 0.5 * s.chord;
  load.force.z += fz;
  load.torque += {s.radius * fz, -x * fz, 0};
}

Loads QuasiSteady::loads(const double*, const Motion& motion) const {
  const Twist t = relative_to_wind(motion, wind_w_).twist;
  Loads loads;
  Section section;
  for (const Strip& s : strips_) {
    if (!(s.chord > 0)) continue;
    // of the strip's point on the pitch axis
    const double vx = t.linear.x - t.angular.z * s.radius;
    const double vz = t.linear.z + t.angular.x * s.radius;
    const double speed = std::sqrt(vx * vx + vz * vz);
    add_translation(s, vx, vz, speed, section, loads.base);
    if (settings_.rotation) add_rotation(s, speed, t.angular.y, loads.extra);
  }
  return loads;
}

}  // namespace flaprig
