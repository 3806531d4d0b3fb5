// Whether the numbers of a wake are those of a run: the state is MuJoCo's and the user's, who save,
// perturb and exchange it.

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "wake.hpp"

namespace flaprig {
namespace {

// of a clock [s]: far beyond any step that a model may have, far from overflow
constexpr double kShortestTime = 1e-12, kLongestTime = 1e6;

// false for NaN
bool within(double x, double low, double high) { return x >= low && x <= high; }

// within the range of int
bool whole(double x, double low, double high) {
  return within(x, low, high) && x == static_cast<int>(x);
}

// of a number from 1: nothing in its mantissa. This is asked of each row in every step
bool is_power_of_two(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return (bits & ((std::uint64_t{1} << 52) - 1)) == 0;
}

std::string clause(const char* name, double value, const char* allowed) {
  char text[200];
  std::snprintf(text, sizeof text, "%s is %.6g, must be %s", name, value, allowed);
  return text;
}

std::string count_clause(const char* name, double value, int low, int high) {
  char allowed[80];
  std::snprintf(allowed, sizeof allowed, "a whole number from %d to %d", low, high);
  return clause(name, value, allowed);
}

}  // namespace

std::string Wake::fault() const {
  Wake& w = const_cast<Wake&>(*this);
  if (w.started() != 0 && w.started() != 1) return clause("started", w.started(), "0 or 1");
  const int most = w.started() != 0 ? capacity : 0;
  if (!whole(w.rows(), 0, most)) return count_clause("rows", w.rows(), 0, most);
  std::string fault = fault_of_clock();
  if (fault.empty()) fault = fault_of_ticks();
  if (fault.empty()) fault = fault_of_found();
  return fault;
}

std::string Wake::fault_of_clock() const {
  Wake& w = const_cast<Wake&>(*this);
  if (w.started() == 0) {
    if (w.age() != 0) return clause("age", w.age(), "0 before the first row");
    if (w.interval() != 0) return clause("interval", w.interval(), "0 before the first row");
    return {};
  }
  if (!within(w.age(), 0, kLongestTime)) return clause("age", w.age(), "0 to 1e6 s");
  if (!within(w.interval(), kShortestTime, kLongestTime)) {
    return clause("interval", w.interval(), "1e-12 to 1e6 s");
  }
  return {};
}

// one where rows do not merge, else powers of two that rise with the row's age; all but the oldest
// row began to be shed within the longest wake
std::string Wake::fault_of_ticks() const {
  Wake& w = const_cast<Wake&>(*this);
  const int n = static_cast<int>(w.rows());
  double newer = 0, last = 1;
  for (int row = 0; row < n; ++row) {
    const double ticks = w.ticks()[row];
    const bool merged = within(ticks, last, 2.0 * longest) && is_power_of_two(ticks);
    if (!merged || (detail == 0 && ticks != 1)) {
      return clause("ticks of a row", ticks,
                    detail == 0 ? "1" : "a power of two, not below those of newer rows");
    }
    if (newer >= longest) return count_clause("ticks of all rows", newer + ticks, 0, longest);
    newer += ticks;
    last = ticks;
  }
  return {};
}

std::string Wake::fault_of_found() const {
  Wake& w = const_cast<Wake&>(*this);
  if (w.started() == 0 || old_rows() == 0) return {};
  for (int row = detail; row <= static_cast<int>(w.rows()); ++row) {
    const double ago = w.found(row);
    if (!whole(ago, 0, kLongestPause)) {
      return count_clause("ticks since a row's velocity was found", ago, 0, kLongestPause);
    }
  }
  return {};
}

}  // namespace flaprig
