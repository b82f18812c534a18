#include "app/side_by_side.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/descriptor.hpp"

namespace livebed::app {

namespace {

volatile std::sig_atomic_t signal_caught = 0, signals_caught = 0;

void on_signal(int signal) {
  signal_caught = signal;
  signals_caught = signals_caught + 1;
}

/// Blocks INT and TERM while it lives: none is lost between a fork and the handlers of the child.
class Undisturbed {
public:
  Undisturbed() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigprocmask(SIG_BLOCK, &set, &before_);
  }
  ~Undisturbed() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  Undisturbed(const Undisturbed&) = delete;
  Undisturbed& operator=(const Undisturbed&) = delete;

private:
  sigset_t before_;
};

/// The child: does the work and leaves by its exit code, its fault in the pipe.
[[noreturn]] void do_task(const Task& task, int pipe) {
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  std::string fault;
  int code = static_cast<int>(base::Exit::internal);
  try {
    code = static_cast<int>(task.work());
  } catch (const base::Fault& thrown) {
    code = static_cast<int>(thrown.code());
    fault = thrown.what();
  } catch (const std::exception& thrown) {
    fault = fmt::format("internal error: {}", thrown.what());
  }
  if (!fault.empty() && ::write(pipe, fault.data(), fault.size()) < 0) code = static_cast<int>(base::Exit::internal);
  ::_exit(code);
}

struct Child {
  std::size_t task;
  pid_t process;
  int pipe;  ///< its fault comes out of it
};

Child start(const Task& task, std::size_t number) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) io::fail_with_errno("make a pipe for", task.name);
  const Undisturbed undisturbed;
  const pid_t parent = ::getpid(), process = ::fork();
  if (process < 0) io::fail_with_errno("start a process for", task.name);
  if (process == 0) {
    ::setpgid(0, 0);  // Ctrl-C reaches this program alone, which hands it on once
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(static_cast<int>(base::Exit::internal));
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    ::close(ends[0]);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    do_task(task, ends[1]);
  }
  ::close(ends[1]);
  return {number, process, ends[0]};
}

Outcome outcome_of(const Child& child, int status) {
  Outcome outcome{true, base::Exit::internal, {}};
  char part[4096];
  for (ssize_t n = 0; (n = ::read(child.pipe, part, sizeof part)) > 0;)
    outcome.fault.append(part, static_cast<std::size_t>(n));
  ::close(child.pipe);
  if (WIFEXITED(status)) {
    outcome.code = static_cast<base::Exit>(WEXITSTATUS(status));
  } else {
    outcome.fault =
        fmt::format("its process was killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  return outcome;
}

}  // namespace

int SideBySide::run(const std::vector<Task>& tasks, int most, std::vector<Outcome>& outcomes) const {
  signal_caught = 0;
  signals_caught = 0;
  const auto interrupted = std::signal(SIGINT, on_signal), terminated = std::signal(SIGTERM, on_signal);
  outcomes.assign(tasks.size(), {});
  std::vector<Child> children;
  std::size_t next = 0;
  for (int handed_on = 0; next < tasks.size() || !children.empty();) {
    if (signals_caught > handed_on) {
      handed_on = signals_caught;
      next = tasks.size();
      for (const Child& child : children) ::kill(child.process, signal_caught);
    }
    while (next < tasks.size() && children.size() < static_cast<std::size_t>(most)) {
      children.push_back(start(tasks[next], next));
      begun(next++);
    }
    for (std::size_t n = 0; n < children.size();) {
      int status = 0;
      if (::waitpid(children[n].process, &status, WNOHANG) == 0) {
        ++n;
        continue;
      }
      const Child child = children[n];
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(n));
      outcomes[child.task] = outcome_of(child, status);
      ended(child.task, outcomes[child.task]);
    }
    std::vector<std::size_t> running;
    for (const Child& child : children) running.push_back(child.task);
    if (!running.empty()) meanwhile(running);
    const timespec moment{0, 100'000'000};
    if (!running.empty()) ::nanosleep(&moment, nullptr);
  }
  std::signal(SIGINT, interrupted);
  std::signal(SIGTERM, terminated);
  return signal_caught;
}

}  // namespace livebed::app
