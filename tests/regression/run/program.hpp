#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "../../unit/io/temporary_folder.hpp"

namespace livebed {

namespace fs = std::filesystem;

inline std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Every file below a folder with its bytes.
inline std::map<std::string, std::string> everything_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = content(entry.path());
  return files;
}

/// The quick case made smaller still, a fifth of a second of work; half of that is the packing of its 500 grains.
inline const std::string small_box = "'" LIVEBED_SOURCE_DIR
                                     "/cases/quick' --set mesh.length=0.12 --set mesh.height=0.06 --set pipe.x=0.05"
                                     " --set output.series_every=0.005 --set output.bed_every=0.02"
                                     " --set output.fields_every=0.04 --set output.checkpoint_every=0.03";
inline const std::string small_start = " --set bed.count=500 --set time.spin_up=0.05";
inline const std::string small_case = small_box + small_start;
/// The words that run it to a time [s] into a folder.
inline std::string small_run(const std::string& end, const std::string& out, const std::string& start = small_start) {
  return "run " + small_box + start + " --no-bed-cache --quiet --set time.end=" + end + " --out " + out;
}

struct Result {
  int exit;
  std::string out, err;
};

/// The built program at work in a folder of its own.
class Program : public testing::Test {
protected:
  /// Runs it to its end; the words before it are for the shell.
  Result run(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + folder().string() + "' && XDG_CACHE_HOME='" + (root_ / "cache").string() +
                                "' " + before + " '" + LIVEBED_PROGRAM + "' " + arguments + " >'" +
                                (root_ / "out").string() + "' 2>'" + (root_ / "err").string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(root_ / "out"), content(root_ / "err")};
  }
  /// Starts it and returns its process number.
  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    ::setenv("XDG_CACHE_HOME", (root_ / "cache").c_str(), 1);
    if (::chdir(folder().c_str()) != 0) ::_exit(127);
    std::vector<char*> words;
    std::vector<std::string> all = arguments;
    all.insert(all.begin(), LIVEBED_PROGRAM);
    for (std::string& word : all) words.push_back(word.data());
    words.push_back(nullptr);
    ::execv(LIVEBED_PROGRAM, words.data());
    ::_exit(127);
  }

  /// Where the program runs.
  fs::path folder() const {
    fs::create_directory(root_ / "work");
    return root_ / "work";
  }
  fs::path operator/(const std::string& name) const { return folder() / name; }

  void expect_contains(const std::string& text, const std::vector<std::string>& words) const {
    for (const std::string& word : words)
      EXPECT_NE(text.find(word), std::string::npos) << '"' << word << "\" is not in: " << text;
  }

private:
  TemporaryFolder root_;
};

}  // namespace livebed
