// The solver in Python: flaprig.native._native, thin and unchecked beyond shapes.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "clock.hpp"
#include "coefficients.hpp"
#include "drive.hpp"
#include "induced.hpp"
#include "kernel_choice.hpp"
#include "python_run.hpp"
#include "quasi_steady.hpp"
#include "settings.hpp"
#include "uvlm.hpp"

namespace nb = nanobind;
using namespace flaprig;

namespace {

using In = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using State = nb::ndarray<double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Out = nb::ndarray<nb::numpy, double>;

Out new_array(std::initializer_list<size_t> shape, double** data) {
  size_t n = 1;
  for (size_t s : shape) n *= s;
  *data = new double[n > 0 ? n : 1]();
  nb::capsule owner(*data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  return Out(*data, shape, owner);
}

Model model_named(const std::string& name) {
  for (int i = 0; i < 2; ++i) {
    if (name == kModelNames[i]) return static_cast<Model>(i);
  }
  throw std::invalid_argument("model must be flaprig.quasi_steady or flaprig.uvlm, got " + name);
}

void require(bool ok, const char* what) {
  if (!ok) throw std::invalid_argument(what);
}

class PyAir {
 public:
  PyAir(const std::string& model, const Attributes& attributes)
      : model_(model), attributes_(attributes) {
    const Specification specification = read_specification(model_named(model), attributes);
    without_lock([&] { air_ = make_air(specification); });
    uvlm_ = dynamic_cast<Uvlm*>(air_.get());
  }

  // what copy and pickle make it from again: it has no memory of its own
  nb::tuple arguments() const { return nb::make_tuple(model_, attributes_); }

  int state_size() const { return air_->state_size(); }
  double reference_radius() const { return air_->reference_radius(); }

  Out added_mass() const {
    double* data;
    Out out = new_array({3, 3}, &data);
    std::copy(air_->added_mass().begin(), air_->added_mass().end(), data);
    return out;
  }

  nb::tuple run(State state, double dt, In position, In rotation, In twist, In twist_rate) {
    const MotionArrays motion = arrays(dt, position, rotation, twist, twist_rate);
    require_step(dt);
    check(state);
    const size_t n = motion.n;
    double *base, *extra, *added;
    Out a = new_array({n, 6}, &base), b = new_array({n, 6}, &extra), c = new_array({n, 6}, &added);
    Change change(state.data(), state.size());
    receive(state.data());
    without_lock([&] { drive(*air_, state.data(), motion, base, extra, added); });
    change.keep();
    return nb::make_tuple(a, b, c);
  }

  // `count` motions one after the other in the arrays; states (count * state_size)
  nb::tuple run_batch(State states, int count, double dt, In position, In rotation, In twist,
                      In twist_rate, int threads) {
    MotionArrays motions = arrays(dt, position, rotation, twist, twist_rate);
    require_step(dt);
    const size_t n = motions.n;
    require(count > 0 && n % count == 0, "the instants must be a whole number per motion");
    require(states.size() == size_t(count) * state_size(), "states have the wrong length");
    motions.n /= count;
    double *base, *extra, *added;
    Out a = new_array({n, 6}, &base), b = new_array({n, 6}, &extra), c = new_array({n, 6}, &added);
    Change change(states.data(), states.size());
    for (int k = 0; k < count; ++k) receive(states.data() + size_t(k) * state_size());
    without_lock([&] {
      drive_batch(*air_, count, states.data(), motions, base, extra, added, threads);
    });
    change.keep();
    return nb::make_tuple(a, b, c);
  }

  // bound circulation (chordwise, spanwise) at one motion
  Out circulation(State state, In position, In rotation, In twist, In twist_rate) {
    const MotionArrays motion = arrays(0, position, rotation, twist, twist_rate);
    require(motion.n == 1, "circulation takes one motion");
    const std::vector<double> numbers = received(state);
    const std::vector<double> g = uvlm().circulation(numbers.data(), motion_at(motion, 0));
    const Lattice& l = uvlm().lattice();
    double* data;
    Out out = new_array({size_t(l.chordwise()), size_t(l.spanwise())}, &data);
    std::copy(g.begin(), g.end(), data);
    return out;
  }

  // as the last tick left it
  Out bound_circulation(State state) {
    std::vector<double> numbers = received(state);
    Wake w = uvlm().wake(numbers.data());
    double* data;
    Out out = new_array({size_t(w.panels / w.strips), size_t(w.strips)}, &data);
    std::copy_n(w.circulation(), w.panels, data);
    return out;
  }

  nb::tuple wake(State state) {
    std::vector<double> numbers = received(state);
    Wake w = uvlm().wake(numbers.data());
    const size_t rows = static_cast<size_t>(w.rows()), n = w.strips;
    const size_t vertex_rows = w.started() != 0 ? rows + 1 : 0;
    double *vertices, *strengths;
    Out a = new_array({vertex_rows, n + 1, 3}, &vertices), b = new_array({rows, n}, &strengths);
    std::copy_n(w.vertices(), vertex_rows * (n + 1) * 3, vertices);
    std::copy_n(w.strengths(), rows * n, strengths);
    return nb::make_tuple(a, b);
  }

  Out lattice() {
    const Lattice& l = uvlm().lattice();
    double* data;
    Out out = new_array({size_t(l.chordwise() + 1), size_t(l.spanwise() + 1), 3}, &data);
    for (int i = 0; i <= l.chordwise(); ++i) {
      for (int j = 0; j <= l.spanwise(); ++j) {
        const Vec3 v = l.vertex(i, j);
        *data++ = v.x, *data++ = v.y, *data++ = v.z;
      }
    }
    return out;
  }

  nb::tuple coefficients(double alpha) {
    auto* model = dynamic_cast<QuasiSteady*>(air_.get());
    require(model, "coefficients belong to flaprig.quasi_steady");
    const LiftDrag c = model->coefficients(alpha);
    return nb::make_tuple(c.lift, c.drag);
  }

 private:
  Uvlm& uvlm() const {
    require(uvlm_, "only flaprig.uvlm has a wake");
    return *uvlm_;
  }
  void check(const State& state) const {
    require(static_cast<int>(state.size()) == state_size(), "state has the wrong length");
  }
  static void require_step(double dt) {
    if (dt > 0 && std::isfinite(dt)) return;
    throw std::invalid_argument("dt must be a finite number of seconds above 0, got " +
                                std::to_string(dt));
  }
  // a state from Python: one that is none of a run's is emptied, with a warning
  void receive(double* state) const {
    const std::string fault = make_sound(*air_, state, 0);
    if (fault.empty()) return;
    const std::string text = model_ + ": the state is none that a run leaves behind (" + fault +
                             "); its wake is cleared";
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw nb::python_error();
  }
  // a copy, for those that only read
  std::vector<double> received(const State& state) const {
    require(uvlm_, "only flaprig.uvlm has a wake");
    check(state);
    std::vector<double> numbers(state.data(), state.data() + state.size());
    receive(numbers.data());
    return numbers;
  }
  static MotionArrays arrays(double dt, In p, In r, In t, In a) {
    const size_t n = p.size() / 3;
    require(p.size() == 3 * n && r.size() == 9 * n && t.size() == 6 * n && a.size() == 6 * n,
            "position (n, 3), rotation (n, 3, 3), twist (n, 6), twist_rate (n, 6) must agree in n");
    return {static_cast<int>(n), dt, p.data(), r.data(), t.data(), a.data()};
  }
  std::string model_;
  Attributes attributes_;
  std::unique_ptr<Air> air_;
  Uvlm* uvlm_ = nullptr;
};

// velocity at points (n, 3) of a sheet: vertices (k + 1, s + 1, 3), circulation (k, s)
Out sheet_velocity(In vertices, In circulation, double core, In points, bool single, int threads) {
  require(circulation.ndim() == 2 && vertices.ndim() == 3, "vertices (k+1, s+1, 3), rings (k, s)");
  const int k = static_cast<int>(circulation.shape(0)), s = static_cast<int>(circulation.shape(1));
  require(vertices.shape(0) == size_t(k + 1) && vertices.shape(1) == size_t(s + 1) &&
              vertices.shape(2) == 3 && points.size() % 3 == 0,
          "vertices (k+1, s+1, 3), rings (k, s), points (n, 3)");
  double* data;
  const size_t n = points.size() / 3;
  Out out = new_array({n, 3}, &data);
  const auto fill = [&](auto zero) {
    using T = decltype(zero);
    Sheet<T> sheet;
    sheet.resize(k, s);
    for (size_t v = 0; v < sheet.x.size(); ++v) {
      const double* p = vertices.data() + 3 * v;
      sheet.x[v] = T(p[0]), sheet.y[v] = T(p[1]), sheet.z[v] = T(p[2]);
    }
    for (int r = 0; r < k * s; ++r) sheet.circulation[r] = T(circulation.data()[r]);
    Points<T> at(static_cast<int>(n)), velocity(static_cast<int>(n));
    for (size_t i = 0; i < n; ++i) {
      const double* p = points.data() + 3 * i;
      at.x[i] = T(p[0]), at.y[i] = T(p[1]), at.z[i] = T(p[2]);
    }
    without_lock([&] { induced_velocity(sheet, T(core), at, velocity, threads); });
    for (size_t i = 0; i < n; ++i) {
      data[3 * i] = velocity.x[i], data[3 * i + 1] = velocity.y[i], data[3 * i + 2] = velocity.z[i];
    }
  };
  if (single) {
    fill(float{});
  } else {
    fill(double{});
  }
  return out;
}

}  // namespace

NB_MODULE(_native, m) {
  nb::set_leak_warnings(false);
  nb::class_<PyAir>(m, "Air")
      .def(nb::init<const std::string&, const Attributes&>(), nb::arg("model"),
           nb::arg("attributes"))
      .def("__reduce__",
           [](nb::handle self) {
             return nb::make_tuple(self.type(), nb::cast<const PyAir&>(self).arguments());
           })
      .def_prop_ro("state_size", &PyAir::state_size)
      .def_prop_ro("reference_radius", &PyAir::reference_radius)
      .def_prop_ro("added_mass", &PyAir::added_mass, nb::rv_policy::move)
      .def_prop_ro("lattice", &PyAir::lattice, nb::rv_policy::move)
      .def("run", &PyAir::run, nb::arg("state"), nb::arg("dt"), nb::arg("position"),
           nb::arg("rotation"), nb::arg("twist"), nb::arg("twist_rate"))
      .def("run_batch", &PyAir::run_batch, nb::arg("states"), nb::arg("count"), nb::arg("dt"),
           nb::arg("position"), nb::arg("rotation"), nb::arg("twist"), nb::arg("twist_rate"),
           nb::arg("threads") = 1)
      .def("circulation", &PyAir::circulation)
      .def("bound_circulation", &PyAir::bound_circulation)
      .def("wake", &PyAir::wake)
      .def("coefficients", &PyAir::coefficients);
  m.def("sheet_velocity", &sheet_velocity, nb::arg("vertices"), nb::arg("circulation"),
        nb::arg("core"), nb::arg("points"), nb::arg("single") = false, nb::arg("threads") = 1);
  m.def("kernel_names", &kernel_names);
  m.def("kernel_name", [] { return std::string(chosen_kernel<float>().name); });
  m.def("use_kernel", [](const std::string& name) {
    if (!use_kernel(name)) throw std::invalid_argument("no kernel here is called " + name);
  });
  m.def("fma_peak", &fma_peak, nb::arg("single") = true,
        nb::call_guard<nb::gil_scoped_release>());
  m.def("clocks", &clocks);
  m.def("reset_clocks", &reset_clocks);
  // reads and checks only; the number of doubles that the model would remember
  m.def("check_attributes", [](const std::string& model, const Attributes& attributes) {
    return state_size(read_specification(model_named(model), attributes));
  });
  m.def("attribute_names", [](const std::string& model) {
    const auto& names = attribute_names(model_named(model));
    return std::vector<std::string>(names.begin(), names.end());
  });
}
