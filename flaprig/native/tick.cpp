#include "tick.hpp"

#include <algorithm>
#include <cmath>

#include "clock.hpp"
#include "dense.hpp"
#include "induced.hpp"
#include "roll_up.hpp"

namespace flaprig {
namespace {

Vec3 to_world(const Motion& m, Vec3 p) { return m.position_w + m.rotation * p; }

Motion read_pose(const double* pose) {
  Motion m;
  m.position_w = {pose[0], pose[1], pose[2]};
  std::copy_n(pose + 3, 9, m.rotation.m.begin());
  return m;
}

}  // namespace

Tick::Tick(const Uvlm& air, Wake wake, const Motion& motion)
    : air_(air),
      lattice_(air.lattice()),
      wake_(wake),
      motion_(motion),
      relative_(relative_to_wind(motion, air.wind_w())),
      elapsed_(wake.age()) {}

void Tick::run() {
  if (wake_.started() != 0 && trailing_edge_jumped()) wake_.clear();
  if (wake_.started() == 0) {
    begin();
  } else {
    Stopwatch clock(Phase::kRollUp);
    roll_up();
    shed();
  }
  Stopwatch clock(Phase::kWing);
  wake_stream();
  kutta_influence();
  solve();
  remember();
}

void Tick::roll_up() {
  const Motion pose = read_pose(wake_.pose());
  if (air_.settings().precision == UvlmSettings::Precision::kDouble) {
    RollUp<double>(air_, wake_, pose).run(elapsed_);
  } else {
    RollUp<float>(air_, wake_, pose).run(elapsed_);
  }
}

Vec3 Tick::trailing_edge_w(int j) const {
  return to_world(motion_, lattice_.vertex(lattice_.chordwise(), j));
}

// someone moved the body by hand: the old wake has nothing to do with the new place
bool Tick::trailing_edge_jumped() const {
  const Motion old = read_pose(const_cast<Wake&>(wake_).pose());
  const double core = air_.core() / air_.settings().core;  // mean chord
  for (int j = 0; j <= lattice_.spanwise(); ++j) {
    const Vec3 p = lattice_.vertex(lattice_.chordwise(), j);
    const double moved = norm(to_world(motion_, p) - to_world(old, p));
    const double speed = norm(motion_.twist.linear + cross(motion_.twist.angular, p));
    if (moved > 0.5 * core + 2 * speed * elapsed_) return true;
  }
  return false;
}

// the first row lies where a steady motion would have left it
void Tick::begin() {
  const double f = air_.settings().shedding_fraction;
  const double reach = f / (1 - f) * air_.settings().wake_step;
  for (int j = 0; j <= lattice_.spanwise(); ++j) {
    const Vec3 p = lattice_.vertex(lattice_.chordwise(), j);
    const Vec3 speed = relative_.twist.linear + cross(relative_.twist.angular, p);
    wake_.set_vertex(0, j, trailing_edge_w(j) - reach * (motion_.rotation * speed));
  }
  wake_.rows() = 0;
  elapsed_ = air_.settings().wake_step;
}

// the new row between the trailing edge and the last free row; the last ring freezes
void Tick::shed() {
  const double f = air_.settings().shedding_fraction;
  wake_.push_row(wake_.circulation() + (lattice_.chordwise() - 1) * wake_.strips);
  for (int j = 0; j <= wake_.strips; ++j) {
    const Vec3 edge = trailing_edge_w(j);
    wake_.set_vertex(0, j, edge + f * (wake_.vertex(1, j) - edge));
  }
}

void Tick::wake_stream() {
  const int m = wake_.panels, n = wake_.strips, rows = static_cast<int>(wake_.rows());
  const double scale = air_.settings().core / air_.core();
  Sheet<double> sheet;
  sheet.resize(rows, n);
  for (int v = 0; v < (rows + 1) * (n + 1); ++v) {
    sheet.put(v, scale * (wake_.vertex(v / (n + 1), v % (n + 1)) - motion_.position_w));
  }
  air_.free_strengths(wake_, sheet.circulation.data());
  Points<double> points(m), velocity(m);
  for (int k = 0; k < m; ++k) {
    const Vec3 p = scale * (motion_.rotation * lattice_.collocation(k));
    points.x[k] = p.x, points.y[k] = p.y, points.z[k] = p.z;
  }
  induced_velocity(sheet, air_.settings().core, points, velocity, 1);
  stream_.resize(m);
  for (int k = 0; k < m; ++k) {
    stream_[k] = scale * transposed(motion_.rotation, {velocity.x[k], velocity.y[k], velocity.z[k]});
  }
}

// the near side of the first ring lies on the bound trailing edge and must cancel it: no core
void Tick::kutta_influence() {
  const int m = wake_.panels, n = wake_.strips, bound = lattice_.chordwise();
  const double core = air_.core();
  std::vector<Vec3> far(n + 1);
  for (int j = 0; j <= n; ++j) {
    far[j] = transposed(motion_.rotation, wake_.vertex(0, j) - motion_.position_w);
  }
  kutta_.resize(static_cast<size_t>(m) * n);
  for (int k = 0; k < m; ++k) {
    for (int j = 0; j < n; ++j) {
      kutta_[k * n + j] =
          ring_velocity(lattice_.vertex(bound, j), lattice_.vertex(bound, j + 1), far[j + 1],
                        far[j], lattice_.collocation(k), {0, core, core, core});
    }
  }
}

// (A + K S) G = b, S picking the trailing edge's rings: with H = A^-1 K only a strips x strips
// system is left (Woodbury)
void Tick::solve() {
  const int m = wake_.panels, n = wake_.strips, edge = m - n;
  const double* inverse = lattice_.inverse().data();
  std::vector<double> h(static_cast<size_t>(m) * n, 0), small(static_cast<size_t>(n) * n);
  circulation_.assign(m, 0);
  for (int k = 0; k < m; ++k) {
    for (int l = 0; l < m; ++l) {
      const double a = inverse[k * m + l];
      circulation_[k] += a * (lattice_.normal_velocity(l, relative_.twist) - stream_[l].z);
      for (int j = 0; j < n; ++j) h[k * n + j] += a * kutta_[l * n + j].z;
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) small[i * n + j] = h[(edge + i) * n + j] + (i == j ? 1 : 0);
  }
  Lu lu;
  std::vector<double> shed(circulation_.begin() + edge, circulation_.end());
  // a broken wake gives no solution; NaN then tells everyone above
  if (lu.factor(small, n)) {
    lu.solve(shed.data());
  } else {
    shed.assign(n, std::nan(""));
  }
  for (int k = 0; k < m; ++k) {
    for (int j = 0; j < n; ++j) circulation_[k] -= h[k * n + j] * shed[j];
  }
}

// the circulation that the loads see follows the bound one over some chords of travel, as the
// leading-edge vortex does; it begins from nothing
void Tick::build_up(bool first) {
  const int m = wake_.panels, n = wake_.strips;
  for (int k = 0; k < m; ++k) {
    const double share = 1 - std::exp(-air_.travel(k % n, relative_.twist) * elapsed_ /
                                      air_.settings().circulation_lag);
    double &now = wake_.lagged_n()[k], &before = wake_.lagged_p()[k];
    const double next = now + share * (circulation_[k] - now);
    before = first ? next : now;
    now = next;
  }
}

void Tick::remember() {
  const int m = wake_.panels, n = wake_.strips;
  const bool first = wake_.started() == 0;
  for (int k = 0; k < m; ++k) {
    for (int j = 0; j < n; ++j) {
      stream_[k] += circulation_[m - n + j] * kutta_[k * n + j];
    }
    const double* b0 = &lattice_.motion_response()[3 * k];
    const Twist& t = relative_.twist;
    const double memory =
        circulation_[k] - b0[0] * t.linear.z - b0[1] * t.angular.x - b0[2] * t.angular.y;
    const double change = first ? 0 : wake_.memory_n()[k] - wake_.memory_p()[k];
    wake_.rate_p()[k] = first ? 0 : change / wake_.interval();
    wake_.memory_p()[k] = first ? memory : wake_.memory_n()[k];
    wake_.memory_n()[k] = memory;
    const double stream[2] = {stream_[k].x, stream_[k].y};
    for (int i = 0; i < 2; ++i) {
      double& now = wake_.stream_n()[2 * k + i];
      wake_.stream_p()[2 * k + i] = first ? stream[i] : now;
      now = stream[i];
    }
    wake_.circulation()[k] = circulation_[k];
  }
  if (wake_.lags) build_up(first);
  double* pose = wake_.pose();
  pose[0] = motion_.position_w.x, pose[1] = motion_.position_w.y, pose[2] = motion_.position_w.z;
  std::copy_n(motion_.rotation.m.begin(), 9, pose + 3);
  wake_.interval() = elapsed_;
  wake_.started() = 1;
  wake_.age() = 0;
}

}  // namespace flaprig
