#include "lattice.hpp"

#include "dense.hpp"
#include "segment.hpp"
#include "stop.hpp"

namespace flaprig {

Vec3 ring_velocity(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 p, const std::array<double, 4>& cores) {
  return segment_velocity(a, b, p, cores[0]) + segment_velocity(b, c, p, cores[1]) +
         segment_velocity(c, d, p, cores[2]) + segment_velocity(d, a, p, cores[3]);
}

Lattice::Lattice(const Planform& planform, int chordwise, int spanwise, double tip_inset)
    : chordwise_(chordwise), spanwise_(spanwise) {
  place(planform, tip_inset);
  place_rings();
  invert();
}

void Lattice::place(const Planform& planform, double tip_inset) {
  const double dr = planform.span() / (spanwise_ + 2 * tip_inset);
  const double root = planform.root() + tip_inset * dr;
  for (int i = 0; i <= chordwise_; ++i) {
    const double along = i < chordwise_ ? (i + 0.25) / chordwise_ : 1.0;
    for (int j = 0; j <= spanwise_; ++j) {
      const Station s = planform.at(root + j * dr);
      vertices_.push_back({s.leading_edge + along * s.chord, root + j * dr, 0});
    }
  }
  for (int i = 0; i < chordwise_; ++i) {
    for (int j = 0; j < spanwise_; ++j) {
      const double along = (i + 0.75) / chordwise_, y = root + j * dr;
      const Station a = planform.at(y), b = planform.at(y + dr);
      const double le = 0.5 * (a.leading_edge + b.leading_edge), c = 0.5 * (a.chord + b.chord);
      collocations_.push_back({le + along * c, y + 0.5 * dr, 0});
    }
  }
}

// areas and centroids as two triangles
void Lattice::place_rings() {
  for (int i = 0; i < chordwise_; ++i) {
    for (int j = 0; j < spanwise_; ++j) {
      const Vec3 a = vertex(i, j), b = vertex(i, j + 1);
      const Vec3 c = vertex(i + 1, j + 1), d = vertex(i + 1, j);
      const double first = 0.5 * norm(cross(b - a, c - a));
      const double second = 0.5 * norm(cross(c - a, d - a));
      const double area = first + second;
      areas_.push_back(area);
      centres_.push_back((first / (3 * area)) * (a + b + c) + (second / (3 * area)) * (a + c + d));
    }
  }
}

void Lattice::invert() {
  const int m = size();
  std::vector<double> influence(static_cast<size_t>(m) * m);
  for (int k = 0; k < m; ++k) {
    check_stop();
    for (int l = 0; l < m; ++l) {
      const int i = l / spanwise_, j = l % spanwise_;
      influence[k * m + l] = ring_velocity(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1),
                                           vertex(i + 1, j), collocations_[k], {0, 0, 0, 0})
                                 .z;
    }
  }
  inverse_ = Lu(std::move(influence), m).inverse();
  response_.assign(static_cast<size_t>(m) * 3, 0);
  for (int k = 0; k < m; ++k) {
    for (int l = 0; l < m; ++l) {
      const double a = inverse_[k * m + l];
      response_[3 * k] += a;
      response_[3 * k + 1] += a * collocations_[l].y;
      response_[3 * k + 2] -= a * collocations_[l].x;
    }
  }
}

AddedMass Lattice::unit_added_mass() const {
  AddedMass raw{}, mass{};
  for (int k = 0; k < size(); ++k) {
    const double lever[3] = {1, centres_[k].y, -centres_[k].x};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) raw[3 * r + c] -= areas_[k] * lever[r] * response_[3 * k + c];
    }
  }
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) mass[3 * r + c] = 0.5 * (raw[3 * r + c] + raw[3 * c + r]);
  }
  return mass;
}

double Lattice::normal_velocity(int k, const Twist& t) const {
  const Vec3 p = collocations_[k];
  return t.linear.z + t.angular.x * p.y - t.angular.y * p.x;
}

}  // namespace flaprig
