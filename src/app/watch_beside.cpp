#include "app/watch_beside.hpp"

#include <algorithm>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/server.hpp"
#include "base/fault.hpp"
#include "io/descriptor.hpp"
#include "run/control.hpp"

namespace livebed::app {

namespace {

constexpr double linger = 20;  ///< [s]
const std::string served = "watch this run at ";

/// Cuts the process off from the terminal: what reads the run's output must not wait for this one.
void go_silent() {
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
}

/// Waits for the run to take hold of its folder; false when its process has ended before.
bool run_has_begun(const std::filesystem::path& folder, pid_t runner) {
  while (!run::is_running(folder)) {
    if (::getppid() != runner) return false;
    const timespec moment{0, 20'000'000};
    ::nanosleep(&moment, nullptr);
  }
  return true;
}

}  // namespace

std::string watch_from_beside(const std::filesystem::path& folder, int port) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) io::fail_with_errno("make a pipe for the page of", folder);
  const pid_t runner = ::getpid(), child = ::fork();
  if (child < 0) io::fail_with_errno("start a process for the page of", folder);
  if (child == 0) {
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the run; the page shows how it ends
    const auto tell = [&](const std::string& line) {
      if (::write(ends[1], line.data(), line.size()) < 0) ::_exit(1);
      ::close(ends[1]);
    };
    bool told = false;
    try {
      serve(folder, {.port = port, .linger = linger, .ready = [&](const std::string& address) {
                       tell(served + address);
                       told = true;
                       go_silent();
                       return run_has_begun(folder, runner);
                     }});
    } catch (const base::Fault& fault) {
      if (!told) tell(fault.what());
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  std::string line(4096, '\0');
  const ssize_t length = ::read(ends[0], line.data(), line.size());
  ::close(ends[0]);
  line.resize(static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
  if (line.starts_with(served)) return line;
  ::waitpid(child, nullptr, 0);
  base::fail(base::Exit::input_output, "{}", line.empty() ? "the process that serves the page has failed" : line);
}

}  // namespace livebed::app
