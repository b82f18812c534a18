#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/fault.hpp"

namespace livebed::app {

/// Work for a process of its own.
struct Task {
  std::string name;
  std::function<base::Exit()> work;  ///< a Fault it throws becomes the task's fault
};

/// How a task came out.
struct Outcome {
  bool begun = false;
  base::Exit code = base::Exit::ok;
  std::string fault;  ///< of what it threw, or the signal that killed it
};

/// Does the tasks, `most` of them at a time, each in a process of its own, so that none can take another down.  begun
/// and ended are called in this process; meanwhile(running) about ten times a second.
///
/// INT and TERM, also from Ctrl-C, start no further task and go on to all that are running; a second one again.  When
/// this process dies, they get a TERM.  Must be called while there is one thread.  Returns the signal, 0 when there was
/// none.
struct SideBySide {
  std::function<void(std::size_t task)> begun;
  std::function<void(std::size_t task, const Outcome&)> ended;
  std::function<void(const std::vector<std::size_t>& running)> meanwhile;

  int run(const std::vector<Task>& tasks, int most, std::vector<Outcome>& outcomes) const;
};

}  // namespace livebed::app
