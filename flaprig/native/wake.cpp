#include "wake.hpp"

#include <algorithm>
#include <cstring>

namespace flaprig {
namespace {

// rows of a kind before the oldest two merge: twice as many of one tick, so that nothing merges
// while the wing still meets it
int most_of(double kind, int detail) { return kind == 1 ? 2 * detail : detail; }

// one of each kind is about to merge, and there is the beginning of another kind
int rows_at_most(int longest, int detail) {
  if (detail == 0) return longest;
  int rows = 3;
  double held = 0;
  for (double kind = 1; held < longest; kind *= 2) {
    const int most = most_of(kind, detail);
    rows += most;
    held += kind * most;
  }
  return std::min(longest, rows);
}

}  // namespace

Wake::Wake(int panels_, int strips_, int longest_, int detail_, bool lags_, double* data_)
    : panels(panels_),
      strips(strips_),
      capacity(rows_at_most(longest_, detail_)),
      longest(longest_),
      // a wake that is gone before it is old
      detail(detail_ < longest_ ? detail_ : 0),
      lags(lags_),
      data(data_) {}

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
  std::memmove(vertices() + stride(), vertices(), sizeof(double) * (kept + 1) * stride());
  std::memmove(strengths() + strips, strengths(), sizeof(double) * kept * strips);
  std::memmove(ticks() + 1, ticks(), sizeof(double) * kept);
  std::copy_n(row_strengths, strips, strengths());
  ticks()[0] = 1;
  rows() = kept + 1;
  age_old(kept + 1);
  drop_oldest();
  if (detail > 0) merge_old();
}

// the oldest of the young vertex rows has become old; `last` is the oldest of all
void Wake::age_old(int last) {
  const int moved = last - detail;
  if (old_rows() == 0 || moved < 0) return;
  std::memmove(far(detail + 1), far(detail), sizeof(double) * moved * stride());
  std::memmove(drift(detail + 1), drift(detail), sizeof(double) * moved * stride());
  std::memmove(&found(detail + 1), &found(detail), sizeof(double) * moved);
  found(detail) = 0;
}

// a row that began to be shed more than the longest wake ago
void Wake::drop_oldest() {
  const int last = static_cast<int>(rows()) - 1;
  double newer = 0;
  for (int row = 0; row < last; ++row) newer += ticks()[row];
  if (newer >= longest) rows() = last;
}

// Where there are more rows of a length than there may be, the two oldest become one of twice that:
// a row's length grows with its age, and a wake of n ticks has about detail log2(n / detail) rows.
void Wake::merge_old() {
  int first = 0;
  for (double kind = 1; first < static_cast<int>(rows()); kind *= 2) {
    int end = first;
    while (end < static_cast<int>(rows()) && ticks()[end] == kind) ++end;
    if (end - first > most_of(kind, detail)) merge(end -= 2);
    first = end;
  }
}

// this row and the older one behind it. Vortex rings' impulse is strength times area: it is kept,
// but for the bend of the sheet at the vertices in between, which go.
void Wake::merge(int row) {
  double* g = strengths() + row * strips;
  for (int j = 0; j < strips; ++j) {
    const double a = area(row, j), b = area(row + 1, j);
    if (a + b > 0) g[j] = (a * g[j] + b * g[strips + j]) / (a + b);
  }
  ticks()[row] += ticks()[row + 1];
  const int left = static_cast<int>(rows()) - row - 2;  // older rows
  const auto close = [](double* gap, int width, int count) {
    std::memmove(gap, gap + width, sizeof(double) * width * count);
  };
  close(vertices() + (row + 1) * stride(), stride(), left + 1);
  close(far(row + 1), stride(), left + 1);
  close(drift(row + 1), stride(), left + 1);
  close(&found(row + 1), 1, left + 1);
  close(g + strips, strips, left);
  close(ticks() + row + 1, 1, left);
  rows() -= 1;
}

// of the ring between two vertex rows
double Wake::area(int row, int j) const {
  return 0.5 * norm(cross(vertex(row + 1, j + 1) - vertex(row, j),
                          vertex(row + 1, j) - vertex(row, j + 1)));
}

void Wake::clear() { std::fill_n(data, state_size(), 0.0); }

}  // namespace flaprig
