#include "io/file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "base/fault.hpp"
#include "io/descriptor.hpp"

namespace livebed::io {

using base::Exit;
using base::fail;

void fail_with_errno(std::string_view doing, const Path& path) {
  const int code = errno;
  const char* advice = code == ENOSPC || code == EDQUOT  ? "; free some space or choose another folder"
                       : code == EACCES || code == EROFS ? "; choose a folder you may write to"
                                                         : "";
  fail(Exit::input_output, "cannot {} {}: {}{}", doing, path.string(), std::strerror(code), advice);
}

Descriptor::Descriptor(const Path& path, int flags)
    : path_(path), number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
  if (number_ < 0) fail_with_errno("open", path);
}

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : path_(std::move(other.path_)), number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::write_all(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t n = ::write(number_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_with_errno("write to", path_);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void Descriptor::sync() const {
  if (::fsync(number_) != 0) fail_with_errno("sync", path_);
}

void write_atomically(const Path& path, std::string_view bytes) {
  const Path folder = path.has_parent_path() ? path.parent_path() : Path(".");
  // The process number keeps two programs that write the same file from sharing one temporary.
  const Path temporary = path.string() + fmt::format(".{}.part", ::getpid());
  try {
    const Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    file.write_all(bytes);
    file.sync();
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail_with_errno("replace", path);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  Descriptor(folder, O_RDONLY | O_DIRECTORY).sync();
}

std::string read_file(const Path& path) {
  const Descriptor file(path, O_RDONLY);
  struct stat status;
  if (::fstat(file.number(), &status) != 0) fail_with_errno("look at", path);
  if (S_ISDIR(status.st_mode)) fail(Exit::input_output, "cannot read {}: it is a folder", path.string());
  std::string bytes;
  std::size_t used = 0;
  bytes.resize(static_cast<std::size_t>(status.st_size) + 1);
  while (true) {
    if (used == bytes.size()) bytes.resize(2 * bytes.size());
    const ssize_t n = ::read(file.number(), bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_with_errno("read", path);
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
  }
  bytes.resize(used);
  return bytes;
}

void make_folder(const Path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) fail(Exit::input_output, "cannot create the folder {}: {}", path.string(), error.message());
}

}  // namespace livebed::io
