#include "base/loops.hpp"

#include <atomic>
#include <memory>
#include <sched.h>
#include <thread>

#include "base/fault.hpp"

namespace livebed::base {

namespace {

/// Worker threads that sleep between loops.  A thread that waits spins for some hundred microseconds, longer than the
/// pause between two loops of a step, and then lets the system take its core: on a busy machine endless spinning, which
/// OpenMP does by default, makes two threads many times slower than one.
class Team {
public:
  explicit Team(int size) : size_(size) {
    for (int share = 1; share < size; ++share)
      workers_.emplace_back([this, share] {
        index = share;
        serve(share);
      });
  }
  ~Team() {
    work_ = nullptr;
    start();
    for (std::thread& worker : workers_) worker.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  void run(void (*work)(void*, int, int), void* data) {
    work_ = work;
    data_ = data;
    working_.store(size_ - 1, std::memory_order_relaxed);
    start();
    work(data, 0, size_);
    for (int left = wait_while(working_, working_.load(std::memory_order_acquire)); left != 0;)
      left = wait_while(working_, left);
  }

  static thread_local bool inside;
  static thread_local int index;

private:
  /// Returns the value once it is no longer `old` (at once when old is 0 or the value differs already).
  template <class T>
  static T wait_while(const std::atomic<T>& value, T old) {
    constexpr int spins = 3000;
    for (int k = 0; k < spins; ++k) {
      const T now = value.load(std::memory_order_acquire);
      if (now != old || now == 0) return now;
      pause();
    }
    value.wait(old, std::memory_order_acquire);
    return value.load(std::memory_order_acquire);
  }
  static void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  void start() {
    epoch_.fetch_add(1, std::memory_order_release);
    epoch_.notify_all();
  }
  void serve(int share) {
    inside = true;
    unsigned seen = 1;  // the epoch before the first start
    while (true) {
      while (epoch_.load(std::memory_order_acquire) == seen) wait_while(epoch_, seen);
      ++seen;
      if (!work_) return;
      work_(data_, share, size_);
      if (working_.fetch_sub(1, std::memory_order_acq_rel) == 1) working_.notify_one();
    }
  }

  const int size_;
  std::vector<std::thread> workers_;
  std::atomic<unsigned> epoch_{1};
  std::atomic<int> working_{0};
  void (*work_)(void*, int, int) = nullptr;
  void* data_ = nullptr;
};
thread_local bool Team::inside = false;
thread_local int Team::index = 0;

int thread_count = 1;
std::unique_ptr<Team> team;

}  // namespace

void set_threads(int n) {
  if (n < 1) fail(Exit::command_line, "--threads = {} is not allowed; give 1 or more", n);
  team.reset();
  thread_count = n;
  if (n > 1) team = std::make_unique<Team>(n);
}

int threads() { return thread_count; }

int cores() {
  cpu_set_t set;
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

int thread_index() { return Team::index; }

void on_all_threads(void (*work)(void* data, int share, int shares), void* data, bool alone) {
  if (alone || !team || Team::inside) return work(data, 0, 1);
  Team::inside = true;
  team->run(work, data);
  Team::inside = false;
}

}  // namespace livebed::base
