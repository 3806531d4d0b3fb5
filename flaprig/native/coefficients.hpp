// Translational lift and drag coefficients of a flapping wing against the angle of attack.
#pragma once

#include "settings.hpp"

namespace flaprig {

struct LiftDrag {
  double lift, drag;
};

// alpha in [0, pi] rad. Dickinson, Lehmann & Sane 1999: fits to a robot fly at Re of order 100
LiftDrag dickinson_1999(double alpha);
// Lee, Lua, Lim & Yeo 2016: rectangular wings, Reynolds number and Rossby number (R2 over mean
// chord) at R2, aspect ratio span over mean chord
LiftDrag lee_2016(double alpha, double reynolds, double rossby, double aspect_ratio);
LiftDrag interpolated(double alpha, const CoefficientTable& table);

}  // namespace flaprig
