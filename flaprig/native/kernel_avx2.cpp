// The innermost loop for processors with AVX2 and FMA. Compiled with their flags: nothing but the
// kernels may be in here.
#include "kernel.hpp"

#if defined(__x86_64__)
#include <immintrin.h>

namespace flaprig {
namespace {

struct F {
  static constexpr int kSize = 8;
  __m256 v;
  static F load(const float* p) { return {_mm256_loadu_ps(p)}; }
  static F set(float s) { return {_mm256_set1_ps(s)}; }
  void store(float* p) const { _mm256_storeu_ps(p, v); }
};
inline F operator+(F a, F b) { return {_mm256_add_ps(a.v, b.v)}; }
inline F operator-(F a, F b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline F operator*(F a, F b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline F fma(F a, F b, F c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline F fms(F a, F b, F c) { return {_mm256_fmsub_ps(a.v, b.v, c.v)}; }
inline F max(F a, F b) { return {_mm256_max_ps(a.v, b.v)}; }
// 12 bits and one step of Newton's: the rest of a float
inline F rcp(F a) {
  const __m256 r = _mm256_rcp_ps(a.v);
  return {_mm256_fmadd_ps(r, _mm256_fnmadd_ps(a.v, r, _mm256_set1_ps(1.0f)), r)};
}
inline F rsqrt(F a) {
  const __m256 r = _mm256_rsqrt_ps(a.v), half = _mm256_mul_ps(_mm256_set1_ps(0.5f), r);
  const __m256 rest = _mm256_fnmadd_ps(_mm256_mul_ps(a.v, r), r, _mm256_set1_ps(1.0f));
  return {_mm256_fmadd_ps(half, rest, r)};
}

struct D {
  static constexpr int kSize = 4;
  __m256d v;
  static D load(const double* p) { return {_mm256_loadu_pd(p)}; }
  static D set(double s) { return {_mm256_set1_pd(s)}; }
  void store(double* p) const { _mm256_storeu_pd(p, v); }
};
inline D operator+(D a, D b) { return {_mm256_add_pd(a.v, b.v)}; }
inline D operator-(D a, D b) { return {_mm256_sub_pd(a.v, b.v)}; }
inline D operator*(D a, D b) { return {_mm256_mul_pd(a.v, b.v)}; }
inline D fma(D a, D b, D c) { return {_mm256_fmadd_pd(a.v, b.v, c.v)}; }
inline D fms(D a, D b, D c) { return {_mm256_fmsub_pd(a.v, b.v, c.v)}; }
inline D max(D a, D b) { return {_mm256_max_pd(a.v, b.v)}; }
inline D rcp(D a) { return {_mm256_div_pd(_mm256_set1_pd(1.0), a.v)}; }
inline D rsqrt(D a) { return {_mm256_div_pd(_mm256_set1_pd(1.0), _mm256_sqrt_pd(a.v))}; }

#include "kernel_sweep.hpp"

}  // namespace

template <>
Kernel<float> avx2_kernel() {
  return kernel_of<F, float>("AVX2");
}
template <>
Kernel<double> avx2_kernel() {
  return kernel_of<D, double>("AVX2");
}

}  // namespace flaprig
#endif
