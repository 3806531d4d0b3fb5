// One step of the wake: convect, shed, solve with the Kutta condition, remember.
#pragma once

#include <vector>

#include "uvlm.hpp"

namespace flaprig {

class Tick {
 public:
  Tick(const Uvlm& air, Wake wake, const Motion& motion);
  void run();

 private:
  bool trailing_edge_jumped() const;
  Vec3 trailing_edge_w(int j) const;
  void begin();
  void roll_up();
  void shed();
  void wake_stream();
  void kutta_influence();
  void solve();
  void remember();
  void build_up(bool first);

  const Uvlm& air_;
  const Lattice& lattice_;
  Wake wake_;
  const Motion& motion_;
  Motion relative_;  // to the wind
  double elapsed_;   // since the last tick [s]
  std::vector<Vec3> stream_;  // velocity of the wake at the collocation points, wing axes
  std::vector<Vec3> kutta_;   // the same of each first wake ring at unit circulation
  std::vector<double> circulation_;
};

}  // namespace flaprig
