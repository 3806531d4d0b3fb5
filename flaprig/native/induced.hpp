// Velocities that a lattice of vortex rings induces at many points: the roll-up's inner loop.
#pragma once

#include <vector>

#include "vec3.hpp"

namespace flaprig {

// A sheet of vortex rings on (rings + 1) x (strips + 1) vertices. A ring's sides are shared by
// its neighbours, so edges carry differences of ring strengths and each is visited once.
// Ring (k, j) turns +y on the edge towards row k and -y towards row k + 1.
template <class T>
struct Sheet {
  int rings = 0, strips = 0;
  std::vector<T> x, y, z;      // vertices, row by row
  std::vector<T> circulation;  // rings, row by row
  void resize(int rings_, int strips_);
  void put(int vertex, Vec3 p) {
    x[vertex] = static_cast<T>(p.x), y[vertex] = static_cast<T>(p.y), z[vertex] = static_cast<T>(p.z);
  }
};

template <class T>
struct Points {
  std::vector<T> x, y, z;
  explicit Points(int n = 0) : x(n), y(n), z(n) {}
  int size() const { return static_cast<int>(x.size()); }
};

// lengths should be of order one (the caller scales by the chord): the smallest numbers in
// here are eighth powers of a length. The result does not depend on the number of threads.
void induced_velocity(const Sheet<float>& sheet, float core, const Points<float>& points,
                      Points<float>& velocity, int threads);
void induced_velocity(const Sheet<double>& sheet, double core, const Points<double>& points,
                      Points<double>& velocity, int threads);

}  // namespace flaprig
