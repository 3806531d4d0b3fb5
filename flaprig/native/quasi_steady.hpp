// Quasi-steady blade elements: translation, rotation, added mass, moving centre of pressure
// (Dickinson, Lehmann & Sane 1999; Sane & Dickinson 2002).
#pragma once

#include <vector>

#include "air.hpp"
#include "coefficients.hpp"
#include "settings.hpp"

namespace flaprig {

class QuasiSteady : public Air {
 public:
  QuasiSteady(const Planform& planform, const QuasiSteadySettings& settings, double density,
              Vec3 wind_w);

  int state_size() const override { return 0; }
  Loads loads(const double* state, const Motion& motion) const override;
  void advance(double*, const Motion&, double) const override {}
  LiftDrag coefficients(double alpha) const;

 private:
  struct Strip {
    double radius, chord, leading_edge, width;
  };
  // a direction of motion and the coefficients there; neighbouring strips mostly share it
  struct Section {
    double ux = 0, uz = 0, alpha = 0;
    LiftDrag at{};
  };
  void add_translation(const Strip& strip, double vx, double vz, double speed, Section& section,
                       Wrench& load) const;
  void add_rotation(const Strip& strip, double speed, double spin, Wrench& load) const;
  void add_strip_mass(const Strip& strip);

  QuasiSteadySettings settings_;
  double density_, rossby_, aspect_ratio_;
  std::vector<Strip> strips_;
};

}  // namespace flaprig
