#include "kernel_choice.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace flaprig {
namespace {

std::atomic<size_t> choice{0};

template <class T>
std::vector<Kernel<T>> find_kernels() {
  std::vector<Kernel<T>> kernels;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) kernels.push_back(avx512_kernel<T>());
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    kernels.push_back(avx2_kernel<T>());
  }
#endif
  kernels.push_back(plain_kernel<T>());
  return kernels;
}

template <class T>
const std::vector<Kernel<T>>& kernels() {
  static const std::vector<Kernel<T>> found = find_kernels<T>();
  return found;
}

// fastest of a few short runs, so that a thread that waits for its turn does not count
template <class T>
double multiply_add_rate(const Kernel<T>& kernel) {
  using Clock = std::chrono::steady_clock;
  constexpr long kRounds = 2000000;
  double best = 0;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const auto start = Clock::now();
    const double flops = kernel.multiply_add(kRounds);
    best = std::max(best, flops / std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

}  // namespace

template <class T>
Kernel<T> chosen_kernel() {
  return kernels<T>()[choice];
}
template Kernel<float> chosen_kernel();
template Kernel<double> chosen_kernel();

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const auto& kernel : kernels<float>()) names.emplace_back(kernel.name);
  return names;
}

bool use_kernel(const std::string& name) {
  const auto names = kernel_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return false;
  choice = static_cast<size_t>(found - names.begin());
  return true;
}

double fma_peak(bool single) {
  return single ? multiply_add_rate(chosen_kernel<float>())
                : multiply_add_rate(chosen_kernel<double>());
}

}  // namespace flaprig
