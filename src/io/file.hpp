#pragma once
#include <filesystem>
#include <string>
#include <string_view>

/// Whole files in and out.  Every failure is a Fault (input/output) that names the file and the system's reason.
namespace livebed::io {

using Path = std::filesystem::path;

/// Replaces the file in one piece: writes a temporary file in the same folder, syncs it, renames it and syncs the
/// folder. Whatever happens, a reader finds either the whole old file or the whole new one.
void write_atomically(const Path& path, std::string_view bytes);

/// The whole content of a file.
std::string read_file(const Path& path);

/// Creates a folder and its parents; no error when it exists already.
void make_folder(const Path& path);

}  // namespace livebed::io
