#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "io/descriptor.hpp"

/// How a run is watched and steered from outside: by files in its folder, which any program and any script can use.
namespace livebed::run {

/// Where a run stands.
struct Status {
  std::string phase;    ///< packing, spin-up, digging, paused
  double time = 0;      ///< [s]
  double end = 0;       ///< [s]
  double S_over_D = 0;  ///< [-]
  double speed = 0;     ///< simulated seconds a second of wall time
  double left = 0;      ///< wall time to the end [s]
};

enum class Command { checkpoint, pause, go, stop };
/// What a word of a command file means; empty for anything else.
std::optional<Command> command_of(const std::string& word);
inline constexpr const char* command_words = "checkpoint, pause, go, stop";

/// The folder of a run while its program is at work in it.  `running` is locked: only one program may run a folder, and
/// when it dies, however that happens, the lock is gone.  `status.json` is replaced about twice a second.  `command`, a
/// file of one word, is obeyed within a step or a fifth of a second and taken away.  All three are gone after the run.
class Control {
public:
  /// Fault (input/output) when another program is running this folder.
  explicit Control(const std::filesystem::path& folder);
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  /// Writes the status unless the last one was written less than half a second ago; `now`: in any case.
  void tell(const Status& status, bool now = false);
  /// The word that has come, if any; looks at the disk five times a second at most.
  std::optional<std::string> take();

private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path folder_;
  io::Descriptor lock_;
  Clock::time_point told_{}, looked_{};
};

/// Is a program running this folder now?
bool is_running(const std::filesystem::path& folder);

}  // namespace livebed::run
