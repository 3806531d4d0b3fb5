#include "uvlm.hpp"

#include <algorithm>
#include <cmath>

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
  // a wake that ends at full strength ends in a strong vortex, another one at every tick: in hover
  // it lies beside the wing, and its leaps are most of the noise in the pitch torque
  const double rows = settings.wake_rows;
  for (int row = 0; row < settings.wake_rows; ++row) {
    const double left = (rows - row) / (rows + 1);
    const double x = settings.wake_fade > 0 ? std::min(1.0, left / settings.wake_fade) : 1.0;
    fade_.push_back(x * x * (3 - 2 * x));
  }
  // eq. 6 is a force per unit span: the strip's width completes it
  const int n = lattice_.spanwise();
  for (int j = 0; j < n; ++j) {
    const Vec3 a = lattice_.vertex(0, j), b = lattice_.vertex(0, j + 1);
    const Station s = planform.at(0.5 * (a.y + b.y));
    const Station s0 = planform.at(a.y), s1 = planform.at(b.y);
    const double slope = (s1.leading_edge - s0.leading_edge) / (b.y - a.y);
    const double cos_sweep = 1 / std::sqrt(1 + slope * slope);
    const double panel = s.chord / lattice_.chordwise();
    suction_weight_.push_back(settings.suction_factor * settings.suction_efficiency * M_PI / 16 *
                              density / (panel * cos_sweep) * (b.y - a.y));
  }
}

int Uvlm::state_size() const {
  return Wake::state_size(lattice_.size(), lattice_.spanwise(), settings_.wake_rows);
}

Wake Uvlm::wake(double* state) const {
  return {lattice_.size(), lattice_.spanwise(), settings_.wake_rows, state};
}

// values are extrapolated from the last two ticks, the rate ramps from the one before to the
// last: of the schemes tried, the smallest jumps at ticks with the right mean
struct Uvlm::Between {
  std::vector<double> circulation, rate, stream;

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
      rate[k] = w.rate_p()[k] + s * (change / w.interval() - w.rate_p()[k]);
    }
    for (int k = 0; k < 2 * m; ++k) {
      stream[k] = w.stream_n()[k] + s * (w.stream_n()[k] - w.stream_p()[k]);
    }
  }
};

std::vector<double> Uvlm::circulation(const double* state, const Motion& motion) const {
  return Between(*this, state, relative_to_wind(motion, wind_w_).twist).circulation;
}

Loads Uvlm::loads(const double* state, const Motion& motion) const {
  const Motion relative = relative_to_wind(motion, wind_w_);
  const Between now(*this, state, relative.twist);
  Loads loads;
  steady_load(now.circulation.data(), now.stream.data(), relative.twist, loads.base);
  rate_load(now.rate.data(), loads.base);
  suction_load(now.circulation.data(), loads.extra);
  return loads;
}

namespace {

// a normal force at a point of the wing's plane
void add(Wrench& load, double force, Vec3 at) {
  load.force.z += force;
  load.torque.x += force * at.y;
  load.torque.y -= force * at.x;
}

}  // namespace

// rho (v x gamma).n of eq. 5 on the edges, with the velocity at the panels' collocation points
void Uvlm::steady_load(const double* g, const double* stream, const Twist& twist,
                       Wrench& load) const {
  const int rows = lattice_.chordwise(), n = lattice_.spanwise();
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < n; ++j) {
      const int k = i * n + j;
      const Vec3 p = lattice_.collocation(k);
      // the fluid past the panel
      const double vx = stream[2 * k] - twist.linear.x + twist.angular.z * p.y;
      const double vy = stream[2 * k + 1] - twist.linear.y - twist.angular.z * p.x;
      const auto edge = [&](Vec3 a, Vec3 b, double strength) {
        const double force = density_ * strength * (vx * (b.y - a.y) - vy * (b.x - a.x));
        add(load, force, 0.5 * (a + b));
      };
      const Vec3 a = lattice_.vertex(i, j), b = lattice_.vertex(i, j + 1);
      const Vec3 c = lattice_.vertex(i + 1, j + 1), d = lattice_.vertex(i + 1, j);
      edge(a, b, g[k] - (i > 0 ? g[k - n] : 0));
      // an inner side is shared with the next strip: half of it here; a tip is all ours
      edge(a, d, j > 0 ? 0.5 * (g[k - 1] - g[k]) : -g[k]);
      edge(b, c, j + 1 < n ? 0.5 * (g[k] - g[k + 1]) : g[k]);
    }
  }
}

// rho dG/dt over the rings' own areas
void Uvlm::rate_load(const double* rate, Wrench& load) const {
  for (int k = 0; k < lattice_.size(); ++k) {
    add(load, density_ * rate[k] * lattice_.ring_area(k), lattice_.ring_centre(k));
  }
}

// eq. 6, turned onto the normal and signed towards the suction side
void Uvlm::suction_load(const double* g, Wrench& load) const {
  for (int j = 0; j < lattice_.spanwise(); ++j) {
    const Vec3 at = 0.5 * (lattice_.vertex(0, j) + lattice_.vertex(0, j + 1));
    add(load, suction_weight_[j] * g[j] * std::abs(g[j]), at);
  }
}

void Uvlm::advance(double* state, const Motion& motion, double dt) const {
  Wake w = wake(state);
  // half a step early is nearer than half a step late
  if (w.started() == 0 || w.age() >= settings_.wake_step - 0.5 * dt) tick(state, motion);
  w.age() += dt;
}

void Uvlm::tick(double* state, const Motion& motion) const { Tick(*this, wake(state), motion).run(); }

}  // namespace flaprig
