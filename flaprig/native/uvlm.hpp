// The modified unsteady vortex lattice method (paper, section 2.1).
#pragma once

#include <array>
#include <vector>

#include "air.hpp"
#include "lattice.hpp"
#include "settings.hpp"
#include "wake.hpp"

namespace flaprig {

// Between wake ticks the bound circulation is G(t) = Gw(t) + B0 (v_z, w_x, w_y): the second part
// follows the motion at every step, the first is carried on from the last ticks.
class Uvlm : public Air {
 public:
  Uvlm(const Planform& planform, const UvlmSettings& settings, double density, Vec3 wind_w);

  int state_size() const override;
  // also, where a row is due, a number that is not finite
  std::string fault(const double* state, double dt) const override;
  Loads loads(const double* state, const Motion& motion) const override;
  void prepare(double* state, const Motion& motion, double dt) const override;
  bool prepares() const override { return settings_.rate != UvlmSettings::Rate::kRamped; }
  void advance(double* state, const Motion& motion, double dt) const override;

  // one step of the wake at this motion, whatever its age
  void tick(double* state, const Motion& motion) const;
  Wake wake(double* state) const;
  // what the frozen rings still carry: their strengths, faded towards the oldest row
  template <class T>
  void free_strengths(Wake& wake, T* out) const {
    const double* strengths = wake.strengths();
    double newer = 0;  // ticks
    for (int row = 0; row < static_cast<int>(wake.rows()); ++row) {
      const double ticks = wake.ticks()[row], left = fade(newer + 0.5 * (ticks - 1));
      for (int j = 0; j < wake.strips; ++j) *out++ = static_cast<T>(left * *strengths++);
      newer += ticks;
    }
  }
  // speed of a strip's mid-chord across the span [chords/s]
  double travel(int strip, const Twist& twist) const;
  const Lattice& lattice() const { return lattice_; }
  const UvlmSettings& settings() const { return settings_; }
  double core() const { return core_; }
  // bound circulation at this motion, between ticks [m2/s]
  std::vector<double> circulation(const double* state, const Motion& motion) const;

 private:
  friend class Tick;
  struct Between;  // the wake's part at the present age
  // intervals from the last one's middle to an age of s intervals
  double lead(double s) const {
    return settings_.rate == UvlmSettings::Rate::kSecondOrder ? s + 0.5 : 0;
  }
  // what is left of a row's strength at an age in ticks
  double fade(double age) const;
  bool due(const Wake& wake, double dt) const;
  void place_rates();
  void steady_load(const double* g, const double* stream, const Twist& twist, Wrench& load) const;
  void rate_load(const double* rate, Wrench& load) const;
  void suction_load(const double* g, Wrench& load) const;
  void side_load(const double* g, Wrench& load) const;
  void weigh_suction(const Planform& planform);
  void weigh_sides(const Planform& planform);

  UvlmSettings settings_;
  Lattice lattice_;
  double density_, core_;
  std::vector<double> rate_area_;       // that dG/dt of a ring acts on [m2], and where
  std::vector<Vec3> rate_centre_;
  std::vector<double> suction_weight_;  // per strip: force / (G |G|)
  std::array<double, 2> side_weight_{};  // root, tip: force on a panel's side / (G |G|)
  std::vector<double> chord_;           // per strip [m]
  std::vector<Vec3> middle_;            // mid-chord
};

}  // namespace flaprig
