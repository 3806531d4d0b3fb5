// The bound lattice: vortex rings on the wing, shifted aft by a quarter panel, the last ring
// closed at the true trailing edge (Katz & Plotkin 2001, section 13.12; paper, figure 1).
//
// Index of ring or panel (i, j): i * spanwise + j, i from the leading edge, j from the root.
#pragma once

#include <array>
#include <vector>

#include "air.hpp"
#include "planform.hpp"
#include "vec3.hpp"

namespace flaprig {

class Lattice {
 public:
  // the tips are drawn in by this fraction of a strip; 1/4 makes the spanwise error second order
  // where 0 leaves it first order (Hough 1973, the spanwise twin of the quarter-panel shift)
  Lattice(const Planform& planform, int chordwise, int spanwise, double tip_inset);

  int chordwise() const { return chordwise_; }
  int spanwise() const { return spanwise_; }
  int size() const { return chordwise_ * spanwise_; }
  // ring corners, (chordwise + 1) x (spanwise + 1); the last row is the trailing edge
  Vec3 vertex(int i, int j) const { return vertices_[i * (spanwise_ + 1) + j]; }
  Vec3 collocation(int k) const { return collocations_[k]; }
  // of the ring's quadrilateral [m2], and its centroid
  double ring_area(int k) const { return areas_[k]; }
  Vec3 ring_centre(int k) const { return centres_[k]; }
  // inverse of the influence matrix, rings closed, no core (eq. 3)
  const std::vector<double>& inverse() const { return inverse_; }
  // bound circulation per unit (v_z, w_x, w_y) without wake: size() x 3
  const std::vector<double>& motion_response() const { return response_; }
  double strip_width() const { return vertices_[1].y - vertices_[0].y; }
  // the mass of unit density that moves with the wing, made symmetric
  AddedMass unit_added_mass() const;
  // normal velocity of the wing at a collocation point
  double normal_velocity(int k, const Twist& twist) const;

 private:
  void place(const Planform& planform, double tip_inset);
  void place_rings();
  void invert();
  int chordwise_, spanwise_;
  std::vector<Vec3> vertices_, collocations_, centres_;
  std::vector<double> areas_, inverse_, response_;
};

// velocity of a closed ring of unit circulation with corners a b (leading) and d c (trailing)
Vec3 ring_velocity(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 p, const std::array<double, 4>& cores);

}  // namespace flaprig
