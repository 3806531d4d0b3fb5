#include "clock.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace flaprig {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> counting{false};
std::array<std::atomic<std::int64_t>, 4> nanoseconds{};

}  // namespace

std::map<std::string, double> clocks() {
  const auto seconds = [](Phase p) { return 1e-9 * static_cast<double>(nanoseconds[int(p)]); };
  return {{"roll_up", seconds(Phase::kRollUp)},
          {"wing", seconds(Phase::kWing)},
          {"loads", seconds(Phase::kLoads)},
          {"plugin", seconds(Phase::kPlugin)}};
}

void reset_clocks() {
  for (auto& n : nanoseconds) n = 0;
  counting = true;
}

Stopwatch::Stopwatch(Phase phase) : phase_(phase), counts_(counting) {
  if (counts_) start_ = Clock::now();
}

Stopwatch::~Stopwatch() {
  if (!counts_) return;
  nanoseconds[int(phase_)] +=
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start_).count();
}

}  // namespace flaprig
