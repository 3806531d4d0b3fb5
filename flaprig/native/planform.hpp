// The outline of a flat wing: chord and leading edge, piecewise linear along the span.
#pragma once

#include <vector>

namespace flaprig {

struct Station {
  double radius;        // distance from the frame's origin along the span [m]
  double chord;         // [m]
  double leading_edge;  // x of the leading edge [m]; the trailing edge is at x + chord
};

class Planform {
 public:
  // throws std::invalid_argument naming the station that is wrong
  explicit Planform(std::vector<Station> stations);

  Station at(double radius) const;
  double root() const { return stations_.front().radius; }
  double tip() const { return stations_.back().radius; }
  double span() const { return tip() - root(); }
  double area() const { return area_; }
  double mean_chord() const { return area_ / span(); }
  // area-weighted radius of the second moment from the origin [m] (R2 of the paper, fig. 2)
  double second_moment_radius() const { return second_moment_radius_; }
  // centroid of the area
  double centroid_x() const { return centroid_x_; }
  double centroid_y() const { return centroid_y_; }

 private:
  void integrate();
  std::vector<Station> stations_;
  double area_ = 0, second_moment_radius_ = 0, centroid_x_ = 0, centroid_y_ = 0;
};

}  // namespace flaprig
