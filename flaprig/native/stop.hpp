// Ends a run before it is done: asked for inside the solver's loops, so that one long step ends too.
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

namespace flaprig {

// what check_stop throws
struct Stopped : std::exception {
  const char* what() const noexcept override { return "the run was stopped"; }
};

// While it lives, check_stop on this thread, and on those that the pool lends to it, asks whether to
// go on. Where there is none, nothing is asked.
class Stop {
 public:
  // whether to stop; called on this thread only, ten times a second
  using Ask = std::function<bool()>;
  explicit Stop(Ask ask);
  ~Stop();
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  // of this thread, or nullptr
  static Stop* current();
  // for the owner: asks where it is time to
  void look();
  // throws Stopped when the run is to end
  void check();

  // lends it to another thread for a scope; nullptr lends nothing
  class Lent {
   public:
    explicit Lent(Stop* stop);
    ~Lent();
    Lent(const Lent&) = delete;
    Lent& operator=(const Lent&) = delete;

   private:
    Stop* before_;
  };

 private:
  using Clock = std::chrono::steady_clock;
  Ask ask_;
  std::thread::id owner_;
  Clock::time_point asked_;
  std::atomic<bool> stopped_{false};
  Lent here_;
};

inline void check_stop() {
  if (Stop* stop = Stop::current()) stop->check();
}

}  // namespace flaprig
