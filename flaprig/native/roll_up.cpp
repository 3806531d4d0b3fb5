#include "roll_up.hpp"

#include <algorithm>
#include <numeric>

namespace flaprig {
namespace {

// rows behind the trailing edge that are near when the velocity by all else is found
constexpr int kNear = 4;

}  // namespace

template <class T>
RollUp<T>::RollUp(const Uvlm& air, Wake& wake, const Motion& pose)
    : air_(air),
      wake_(wake),
      bound_(air.lattice().chordwise() + 1),
      columns_(wake.strips + 1),
      rows_(static_cast<int>(wake.rows()) + 1),
      young_(wake.old_rows() > 0 ? std::min(wake.detail, rows_) : rows_),
      age_(rows_) {
  for (int row = 1; row < rows_; ++row) age_[row] = age_[row - 1] + wake.ticks()[row - 1];
  place(pose);
}

// bound rings, the first wake rings and the frozen ones are one sheet: the trailing edge cancels by
// itself
template <class T>
void RollUp<T>::place(const Motion& pose) {
  const int n = wake_.strips;
  const double scale = air_.settings().core / air_.core();  // lengths in mean chords
  whole_.resize(bound_ + rows_ - 1, n);
  for (int v = 0; v < (bound_ + rows_) * columns_; ++v) {
    const int i = v / columns_, j = v % columns_;
    const Vec3 p = i < bound_ ? pose.rotation * air_.lattice().vertex(i, j)
                              : wake_.vertex(i - bound_, j) - pose.position_w;
    whole_.put(v, scale * p);
  }
  const double* g = wake_.circulation();
  const auto first = std::copy_n(g, (bound_ - 1) * n, whole_.circulation.begin());
  std::copy_n(g + (bound_ - 2) * n, n, first);
  air_.free_strengths(wake_, whole_.circulation.data() + bound_ * n);
}

// of the whole, between two rows of vertices
template <class T>
Sheet<T> RollUp<T>::part(int first, int last) const {
  Sheet<T> part;
  const auto copy = [&](const std::vector<T>& from, std::vector<T>& to, int end, int width) {
    to.assign(from.begin() + first * width, from.begin() + end * width);
  };
  part.rings = last - first, part.strips = wake_.strips;
  copy(whole_.x, part.x, last + 1, columns_);
  copy(whole_.y, part.y, last + 1, columns_);
  copy(whole_.z, part.z, last + 1, columns_);
  copy(whole_.circulation, part.circulation, last, wake_.strips);
  return part;
}

// ticks between two findings of an old row's far velocity
template <class T>
int RollUp<T>::every(int row) const {
  int every = 2;
  for (double age = 2.0 * wake_.detail; age <= age_[row] && every < Wake::kLongestPause; age *= 2) every *= 2;
  return every;
}

template <class T>
typename RollUp<T>::Rows RollUp<T>::due() const {
  Rows rows;
  for (int row = young_; row < rows_; ++row) {
    const double ago = wake_.found(row);
    if (ago == 0 || ago >= every(row)) rows.push_back(row);
  }
  return rows;
}

// one a vertex [m/s]
template <class T>
std::vector<Vec3> RollUp<T>::velocity(const Rows& rows, const Sheet<T>& by) const {
  const int count = static_cast<int>(rows.size()) * columns_;
  const double scale = air_.settings().core / air_.core();
  Points<T> points(count), induced(count);
  for (int v = 0; v < count; ++v) {
    const int at = (bound_ + rows[v / columns_]) * columns_ + v % columns_;
    points.x[v] = whole_.x[at], points.y[v] = whole_.y[at], points.z[v] = whole_.z[at];
  }
  induced_velocity(by, static_cast<T>(air_.settings().core), points, induced,
                   air_.settings().threads);
  std::vector<Vec3> velocity(count);
  // circulation / length, both in metres here and in chords there
  for (int v = 0; v < count; ++v) velocity[v] = scale * Vec3{induced.x[v], induced.y[v], induced.z[v]};
  return velocity;
}

template <class T>
void RollUp<T>::find_far() {
  const Rows rows = due();
  const int near = std::min(kNear, wake_.detail);
  const std::vector<Vec3> now = velocity(rows, part(bound_ + near, bound_ + rows_ - 1));
  for (size_t v = 0; v < now.size(); ++v) {
    const int row = rows[v / columns_], at = 3 * static_cast<int>(v % columns_);
    const double ago = wake_.found(row);
    double *far = wake_.far(row) + at, *drift = wake_.drift(row) + at;
    const double found[3] = {now[v].x, now[v].y, now[v].z};
    for (int i = 0; i < 3; ++i) {
      drift[i] = ago > 0 ? (found[i] - far[i]) / ago : 0;
      far[i] = found[i];
    }
  }
  for (int row : rows) wake_.found(row) = 0;
}

template <class T>
Vec3 RollUp<T>::far(int row, int j) const {
  if (row < young_) return {0, 0, 0};
  const double ago = wake_.found(row), *f = wake_.far(row) + 3 * j, *d = wake_.drift(row) + 3 * j;
  return {f[0] + ago * d[0], f[1] + ago * d[1], f[2] + ago * d[2]};
}

template <class T>
void RollUp<T>::move(const Rows& rows, const Sheet<T>& by, double elapsed) {
  if (rows.empty()) return;
  const std::vector<Vec3> near = velocity(rows, by);
  for (size_t v = 0; v < near.size(); ++v) {
    const int row = rows[v / columns_], j = static_cast<int>(v % columns_);
    const Vec3 all = near[v] + far(row, j) + air_.wind_w();
    wake_.set_vertex(row, j, wake_.vertex(row, j) + elapsed * all);
  }
}

template <class T>
void RollUp<T>::run(double elapsed) {
  Rows young(young_);
  std::iota(young.begin(), young.end(), 0);
  move(young, whole_, elapsed);
  if (young_ == rows_) return;
  find_far();
  // what was near when the velocity by all else was found is still near: its rows have come to lie
  // as many places further behind as there have been ticks
  std::vector<Rows> ago(Wake::kLongestPause);
  for (int row = young_; row < rows_; ++row) ago[static_cast<int>(wake_.found(row))].push_back(row);
  const int near = bound_ + std::min(kNear, wake_.detail);
  for (size_t ticks = 0; ticks < ago.size(); ++ticks) {
    move(ago[ticks], part(0, std::min<int>(near + ticks, bound_ + rows_ - 1)), elapsed);
  }
  for (int row = young_; row < rows_; ++row) wake_.found(row) += 1;
}

template class RollUp<float>;
template class RollUp<double>;

}  // namespace flaprig
