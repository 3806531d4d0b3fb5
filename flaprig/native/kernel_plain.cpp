// The innermost loop for every other processor: sixteen bytes at a time, which compilers turn into
// SSE2 or NEON.
#include <cmath>

#include "kernel.hpp"

namespace flaprig {
namespace {

template <class T>
struct Lanes {
  static constexpr int kSize = 16 / sizeof(T);
  typedef T Vector __attribute__((vector_size(16)));
  Vector v;
  static Lanes load(const T* p) {
    Lanes l;
    for (int i = 0; i < kSize; ++i) l.v[i] = p[i];
    return l;
  }
  static Lanes set(T s) {
    Lanes l;
    for (int i = 0; i < kSize; ++i) l.v[i] = s;
    return l;
  }
  void store(T* p) const {
    for (int i = 0; i < kSize; ++i) p[i] = v[i];
  }
};

template <class T>
inline Lanes<T> made(typename Lanes<T>::Vector v) {
  Lanes<T> l;
  l.v = v;
  return l;
}
template <class T>
inline Lanes<T> operator+(Lanes<T> a, Lanes<T> b) { return made<T>(a.v + b.v); }
template <class T>
inline Lanes<T> operator-(Lanes<T> a, Lanes<T> b) { return made<T>(a.v - b.v); }
template <class T>
inline Lanes<T> operator*(Lanes<T> a, Lanes<T> b) { return made<T>(a.v * b.v); }
// rounded once where the processor can
template <class T>
inline Lanes<T> fma(Lanes<T> a, Lanes<T> b, Lanes<T> c) { return made<T>(a.v * b.v + c.v); }
template <class T>
inline Lanes<T> fms(Lanes<T> a, Lanes<T> b, Lanes<T> c) { return made<T>(a.v * b.v - c.v); }
template <class T>
inline Lanes<T> max(Lanes<T> a, Lanes<T> b) { return made<T>(a.v > b.v ? a.v : b.v); }
template <class T>
inline Lanes<T> rcp(Lanes<T> a) { return made<T>(Lanes<T>::set(1).v / a.v); }
template <class T>
inline Lanes<T> rsqrt(Lanes<T> a) {
  Lanes<T> root;
  for (int i = 0; i < Lanes<T>::kSize; ++i) root.v[i] = std::sqrt(a.v[i]);
  return rcp(root);
}

#include "kernel_sweep.hpp"

}  // namespace

template <>
Kernel<float> plain_kernel() {
  return kernel_of<Lanes<float>, float>("128 bits");
}
template <>
Kernel<double> plain_kernel() {
  return kernel_of<Lanes<double>, double>("128 bits");
}

}  // namespace flaprig
