// Where the time goes: what the solver's phases took, on all threads together.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace flaprig {

enum class Phase { kRollUp, kWing, kLoads, kPlugin };

// seconds since the last reset, under "roll_up" (the wake moves itself), "wing" (the wake at the
// wing, and the circulation there), "loads", and "plugin": MuJoCo's calls of it, with those three that
// happen in them. The module and the plugin have clocks of their own. Nothing is counted before the
// first reset: reading the clock takes a part of a short step.
std::map<std::string, double> clocks();
void reset_clocks();

// counts from here to the end of its scope
class Stopwatch {
 public:
  explicit Stopwatch(Phase phase);
  ~Stopwatch();
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  Phase phase_;
  bool counts_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace flaprig
