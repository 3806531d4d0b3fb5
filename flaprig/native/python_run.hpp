// How Python calls what takes long: without its lock, stopped by Ctrl-C, and then as if not called.
#pragma once

#include <nanobind/nanobind.h>

#include <algorithm>
#include <vector>

#include "stop.hpp"

namespace flaprig {

// without Python's lock; a signal's handler that raises, as Ctrl-C's does, stops the work
template <class Work>
void without_lock(Work work) {
  bool stopped = false;
  {
    nanobind::gil_scoped_release release;
    const Stop stop([] {
      nanobind::gil_scoped_acquire acquire;
      return PyErr_CheckSignals() != 0;
    });
    try {
      work();
    } catch (const Stopped&) {
      stopped = true;
    }
  }
  if (stopped) throw nanobind::python_error();
}

// numbers that are as they were when their change is not kept
class Change {
 public:
  Change(double* data, size_t size) : data_(data), before_(data, data + size) {}
  ~Change() {
    if (!kept_) std::copy(before_.begin(), before_.end(), data_);
  }
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;
  void keep() { kept_ = true; }

 private:
  double* data_;
  std::vector<double> before_;
  bool kept_ = false;
};

}  // namespace flaprig
