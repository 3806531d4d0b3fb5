// The roll-up's innermost loop for one instruction set: what all of them share.
//
// Plain data only: the files behind this are compiled for processors that may not be this one, and
// nothing inline may leak out of them.
#pragma once

namespace flaprig {

// squared distance below which a point lies on a vertex; floor of 1 + cos on an edge, a few roundings;
// what keeps 0/0 away
template <class T>
struct Limits;
template <>
struct Limits<float> {
  static constexpr float kDelta2 = 1e-14f, kFloor = 4.8e-7f, kTiny = 1e-30f;
};
template <>
struct Limits<double> {
  static constexpr double kDelta2 = 1e-40, kFloor = 8.9e-16, kTiny = 1e-200;
};

template <class T>
struct Edge {
  T soft;      // (core length)^2
  T strength;  // circulation / 4 pi
};

// A sheet: rows of vertices, and its edges in the order of the sweep: those along row k, then those
// from row k - 1 to it.
template <class T>
struct Sweep {
  int rows, columns;
  const T *x, *y, *z;
  const Edge<T>* edges;
};

// points that are worked on together, or their velocities: a vector's worth of each coordinate
template <class T>
struct Block {
  static constexpr int kMost = 64 / sizeof(T);
  T x[kMost], y[kMost], z[kMost];
};

template <class T>
struct Kernel {
  const char* name;
  int lanes;    // points in a block
  int scratch;  // numbers of scratch, aligned to 64 bytes, for each column
  void (*run)(const Sweep<T>& sweep, const Block<T>& points, Block<T>& velocity, T* scratch);
  // `rounds` fused multiply-adds of each of twelve vectors: how many operations that was
  double (*multiply_add)(long rounds);
};

template <class T>
Kernel<T> plain_kernel();
#if defined(__x86_64__)
template <class T>
Kernel<T> avx2_kernel();
template <class T>
Kernel<T> avx512_kernel();
#endif

}  // namespace flaprig
