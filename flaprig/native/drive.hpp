// Prescribed motion: the air without rigid bodies, driven by arrays of poses and twists.
#pragma once

#include "air.hpp"

namespace flaprig {

// n instants, dt apart; row-major arrays
struct MotionArrays {
  int n;
  double dt;
  const double* position;    // n x 3, world
  const double* rotation;    // n x 9, wing to world
  const double* twist;       // n x 6, linear then angular, wing axes
  const double* twist_rate;  // n x 6
};

Motion motion_at(const MotionArrays& motion, int i);

// for each instant: the loads, then the step that begins there. Output n x 6 each (force, torque
// in wing axes); added: the added mass's share. The state must be sound (air.hpp). Throws Stopped in
// the middle of a step, where the state is worth nothing.
void drive(const Air& air, double* state, const MotionArrays& motion, double* base, double* extra,
           double* added);

// many wings of one kind, each in fluid of its own: `count` motions of n instants one after the
// other in the arrays, and as many states and outputs. The result does not depend on threads.
void drive_batch(const Air& air, int count, double* states, const MotionArrays& motions,
                 double* base, double* extra, double* added, int threads);

}  // namespace flaprig
