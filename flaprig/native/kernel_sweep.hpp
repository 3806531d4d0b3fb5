// The innermost loop over lanes of type V; included once by the file of each instruction set, inside
// of its anonymous namespace.
//
// V: kSize, load, store, set, +, -, *, fma(a, b, c) = a b + c,
// fms = a b - c, max, rcp = 1 / a, rsqrt = 1 / sqrt(a).

// from a vertex to the points, shared by the vertex's four edges
template <class V>
struct Arm {
  V x, y, z, inverse;  // the last one of the distance
};

template <class V, class T>
inline __attribute__((always_inline)) Arm<V> reach(T vx, T vy, T vz, V x, V y, V z) {
  Arm<V> arm = {x - V::set(vx), y - V::set(vy), z - V::set(vz), V::set(0)};
  arm.inverse = rsqrt(fma(arm.x, arm.x, fma(arm.y, arm.y, fma(arm.z, arm.z, V::set(Limits<T>::kDelta2)))));
  return arm;
}

// Biot-Savart's (1/|a| + 1/|b|) n / (|a||b| + a.b), smoothed by n^2 / (n^2 + soft), n = a x b: no
// cancellation far away. On the edge itself 1 + cos is lost to rounding, n^2 is not: without a floor
// their ratio would fling the vertex away.
template <class V, class T>
inline __attribute__((always_inline)) void add_edge(const Edge<T>& e, const Arm<V>& a,
                                                    const Arm<V>& b, V& u, V& v, V& w) {
  const V nx = fms(a.y, b.z, a.z * b.y);
  const V ny = fms(a.z, b.x, a.x * b.z);
  const V nz = fms(a.x, b.y, a.y * b.x);
  const V n2 = fma(nx, nx, fma(ny, ny, nz * nz));
  const V both = a.inverse * b.inverse;
  const V dot = fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
  const V facing = max(fma(dot, both, V::set(1)), V::set(Limits<T>::kFloor));
  const V above = (a.inverse + b.inverse) * both * (n2 * V::set(e.strength));
  const V below = fma(n2 + V::set(e.soft), facing, V::set(Limits<T>::kTiny));
  const V scale = above * rcp(below);
  u = fma(scale, nx, u);
  v = fma(scale, ny, v);
  w = fma(scale, nz, w);
}

template <class V, class T>
void sweep_block(const Sweep<T>& s, const Block<T>& points, Block<T>& velocity, T* scratch) {
  const V x = V::load(points.x), y = V::load(points.y), z = V::load(points.z);
  V u = V::set(0), v = V::set(0), w = V::set(0);
  auto* row = reinterpret_cast<Arm<V>*>(scratch);
  auto* last = row + s.columns;
  const Edge<T>* edge = s.edges;
  for (int k = 0; k < s.rows; ++k) {
    auto* const older = last;
    last = row, row = older;
    const int first = k * s.columns;
    for (int j = 0; j < s.columns; ++j) {
      row[j] = reach<V>(s.x[first + j], s.y[first + j], s.z[first + j], x, y, z);
    }
    for (int j = 0; j + 1 < s.columns; ++j) add_edge(*edge++, row[j], row[j + 1], u, v, w);
    for (int j = 0; k > 0 && j < s.columns; ++j) add_edge(*edge++, last[j], row[j], u, v, w);
  }
  u.store(velocity.x), v.store(velocity.y), w.store(velocity.z);
}

template <class V, class T>
double multiply_add(long rounds) {
  constexpr int kVectors = 12;
  V a[kVectors];
  for (int i = 0; i < kVectors; ++i) a[i] = V::set(static_cast<T>(1 + i));
  const V shrink = V::set(static_cast<T>(0.9999)), grow = V::set(static_cast<T>(1e-6));
  for (long r = 0; r < rounds; ++r) {
    for (int i = 0; i < kVectors; ++i) a[i] = fma(a[i], shrink, grow);
  }
  // a result that is read is not optimized away
  volatile T sink;
  T out[V::kSize];
  for (int i = 0; i < kVectors; ++i) {
    a[i].store(out);
    sink = out[0];
  }
  static_cast<void>(sink);
  return 2.0 * V::kSize * kVectors * static_cast<double>(rounds);
}

template <class V, class T>
Kernel<T> kernel_of(const char* name) {
  return {name, V::kSize, static_cast<int>(2 * sizeof(Arm<V>) / sizeof(T)), &sweep_block<V, T>,
          &multiply_add<V, T>};
}
