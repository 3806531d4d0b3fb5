// Convection of the free wake with the velocity that all vortices had at the last tick.
#pragma once

#include <vector>

#include "induced.hpp"
#include "uvlm.hpp"

namespace flaprig {

// A young vertex row moves with the velocity that all vortices induce now. An old one sums two: that
// of the wing and what it has just shed, found now, and that of all else, which changes slowly: it is
// found every second tick, from twice the age on every fourth, and extrapolated in between.
// T: the precision of its velocities.
template <class T>
class RollUp {
 public:
  // pose: of the wing at the last tick
  RollUp(const Uvlm& air, Wake& wake, const Motion& pose);
  // moves every vertex row [s]
  void run(double elapsed);

 private:
  using Rows = std::vector<int>;
  void place(const Motion& pose);
  Sheet<T> part(int first, int last) const;
  int every(int row) const;
  Rows due() const;
  std::vector<Vec3> velocity(const Rows& rows, const Sheet<T>& by) const;
  void find_far();
  void move(const Rows& rows, const Sheet<T>& by, double elapsed);
  Vec3 far(int row, int j) const;

  const Uvlm& air_;
  Wake& wake_;
  int bound_, columns_, rows_, young_;  // rows of bound and of free vertices
  Sheet<T> whole_;                      // mean chords about the wing
  std::vector<double> age_;             // of free rows [ticks]
};

}  // namespace flaprig
