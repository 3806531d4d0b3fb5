// Loads of the lattice: eq. 5 on the rings' edges, dG/dt on their areas, suction of eq. 6 at the
// leading edge and of its like at the sides.

#include <cmath>

#include "uvlm.hpp"

namespace flaprig {

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

// rho dG/dt
void Uvlm::rate_load(const double* rate, Wrench& load) const {
  for (int k = 0; k < lattice_.size(); ++k) {
    add(load, density_ * rate[k] * rate_area_[k], rate_centre_[k]);
  }
}

// eq. 6, turned onto the normal and signed towards the suction side
void Uvlm::suction_load(const double* g, Wrench& load) const {
  for (int j = 0; j < lattice_.spanwise(); ++j) {
    const Vec3 at = 0.5 * (lattice_.vertex(0, j) + lattice_.vertex(0, j + 1));
    add(load, suction_weight_[j] * g[j] * std::abs(g[j]), at);
  }
}

// the suction of an edge that the flow turns around, per panel at either end of the span
void Uvlm::side_load(const double* g, Wrench& load) const {
  if (settings_.side_suction_efficiency == 0) return;
  const int rows = lattice_.chordwise(), n = lattice_.spanwise();
  for (int i = 0; i < rows; ++i) {
    for (int side = 0; side < 2; ++side) {
      const double strength = g[i * n + side * (n - 1)];
      const Vec3 at = 0.5 * (lattice_.vertex(i, side * n) + lattice_.vertex(i + 1, side * n));
      add(load, side_weight_[side] * strength * std::abs(strength), at);
    }
  }
}

// eq. 6 is a force per unit length of the edge. With n = x cos L the distance to an edge of sweep
// L, the singularity's strength is G^2 / (16 dx cos L), and a strip's edge is as long as its width
// over cos L.
void Uvlm::weigh_suction(const Planform& planform) {
  for (int j = 0; j < lattice_.spanwise(); ++j) {
    const Vec3 a = lattice_.vertex(0, j), b = lattice_.vertex(0, j + 1);
    const Station s = planform.at(0.5 * (a.y + b.y));
    const Station s0 = planform.at(a.y), s1 = planform.at(b.y);
    const double slope = (s1.leading_edge - s0.leading_edge) / (b.y - a.y);
    const double cos_sweep = 1 / std::sqrt(1 + slope * slope);
    const double panel = s.chord / lattice_.chordwise();
    suction_weight_.push_back(settings_.suction_factor * settings_.suction_efficiency * M_PI / 16 *
                              density_ / (panel * cos_sweep) * (b.y - a.y) / cos_sweep);
  }
}

// eq. 6 turned by a right angle: per unit chord, over the width of a strip (Lamar 1974). As at the
// leading edge the outermost ring returns pi/4 of the suction in the limit, whatever the inset, and
// here the factor is always in.
void Uvlm::weigh_sides(const Planform& planform) {
  for (int side = 0; side < 2; ++side) {
    const double chord = planform.at(lattice_.vertex(0, side * lattice_.spanwise()).y).chord;
    side_weight_[side] = settings_.side_suction_efficiency * density_ / 4 * chord /
                         lattice_.chordwise() / lattice_.strip_width();
  }
}

// dG/dt acts on the rings' own areas. Where it is not smoothed, the last ring gives up the quarter
// panel by which a wake that leaves at a fifth, spaced like the lattice, would else be counted
// twice: half a panel is left, as in Katz & Plotkin 2001, program 16.
void Uvlm::place_rates() {
  const int m = lattice_.size(), n = lattice_.spanwise(), rows = lattice_.chordwise();
  for (int k = 0; k < m; ++k) {
    rate_area_.push_back(lattice_.ring_area(k));
    rate_centre_.push_back(lattice_.ring_centre(k));
  }
  if (!prepares()) return;
  for (int j = 0; j < n; ++j) {
    const auto middle = [&](int i) {
      return 0.5 * (lattice_.vertex(i, j) + lattice_.vertex(i, j + 1));
    };
    const Vec3 edge = middle(rows), front = middle(rows - 1) - 1.0 / 3 * (edge - middle(rows - 1));
    rate_area_[m - n + j] *= 2.0 / 3;
    rate_centre_[m - n + j] = 0.5 * (front + edge);
  }
}

}  // namespace flaprig
