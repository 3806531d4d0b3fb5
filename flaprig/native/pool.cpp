#include "pool.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "stop.hpp"

namespace flaprig {
namespace {

class Pool {
 public:
  void run(int threads, int count, const std::function<void(int)>& work) {
    if (busy_.exchange(true)) {
      for (int i = 0; i < count; ++i) work(i);
      return;
    }
    try {
      share(std::min(threads, count) - 1, count, work);
    } catch (...) {
      busy_ = false;
      throw;
    }
    busy_ = false;
  }

 private:
  void share(int helpers, int count, const std::function<void(int)>& work) {
    hire(helpers);
    {
      std::lock_guard<std::mutex> lock(mutex_);
      next_ = 0, count_ = count, work_ = &work;
      error_ = nullptr, stop_ = Stop::current();
      wanted_ = running_ = std::min<int>(helpers, workers_.size());
      ++call_;
    }
    start_.notify_all();
    take();
    wait_for_helpers();
    if (error_) std::rethrow_exception(error_);
  }

  // the helpers have what is on our stack, and cannot ask for themselves whether to stop
  void wait_for_helpers() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!done_.wait_for(lock, std::chrono::milliseconds(50), [this] { return running_ == 0; })) {
      if (!stop_) continue;
      lock.unlock();
      stop_->look();
      lock.lock();
    }
  }

  // no thread to be had: those there are do the work
  void hire(int helpers) {
    while (static_cast<int>(workers_.size()) < helpers) {
      try {
        workers_.emplace_back([this] { wait(); });
        workers_.back().detach();
      } catch (const std::system_error&) {
        return;
      }
    }
  }

  void wait() {
    long seen = 0;
    for (;;) {
      {
        std::unique_lock<std::mutex> lock(mutex_);
        start_.wait(lock, [&] { return call_ != seen && wanted_ > 0; });
        seen = call_;
        --wanted_;
      }
      take();
      std::lock_guard<std::mutex> lock(mutex_);
      if (--running_ == 0) done_.notify_one();
    }
  }

  // the first that fails ends it for all
  void take() {
    const Stop::Lent lent(stop_);
    try {
      for (int i = next_++; i < count_; i = next_++) (*work_)(i);
    } catch (...) {
      next_ = count_;
      std::lock_guard<std::mutex> lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }

  std::atomic<bool> busy_{false};
  std::mutex mutex_;
  std::condition_variable start_, done_;
  std::vector<std::thread> workers_;
  std::atomic<int> next_{0};
  int count_ = 0, wanted_ = 0, running_ = 0;
  long call_ = 0;
  const std::function<void(int)>* work_ = nullptr;
  std::exception_ptr error_;
  Stop* stop_ = nullptr;
};

// never destroyed: its threads wait until the process ends. A forked child has none of them, and
// makes a pool of its own.
Pool& pool() {
  static std::mutex guard;
  static Pool* pool = new Pool;
  static pid_t owner = getpid();
  std::lock_guard<std::mutex> lock(guard);
  if (owner != getpid()) {
    pool = new Pool;
    owner = getpid();
  }
  return *pool;
}

}  // namespace

void in_parallel(int threads, int count, const std::function<void(int)>& work) {
  if (threads < 2 || count < 2) {
    for (int i = 0; i < count; ++i) work(i);
  } else {
    pool().run(threads, count, work);
  }
}

}  // namespace flaprig
