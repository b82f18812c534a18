#include "run/control.hpp"

#include <cerrno>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "base/fault.hpp"
#include "io/file.hpp"

namespace livebed::run {

namespace fs = std::filesystem;

namespace {

constexpr auto tell_every = std::chrono::milliseconds(500), look_every = std::chrono::milliseconds(200);

/// Takes the lock; those who only ask whether it is taken hold it for an instant, so it is worth a few tries.
bool locked(int file) {
  constexpr int tries = 20;
  for (int n = 0; n < tries; ++n) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK) return false;
    const timespec moment{0, 10'000'000};
    ::nanosleep(&moment, nullptr);
  }
  errno = EWOULDBLOCK;
  return false;
}

}  // namespace

std::optional<Command> command_of(const std::string& word) {
  if (word == "checkpoint") return Command::checkpoint;
  if (word == "pause") return Command::pause;
  if (word == "go") return Command::go;
  if (word == "stop") return Command::stop;
  return {};
}

Control::Control(const fs::path& folder) : folder_(folder), lock_(folder / "running", O_RDWR | O_CREAT | O_CLOEXEC) {
  if (!locked(lock_.number())) {
    if (errno == EWOULDBLOCK)
      base::fail(base::Exit::input_output, "{} is being run by another program; watch it with: livebed watch {}",
                 folder.string(), folder.string());
    io::fail_with_errno("lock", folder / "running");
  }
  // What was said to a run before this one is not for it.
  fs::remove(folder / "command");
}

Control::~Control() {
  std::error_code ignored;
  for (const char* name : {"status.json", "command", "running"}) fs::remove(folder_ / name, ignored);
}

void Control::tell(const Status& status, bool now) {
  if (!now && Clock::now() - told_ < tell_every) return;
  told_ = Clock::now();
  const nlohmann::ordered_json json = {{"phase", status.phase},       {"t_s", status.time},    {"end_s", status.end},
                                       {"S_over_D", status.S_over_D}, {"speed", status.speed}, {"left_s", status.left},
                                       {"process", ::getpid()}};
  // Renamed so that a reader finds a whole file; not forced to the disk, because after a crash nobody needs it.
  const fs::path file = folder_ / "status.json", part = folder_ / "status.json.part";
  std::ofstream out(part);
  out << json.dump() << '\n';
  out.close();
  if (!out) io::fail_with_errno("write", part);
  fs::rename(part, file);
}

std::optional<std::string> Control::take() {
  if (Clock::now() - looked_ < look_every) return {};
  looked_ = Clock::now();
  const fs::path file = folder_ / "command";
  if (!fs::exists(file)) return {};
  const std::string word = io::read_file(file);
  // A shell's `echo stop > command` makes the file before it holds the word.
  if (word.empty()) return {};
  fs::remove(file);
  return word.substr(0, word.find_last_not_of(" \r\n\t") + 1);
}

bool is_running(const fs::path& folder) {
  const int file = ::open((folder / "running").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return locked;
}

}  // namespace livebed::run
