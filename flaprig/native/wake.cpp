#include "wake.hpp"

#include <algorithm>
#include <cstring>

namespace flaprig {

Vec3 Wake::vertex(int row, int j) const {
  const double* p = const_cast<Wake*>(this)->vertices() + (row * (strips + 1) + j) * 3;
  return {p[0], p[1], p[2]};
}

void Wake::set_vertex(int row, int j, Vec3 v) {
  double* p = vertices() + (row * (strips + 1) + j) * 3;
  p[0] = v.x, p[1] = v.y, p[2] = v.z;
}

void Wake::push_row(const double* row_strengths) {
  const int old = static_cast<int>(rows()), kept = std::min(old, capacity - 1);
  const int stride = (strips + 1) * 3;
  std::memmove(vertices() + stride, vertices(), sizeof(double) * (kept + 1) * stride);
  std::memmove(strengths() + strips, strengths(), sizeof(double) * kept * strips);
  std::copy_n(row_strengths, strips, strengths());
  rows() = kept + 1;
}

void Wake::clear() {
  std::fill_n(data, state_size(panels, strips, capacity, lags), 0.0);
}

}  // namespace flaprig
