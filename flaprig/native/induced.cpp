#include "induced.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>
#include <thread>

// one binary runs everywhere: the loader picks the widest vectors that the processor has
#if defined(__x86_64__) && defined(__linux__) && defined(__GLIBC__) && defined(__GNUC__) && \
    !defined(__clang__)
#define FLAPRIG_MULTIVERSION \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FLAPRIG_MULTIVERSION
#endif
#define FLAPRIG_INLINE inline __attribute__((always_inline))

namespace flaprig {
namespace {

constexpr int kLanes = 64;  // points worked on together; fits the first-level cache

// from one vertex to each point of the block, shared by the vertex's four edges
template <class T>
struct alignas(64) Arm {
  T x[kLanes], y[kLanes], z[kLanes], length[kLanes];
};

template <class T>
struct alignas(64) Block {
  T x[kLanes], y[kLanes], z[kLanes];  // points
  T u[kLanes], v[kLanes], w[kLanes];  // velocities
};

template <class T>
FLAPRIG_INLINE void reach(T vx, T vy, T vz, const Block<T>& block, Arm<T>& arm) {
  for (int p = 0; p < kLanes; ++p) {
    const T x = block.x[p] - vx, y = block.y[p] - vy, z = block.z[p] - vz;
    arm.x[p] = x, arm.y[p] = y, arm.z[p] = z;
    arm.length[p] = std::sqrt(x * x + y * y + z * z);
  }
}

// adds the velocity of the edge a -> b. With n = a x b and d = a.b, Biot-Savart's
// (|a| + |b|)(1 - d/|a||b|)/(n^2 + soft) is written as (|a| + |b|) n^2/((n^2 + soft)|a||b|
// (|a||b| + d)): no cancellation far away, where single precision would lose it.
template <class T>
FLAPRIG_INLINE void add_edge(const Arm<T>& a, const Arm<T>& b, T strength, T soft, Block<T>& block) {
  constexpr T kEpsilon = std::numeric_limits<T>::epsilon();
  constexpr T kTiny = static_cast<T>(1e-22);  // an end of the edge itself: 0/0 becomes 0
  for (int p = 0; p < kLanes; ++p) {
    const T nx = a.y[p] * b.z[p] - a.z[p] * b.y[p];
    const T ny = a.z[p] * b.x[p] - a.x[p] * b.z[p];
    const T nz = a.x[p] * b.y[p] - a.y[p] * b.x[p];
    const T d = a.x[p] * b.x[p] + a.y[p] * b.y[p] + a.z[p] * b.z[p];
    const T n2 = nx * nx + ny * ny + nz * nz;
    const T lengths = a.length[p] * b.length[p];
    // on the edge itself |a||b| + d is lost to rounding, n^2 is not: without a floor their ratio
    // would fling the vertex away
    const T facing = std::max(lengths + d, kEpsilon * lengths);
    const T scale = strength * (a.length[p] + b.length[p]) * n2 /
                    ((n2 + soft) * lengths * facing + kTiny);
    block.u[p] += scale * nx;
    block.v[p] += scale * ny;
    block.w[p] += scale * nz;
  }
}

template <class T>
FLAPRIG_INLINE T squared_length(const Sheet<T>& s, int a, int b) {
  const T x = s.x[b] - s.x[a], y = s.y[b] - s.y[a], z = s.z[b] - s.z[a];
  return x * x + y * y + z * z;
}

template <class T>
FLAPRIG_INLINE void sweep_sheet(const Sheet<T>& sheet, T core2, Block<T>& block, Arm<T>* arms) {
  const int strips = sheet.strips, columns = strips + 1;
  constexpr T kQuarterPi = static_cast<T>(0.07957747154594767);
  Arm<T>*row = arms, *last = arms + columns;
  for (int k = 0; k <= sheet.rings; ++k) {
    std::swap(row, last);
    const int first = k * columns;
    for (int j = 0; j < columns; ++j) {
      const int v = first + j;
      reach(sheet.x[v], sheet.y[v], sheet.z[v], block, row[j]);
    }
    const T* ahead = k > 0 ? &sheet.circulation[(k - 1) * strips] : nullptr;
    const T* here = k < sheet.rings ? &sheet.circulation[k * strips] : nullptr;
    for (int j = 0; j < strips; ++j) {  // along the span
      const T g = (here ? here[j] : T(0)) - (ahead ? ahead[j] : T(0));
      const T soft = core2 * squared_length(sheet, first + j, first + j + 1);
      add_edge(row[j], row[j + 1], kQuarterPi * g, soft, block);
    }
    if (!ahead) continue;
    for (int j = 0; j < columns; ++j) {  // from the last row to this one
      const T g = (j > 0 ? ahead[j - 1] : T(0)) - (j < strips ? ahead[j] : T(0));
      const T soft = core2 * squared_length(sheet, first - columns + j, first + j);
      add_edge(last[j], row[j], kQuarterPi * g, soft, block);
    }
  }
}

template <class T>
FLAPRIG_INLINE void one_block(const Sheet<T>& sheet, T core, const Points<T>& points,
                              Points<T>& velocity, int start, Arm<T>* arms) {
  Block<T> block;
  const int n = std::min(kLanes, points.size() - start);
  for (int p = 0; p < kLanes; ++p) {
    const int q = start + std::min(p, n - 1);  // idle lanes repeat the last point
    block.x[p] = points.x[q], block.y[p] = points.y[q], block.z[p] = points.z[q];
    block.u[p] = block.v[p] = block.w[p] = 0;
  }
  sweep_sheet(sheet, core * core, block, arms);
  for (int p = 0; p < n; ++p) {
    velocity.x[start + p] = block.u[p];
    velocity.y[start + p] = block.v[p];
    velocity.z[start + p] = block.w[p];
  }
}

FLAPRIG_MULTIVERSION void block_f32(const Sheet<float>& s, float core, const Points<float>& p,
                                    Points<float>& v, int start, Arm<float>* arms) {
  one_block(s, core, p, v, start, arms);
}

FLAPRIG_MULTIVERSION void block_f64(const Sheet<double>& s, double core, const Points<double>& p,
                                    Points<double>& v, int start, Arm<double>* arms) {
  one_block(s, core, p, v, start, arms);
}

// every stride-th block, beginning with the given one
template <class T, class Work>
void blocks(const Sheet<T>& sheet, const Points<T>& points, int first, int stride, Work work) {
  static thread_local std::vector<Arm<T>> arms;
  arms.resize(2 * (sheet.strips + 1));
  for (int b = first; b * kLanes < points.size(); b += stride) work(b * kLanes, arms.data());
}

template <class T, class Work>
void all_blocks(const Sheet<T>& sheet, const Points<T>& points, int threads, Work work) {
  const int count = (points.size() + kLanes - 1) / kLanes;
  const int workers = std::clamp(threads, 1, std::max(1, count / 2));
  std::vector<std::thread> pool;
  for (int t = 1; t < workers; ++t) {
    const auto share = [&, t] { blocks(sheet, points, t, workers, work); };
    try {
      pool.emplace_back(share);
    } catch (const std::system_error&) {
      share();  // no thread to be had: the same work, here
    }
  }
  blocks(sheet, points, 0, workers, work);
  for (auto& thread : pool) thread.join();
}

}  // namespace

template <class T>
void Sheet<T>::resize(int rings_, int strips_) {
  rings = rings_, strips = strips_;
  const size_t vertices = static_cast<size_t>(rings + 1) * (strips + 1);
  x.resize(vertices), y.resize(vertices), z.resize(vertices);
  circulation.resize(static_cast<size_t>(rings) * strips);
}
template struct Sheet<float>;
template struct Sheet<double>;

void induced_velocity(const Sheet<float>& sheet, float core, const Points<float>& points,
                      Points<float>& velocity, int threads) {
  all_blocks(sheet, points, threads, [&](int start, Arm<float>* arms) {
    block_f32(sheet, core, points, velocity, start, arms);
  });
}

void induced_velocity(const Sheet<double>& sheet, double core, const Points<double>& points,
                      Points<double>& velocity, int threads) {
  all_blocks(sheet, points, threads, [&](int start, Arm<double>* arms) {
    block_f64(sheet, core, points, velocity, start, arms);
  });
}

}  // namespace flaprig
