#include "induced.hpp"

#include <algorithm>
#include <cstdint>

#include "kernel_choice.hpp"
#include "pool.hpp"
#include "stop.hpp"

namespace flaprig {
namespace {

template <class T>
Edge<T> edge_between(const Sheet<T>& s, int a, int b, T circulation, T core) {
  constexpr T kQuarterPi = static_cast<T>(0.07957747154594767);
  const T ex = s.x[b] - s.x[a], ey = s.y[b] - s.y[a], ez = s.z[b] - s.z[a];
  const T length2 = ex * ex + ey * ey + ez * ez;
  return {core * core * length2, kQuarterPi * circulation};
}

// edges carry differences of ring strengths and each is there once, in the order of the sweep
template <class T>
void edges_of(const Sheet<T>& s, T core, std::vector<Edge<T>>& edges) {
  const int strips = s.strips, columns = strips + 1;
  edges.clear();
  for (int k = 0; k <= s.rings; ++k) {
    const int first = k * columns;
    const T* ahead = k > 0 ? &s.circulation[(k - 1) * strips] : nullptr;
    const T* here = k < s.rings ? &s.circulation[k * strips] : nullptr;
    for (int j = 0; j < strips; ++j) {
      const T g = (here ? here[j] : T(0)) - (ahead ? ahead[j] : T(0));
      edges.push_back(edge_between(s, first + j, first + j + 1, g, core));
    }
    for (int j = 0; ahead && j < columns; ++j) {
      const T g = (j > 0 ? ahead[j - 1] : T(0)) - (j < strips ? ahead[j] : T(0));
      edges.push_back(edge_between(s, first - columns + j, first + j, g, core));
    }
  }
}

template <class T>
T* aligned(std::vector<T>& memory, size_t count) {
  constexpr size_t kAlign = 64;
  memory.resize(count + kAlign / sizeof(T));
  const auto at = reinterpret_cast<std::uintptr_t>(memory.data());
  return memory.data() + ((kAlign - at % kAlign) % kAlign) / sizeof(T);
}

template <class T>
void one_block(const Kernel<T>& kernel, const Sweep<T>& sweep, const Points<T>& points, int start,
               Points<T>& velocity) {
  static thread_local std::vector<T> memory;
  Block<T> block, result;
  const int n = std::min(kernel.lanes, points.size() - start);
  for (int p = 0; p < kernel.lanes; ++p) {
    const int q = start + std::min(p, n - 1);  // idle lanes repeat the last point
    block.x[p] = points.x[q], block.y[p] = points.y[q], block.z[p] = points.z[q];
  }
  const size_t scratch = static_cast<size_t>(kernel.scratch) * sweep.columns;
  kernel.run(sweep, block, result, aligned(memory, scratch));
  std::copy_n(result.x, n, velocity.x.begin() + start);
  std::copy_n(result.y, n, velocity.y.begin() + start);
  std::copy_n(result.z, n, velocity.z.begin() + start);
}

template <class T>
void all_blocks(const Sheet<T>& sheet, T core, const Points<T>& points, Points<T>& velocity,
                int threads) {
  const Kernel<T> kernel = chosen_kernel<T>();
  static thread_local std::vector<Edge<T>> edges;
  edges_of(sheet, core, edges);
  const Sweep<T> sweep = {sheet.rings + 1, sheet.strips + 1, sheet.x.data(),
                          sheet.y.data(),  sheet.z.data(),   edges.data()};
  const int count = (points.size() + kernel.lanes - 1) / kernel.lanes;
  in_parallel(threads, count, [&](int block) {
    check_stop();
    one_block(kernel, sweep, points, block * kernel.lanes, velocity);
  });
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
  all_blocks(sheet, core, points, velocity, threads);
}

void induced_velocity(const Sheet<double>& sheet, double core, const Points<double>& points,
                      Points<double>& velocity, int threads) {
  all_blocks(sheet, core, points, velocity, threads);
}

}  // namespace flaprig
