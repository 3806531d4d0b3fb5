#include "air.hpp"

#include <algorithm>

namespace flaprig {

std::string make_sound(const Air& air, double* state, double dt) {
  std::string fault = air.fault(state, dt);
  if (!fault.empty()) std::fill_n(state, air.state_size(), 0.0);
  return fault;
}

Motion relative_to_wind(const Motion& motion, Vec3 wind_w) {
  Motion relative = motion;
  const Vec3 wind = transposed(motion.rotation, wind_w);
  relative.twist.linear = motion.twist.linear - wind;
  // the wind turns in the wing's axes: d(R^T u)/dt = -w x R^T u
  relative.twist_rate.linear = motion.twist_rate.linear + cross(motion.twist.angular, wind);
  return relative;
}

Wrench added_mass_wrench(const AddedMass& a, const Twist& rate) {
  const double xi[3] = {rate.linear.z, rate.angular.x, rate.angular.y};
  double f[3];
  for (int i = 0; i < 3; ++i) {
    f[i] = -(a[3 * i] * xi[0] + a[3 * i + 1] * xi[1] + a[3 * i + 2] * xi[2]);
  }
  return {{0, 0, f[0]}, {f[1], f[2], 0}};
}

}  // namespace flaprig
