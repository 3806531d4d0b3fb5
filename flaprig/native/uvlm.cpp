#include "uvlm.hpp"

#include <algorithm>
#include <cmath>

#include "clock.hpp"
#include "tick.hpp"

namespace flaprig {

Uvlm::Uvlm(const Planform& planform, const UvlmSettings& settings, double density, Vec3 wind_w)
    : settings_(settings),
      lattice_(planform, settings.chordwise, settings.spanwise, settings.tip_inset),
      density_(density),
      core_(settings.core * planform.mean_chord()) {
  wind_w_ = wind_w;
  reference_radius_ = planform.second_moment_radius();
  added_mass_ = lattice_.unit_added_mass();
  for (double& a : added_mass_) a *= density;
  place_rates();
  weigh_suction(planform);
  weigh_sides(planform);
  for (int j = 0; j < lattice_.spanwise(); ++j) {
    const double y = 0.5 * (lattice_.vertex(0, j).y + lattice_.vertex(0, j + 1).y);
    const Station s = planform.at(y);
    chord_.push_back(s.chord);
    middle_.push_back({s.leading_edge + 0.5 * s.chord, y, 0});
  }
}

int Uvlm::state_size() const {
  return wake(nullptr).state_size();
}

std::string Uvlm::fault(const double* state, double dt) const {
  Wake w = wake(const_cast<double*>(state));
  std::string fault = w.fault();
  if (!fault.empty() || dt == 0 || w.started() == 0 || !due(w, dt)) return fault;
  const bool finite = std::all_of(state, state + state_size(), [](double x) { return std::isfinite(x); });
  return finite ? "" : "a number of the wake is not finite";
}

Wake Uvlm::wake(double* state) const {
  return {lattice_.size(),       lattice_.spanwise(),           settings_.wake_rows,
          settings_.wake_detail, settings_.circulation_lag > 0, state};
}

// a wake that ends at full strength ends in a strong vortex, another one at every tick: in hover
// it lies beside the wing, and its leaps are most of the noise in the pitch torque
double Uvlm::fade(double age) const {
  if (settings_.wake_fade == 0) return 1;
  const double left = (settings_.wake_rows - age) / (settings_.wake_rows + 1);
  const double x = std::clamp(left / settings_.wake_fade, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

// values are extrapolated from the last two ticks, the rate ramps from the one before to the
// last: of the schemes tried, the smallest jumps at ticks with the right mean
struct Uvlm::Between {
  std::vector<double> circulation, rate, stream;
  std::vector<double> built_up;  // the circulation that the loads see

  Between(const Uvlm& air, const double* state, const Twist& twist) {
    Wake w = air.wake(const_cast<double*>(state));
    const int m = w.panels;
    const double* b0 = air.lattice_.motion_response().data();
    circulation.resize(m), rate.assign(m, 0), stream.assign(2 * m, 0);
    const double s = w.started() != 0 ? w.age() / w.interval() : 0;
    for (int k = 0; k < m; ++k) {
      const double change = w.memory_n()[k] - w.memory_p()[k];
      circulation[k] = w.memory_n()[k] + s * change + b0[3 * k] * twist.linear.z +
                       b0[3 * k + 1] * twist.angular.x + b0[3 * k + 2] * twist.angular.y;
      if (w.started() == 0) continue;
      const double last = change / w.interval(), before = w.rate_p()[k];
      if (!air.prepares()) rate[k] = before + s * (last - before);
      // the first interval has none before it
      if (air.prepares()) rate[k] = last + (w.rows() > 1 ? air.lead(s) : 0) * (last - before);
    }
    for (int k = 0; k < 2 * m; ++k) {
      stream[k] = w.stream_n()[k] + s * (w.stream_n()[k] - w.stream_p()[k]);
    }
    built_up = circulation;
    for (int k = 0; w.lags && k < m; ++k) {
      built_up[k] = w.lagged_n()[k] + s * (w.lagged_n()[k] - w.lagged_p()[k]);
    }
  }
};

std::vector<double> Uvlm::circulation(const double* state, const Motion& motion) const {
  return Between(*this, state, relative_to_wind(motion, wind_w_).twist).circulation;
}

Loads Uvlm::loads(const double* state, const Motion& motion) const {
  Stopwatch clock(Phase::kLoads);
  const Motion relative = relative_to_wind(motion, wind_w_);
  const Between now(*this, state, relative.twist);
  Loads loads;
  steady_load(now.built_up.data(), now.stream.data(), relative.twist, loads.base);
  rate_load(now.rate.data(), loads.base);
  suction_load(now.built_up.data(), loads.extra);
  side_load(now.built_up.data(), loads.extra);
  return loads;
}

double Uvlm::travel(int strip, const Twist& t) const {
  const Vec3 p = middle_[strip];
  const double across = t.linear.z + t.angular.x * p.y - t.angular.y * p.x;
  return std::hypot(t.linear.x - t.angular.z * p.y, across) / chord_[strip];
}

// half a step early is nearer than half a step late
bool Uvlm::due(const Wake& wake, double dt) const {
  Wake w = wake;
  return w.started() == 0 || w.age() >= settings_.wake_step - 0.5 * dt;
}

void Uvlm::prepare(double* state, const Motion& motion, double dt) const {
  if (prepares() && due(wake(state), dt)) tick(state, motion);
}

void Uvlm::advance(double* state, const Motion& motion, double dt) const {
  Wake w = wake(state);
  if (!prepares() && due(w, dt)) tick(state, motion);
  w.age() += dt;
}

void Uvlm::tick(double* state, const Motion& motion) const { Tick(*this, wake(state), motion).run(); }

}  // namespace flaprig
