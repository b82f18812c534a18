#pragma once
#include <string_view>

#include "io/file.hpp"

namespace livebed::io {

/// Owns a file descriptor of the system; closing is silent, so sync() before it where the bytes must be safe.
class Descriptor {
public:
  Descriptor() = default;
  /// open(2) with these flags; new files get mode 0666 less the umask.
  Descriptor(const Path& path, int flags);
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  int number() const { return number_; }
  void write_all(std::string_view bytes) const;
  void sync() const;

private:
  Path path_;
  int number_ = -1;
};

/// Fault (input/output) made of what could not be done, the file and errno.
[[noreturn]] void fail_with_errno(std::string_view doing, const Path& path);

}  // namespace livebed::io
