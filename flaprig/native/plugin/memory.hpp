// What an instance keeps in MuJoCo's state ahead of the air's own memory: the last step's loads.
#pragma once

#include <algorithm>

#include "../air.hpp"

namespace flaprig {

// zeros until the first step
struct Memory {
  double* data;

  static constexpr int kSize = 16;

  double* wrench() { return data; }        // air without buoyancy, wing axes, about the origin
  double& lift() { return data[6]; }       // against gravity [N]
  double& drag() { return data[7]; }       // against the motion of the reference radius [N]
  double& power() { return data[8]; }      // given to the fluid [W]
  double* mount() { return data + 9; }     // the wing's wrench on its mount, wing axes, origin
  double* air() { return data + kSize; }   // the air model's state
};

inline void put(const Wrench& w, double* out) {
  const double values[6] = {w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z};
  std::copy_n(values, 6, out);
}

inline Wrench get(const double* in) { return {{in[0], in[1], in[2]}, {in[3], in[4], in[5]}}; }

}  // namespace flaprig
