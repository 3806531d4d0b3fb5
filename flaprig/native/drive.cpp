#include "drive.hpp"

#include <algorithm>

#include "pool.hpp"
#include "stop.hpp"

namespace flaprig {
namespace {

Vec3 read3(const double* p) { return {p[0], p[1], p[2]}; }

void write(const Wrench& w, double* out) {
  const double values[6] = {w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z};
  std::copy_n(values, 6, out);
}

}  // namespace

Motion motion_at(const MotionArrays& a, int i) {
  Motion m;
  m.position_w = read3(a.position + 3 * i);
  std::copy_n(a.rotation + 9 * i, 9, m.rotation.m.begin());
  m.twist = {read3(a.twist + 6 * i), read3(a.twist + 6 * i + 3)};
  m.twist_rate = {read3(a.twist_rate + 6 * i), read3(a.twist_rate + 6 * i + 3)};
  return m;
}

void drive(const Air& air, double* state, const MotionArrays& motion, double* base, double* extra,
           double* added) {
  for (int i = 0; i < motion.n; ++i) {
    check_stop();
    const Motion now = motion_at(motion, i);
    air.prepare(state, now, motion.dt);
    const Loads loads = air.loads(state, now);
    write(loads.base, base + 6 * i);
    write(loads.extra, extra + 6 * i);
    const Motion relative = relative_to_wind(now, air.wind_w());
    write(added_mass_wrench(air.added_mass(), relative.twist_rate), added + 6 * i);
    air.advance(state, now, motion.dt);
  }
}

void drive_batch(const Air& air, int count, double* states, const MotionArrays& motions,
                 double* base, double* extra, double* added, int threads) {
  const int n = motions.n;
  in_parallel(threads, count, [&](int k) {
    const size_t first = static_cast<size_t>(k) * n;
    const MotionArrays one = {n,
                              motions.dt,
                              motions.position + 3 * first,
                              motions.rotation + 9 * first,
                              motions.twist + 6 * first,
                              motions.twist_rate + 6 * first};
    drive(air, states + static_cast<size_t>(k) * air.state_size(), one, base + 6 * first,
          extra + 6 * first, added + 6 * first);
  });
}

}  // namespace flaprig
