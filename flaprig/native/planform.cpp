#include "planform.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace flaprig {
namespace {

void require(bool ok, size_t index, const char* what) {
  if (!ok) {
    throw std::invalid_argument("stations: station " + std::to_string(index) + " " + what);
  }
}

void check(const std::vector<Station>& stations) {
  constexpr double kLargest = 1e3;  // metres; keeps every product finite
  for (size_t i = 0; i < stations.size(); ++i) {
    const Station& s = stations[i];
    require(std::abs(s.radius) <= kLargest, i, "must have a radius within +-1000 m");
    require(s.chord >= 0 && s.chord <= kLargest, i, "must have a chord from 0 to 1000 m");
    require(std::abs(s.leading_edge) <= kLargest, i, "must have a leading edge within +-1000 m");
    if (i > 0) {
      require(s.radius - stations[i - 1].radius > 1e-9, i, "must lie further out than the last");
    }
    if (i > 0 && i + 1 < stations.size()) {
      require(s.chord > 0, i, "must have a positive chord; only the ends may be points");
    }
  }
}

}  // namespace

Planform::Planform(std::vector<Station> stations) : stations_(std::move(stations)) {
  if (stations_.size() < 2) {
    throw std::invalid_argument("stations: at least two stations are needed");
  }
  check(stations_);
  integrate();
  if (!(area_ > 1e-12)) {
    throw std::invalid_argument("stations: the wing's area must be above 1e-12 m2");
  }
}

Station Planform::at(double radius) const {
  const double r = std::clamp(radius, root(), tip());
  size_t i = 1;
  while (i + 1 < stations_.size() && stations_[i].radius < r) ++i;
  const Station &a = stations_[i - 1], &b = stations_[i];
  const double t = (r - a.radius) / (b.radius - a.radius);
  return {r, a.chord + t * (b.chord - a.chord),
          a.leading_edge + t * (b.leading_edge - a.leading_edge)};
}

void Planform::integrate() {
  double second = 0;
  for (size_t i = 1; i < stations_.size(); ++i) {
    const Station &a = stations_[i - 1], &b = stations_[i];
    // Gauss's three points: the integrands are cubic at most
    constexpr double kPoint = 0.7745966692414834, kSide = 5.0 / 18, kMiddle = 8.0 / 18;
    for (const auto& [node, weight] : {std::pair{-kPoint, kSide}, {0.0, kMiddle}, {kPoint, kSide}}) {
      const double t = 0.5 * (1 + node), dr = weight * (b.radius - a.radius);
      const double r = a.radius + t * (b.radius - a.radius);
      const double c = a.chord + t * (b.chord - a.chord);
      const double x = a.leading_edge + t * (b.leading_edge - a.leading_edge);
      area_ += c * dr;
      second += r * r * c * dr;
      centroid_x_ += (x + 0.5 * c) * c * dr;
      centroid_y_ += r * c * dr;
    }
  }
  centroid_x_ /= area_;
  centroid_y_ /= area_;
  second_moment_radius_ = std::sqrt(second / area_);
}

}  // namespace flaprig
