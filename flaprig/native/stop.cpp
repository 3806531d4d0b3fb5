#include "stop.hpp"

#include <utility>

namespace flaprig {
namespace {

// between two questions: asking takes Python's lock
constexpr std::chrono::milliseconds kPause(100);

thread_local Stop* here = nullptr;

}  // namespace

Stop::Lent::Lent(Stop* stop) : before_(here) { here = stop; }

Stop::Lent::~Lent() { here = before_; }

Stop::Stop(Ask ask)
    : ask_(std::move(ask)), owner_(std::this_thread::get_id()), asked_(Clock::now()), here_(this) {}

Stop::~Stop() = default;

Stop* Stop::current() { return here; }

void Stop::look() {
  const Clock::time_point now = Clock::now();
  if (now - asked_ < kPause) return;
  asked_ = now;
  if (ask_()) stopped_ = true;
}

void Stop::check() {
  if (std::this_thread::get_id() == owner_) look();
  if (stopped_) throw Stopped();
}

}  // namespace flaprig
