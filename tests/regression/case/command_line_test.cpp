#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "case/manual.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"

/// The built program as scripts see it: exit codes, what goes to which stream, and that nothing is written.
namespace livebed {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Result {
  int exit;
  std::string out, err;
};

/// Runs the program inside a folder of its own that starts empty.
class CommandLine : public testing::Test {
protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("livebed-" + std::to_string(getpid()) + "-" +
                                         testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(root_);
    fs::create_directories(folder());
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path folder() const { return root_ / "work"; }
  Result run(const std::string& arguments) const {
    const std::string command = "cd '" + folder().string() + "' && '" LIVEBED_PROGRAM "' " + arguments + " >'" +
                                (root_ / "out").string() + "' 2>'" + (root_ / "err").string() + "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(root_ / "out"), content(root_ / "err")};
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder() / name) << text; }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder()), {})); }

private:
  fs::path root_;
};

const std::string quick = LIVEBED_SOURCE_DIR "/cases/quick";

TEST_F(CommandLine, tells_version_and_help) {
  const Result version = run("--version");
  EXPECT_EQ(version.exit, 0);
  EXPECT_EQ(version.out.rfind("livebed ", 0), 0u);
  EXPECT_EQ(run("--help").exit, 0);
  EXPECT_EQ(run("check --help").exit, 0);
}

TEST_F(CommandLine, wrong_command_lines_end_with_2) {
  for (const char* wrong : {"", "check", "--nonsense", "check a b", "keys --preset paper", "keys --json --markdown",
                            "new nonsense", "--threads 0 keys", "--threads two keys"}) {
    const Result result = run(wrong);
    EXPECT_EQ(result.exit, 2) << wrong;
    EXPECT_FALSE(result.err.empty()) << wrong;
  }
  EXPECT_EQ(run("chek").exit, 2);
  EXPECT_NE(run("chek").err.find("did you mean check?"), std::string::npos);
  EXPECT_EQ(files(), 0u);
}

TEST_F(CommandLine, check_tells_what_follows_from_a_good_case) {
  for (const char* where : {"", "/case.toml"}) {
    const Result text = run("check '" + quick + where + "'");
    EXPECT_EQ(text.exit, 0);
    EXPECT_EQ(text.err, "");
    EXPECT_NE(text.out.find("time_scale"), std::string::npos);
  }
  const casefile::Case c = casefile::read_case(quick, {"bed.seed=3"});
  const Result json = run("check '" + quick + "' --set bed.seed=3 --json");
  EXPECT_EQ(json.exit, 0);
  EXPECT_NE(json.out.find("\"hash\": \"" + casefile::hash(c) + "\""), std::string::npos) << json.out;
  EXPECT_EQ(files(), 0u);
}

TEST_F(CommandLine, check_tells_all_faults_and_ends_with_3) {
  write("bad.toml", "[current]\ntheta = 0.3\n[grains]\ndiametre = 1\n[contact]\nrestitution = 1.4\n");
  const Result result = run("check bad.toml --set flow.courant=9");
  EXPECT_EQ(result.exit, 3);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "bad.toml:4: unknown key grains.diametre; did you mean grains.diameter?\n"
            "bad.toml:6: contact.restitution = 1.4 is outside (0, 1]\n"
            "--set: flow.courant = 9 is outside (0, 1]\n"
            "3 faults, nothing was run\n");
  EXPECT_EQ(files(), 1u);
}

TEST_F(CommandLine, check_of_an_unreadable_file_ends_with_5_and_names_it) {
  const Result missing = run("check missing.toml");
  EXPECT_EQ(missing.exit, 5);
  EXPECT_NE(missing.err.find("missing.toml: No such file"), std::string::npos);
  EXPECT_EQ(run("check .").exit, 5);  // a folder without case.toml
  EXPECT_EQ(files(), 0u);
}

TEST_F(CommandLine, keys_lists_the_manual) {
  EXPECT_EQ(run("keys").out, casefile::manual_text("livebed"));
  EXPECT_EQ(run("keys --preset mbs2d").out, casefile::manual_text("mbs2d"));
  EXPECT_EQ(run("keys --markdown").out, casefile::manual_markdown());
  const Result json = run("keys --json");
  EXPECT_EQ(json.exit, 0);
  EXPECT_NE(json.out.find("\"name\": \"current.theta\""), std::string::npos);
}

TEST_F(CommandLine, new_gives_every_shipped_case) {
  for (const std::string name : {"mao-mbs2d", "mao-mbs2d/current", "mao-mbs2d/deep", "quick", "flat-bed"}) {
    const fs::path path = fs::path(LIVEBED_SOURCE_DIR "/cases") / name;
    const Result result = run("new " + name);
    EXPECT_EQ(result.exit, 0);
    EXPECT_EQ(result.out, content(fs::is_directory(path) ? path / "case.toml" : fs::path(path.string() + ".toml")))
        << name;
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(CommandLine, new_writes_a_file_but_never_over_another) {
  EXPECT_EQ(run("new quick --out my.toml").exit, 0);
  EXPECT_EQ(content(folder() / "my.toml"), content(quick + "/case.toml"));
  EXPECT_EQ(run("check my.toml").exit, 0);
  write("my.toml", "precious");
  const Result again = run("new quick --out my.toml");
  EXPECT_EQ(again.exit, 5);
  EXPECT_NE(again.err.find("my.toml exists"), std::string::npos);
  EXPECT_EQ(content(folder() / "my.toml"), "precious");
  EXPECT_EQ(run("new quick --out no/such/folder.toml").exit, 5);
}

TEST_F(CommandLine, threads_may_stand_before_and_behind_the_verb) {
  EXPECT_EQ(run("--threads 2 keys").exit, 0);
  EXPECT_EQ(run("keys --threads 2").exit, 0);
}

}  // namespace
}  // namespace livebed
