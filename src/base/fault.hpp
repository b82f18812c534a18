#pragma once
#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace livebed::base {

/// Exit codes of the program; scripts rely on them.
enum class Exit : int {
  ok = 0,
  internal = 1,
  command_line = 2,
  invalid_case = 3,
  diverged = 4,
  input_output = 5,
  stopped_by_limit = 6,
  comparison = 7,
  signal = 128  ///< plus the signal's number, after a checkpoint
};

/// Every error a user can meet: one sentence that says what, where, how much, what is allowed, what to do; and the exit
/// code it ends the program with.
class Fault : public std::runtime_error {
public:
  Fault(Exit code, const std::string& message) : std::runtime_error(message), code_(code) {}
  Exit code() const { return code_; }

private:
  Exit code_;
};

/// Throws a Fault with a formatted message: fail(Exit::diverged, "k = {} in cell ({},{})", k, i, j).
template <class... Args>
[[noreturn]] void fail(Exit code, fmt::format_string<Args...> text, Args&&... args) {
  throw Fault(code, fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace livebed::base
