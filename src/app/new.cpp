#include <cerrno>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <memory>
#include <system_error>

#include "app/plan_text.hpp"
#include "app/question_options.hpp"
#include "app/sizing.hpp"
#include "app/templates.hpp"
#include "app/verbs.hpp"
#include "base/loops.hpp"
#include "case/faults.hpp"

namespace livebed::app {
namespace {

using base::Exit;
using base::fail;

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const Template& shipped : templates()) names.push_back(shipped.name);
  return names;
}

const Template& find_template(const std::string& name) {
  for (const Template& shipped : templates())
    if (shipped.name == name) return shipped;
  const std::vector<std::string> names = template_names();
  const std::string meant = casefile::nearest(name, names);
  fail(Exit::command_line, "there is no case {} to start from{}; there are {}", name,
       meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant), casefile::listed(names));
}

void check_new(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) fail(Exit::input_output, "{} exists; name another file", path.string());
}

/// Writes a new file; never over an old one.
void write_new(const std::filesystem::path& path, const std::string& text) {
  check_new(path);
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) fail(Exit::input_output, "cannot write {}: {}", path.string(), std::generic_category().message(errno));
}

struct Options {
  std::string name, out;
  QuestionOptions question;
  double hours = 12, seconds = 0.5 * seconds_to_time;
};

void give(const Options& o, const std::string& text) {
  if (o.out.empty())
    fmt::print("{}", text);
  else
    write_new(o.out, text);
}

/// The case of a question: with its sand, or with the finest grains that fit into the hours.
void answer(const Options& o) {
  const casefile::Question q = o.question.read();
  if (!o.out.empty()) check_new(o.out);
  const Sizable what = sizable(q);
  const run::Speeds speeds = time_on_this_machine(what, o.seconds);
  const Size size = finest_within(o.hours, what, speeds, o.seconds);
  if (!size.fits)
    fail(Exit::command_line,
         "with the coarsest grains that still show a hole, {:.4g} mm, a run takes {} here: give more than --hours {:g}",
         1e3 * size.d, spoken(size.prediction.wall()), o.hours);
  give(o, casefile::case_text(q, size.d));
  const std::string file = o.out.empty() ? "CASE" : o.out;
  if (size.d > q.sand) {
    const casefile::Scene real = casefile::scene_of(q);
    fmt::print(
        stderr,
        "ENLARGED GRAINS: with the real sand a run takes {} here, more than --hours {:g}. Grains of {:.4g} mm stand "
        "for it:\n{}",
        spoken(run::predict(what.work, speeds).wall()), o.hours, 1e3 * size.d,
        kept_and_lost(real, casefile::scene_of(q, size.d)));
  }
  fmt::print(stderr, "about {} of wall time with {} thread{}; next: livebed plan {}\n", spoken(size.prediction.wall()),
             base::threads(), base::threads() == 1 ? "" : "s", file);
}

}  // namespace

void add_new(CLI::App& app, Action& chosen) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand(
      "new", "write a commented case file: of a question (--pipe, --current, --sand), or a shipped one");
  verb->add_option("NAME", o->name, "a shipped case: mao-mbs2d, quick, flat-bed, mao-mbs2d/deep, ...");
  o->question.add_to(*verb);
  verb->add_option("--hours", o->hours,
                   "hours you give to a run: when the sand does not fit, larger grains stand for it")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--seconds", o->seconds, "processor time to spend on timing this machine")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--out", o->out, "write it to this new file instead of printing it")->type_name("FILE");
  verb->callback([o, &chosen] {
    chosen = [o] {
      if (o->name.empty() && !o->question.given())
        fail(
            Exit::command_line,
            "what is asked? Give a question, --pipe 0.5m --current 0.8 --sand 0.2mm, or the name of a shipped case: {}",
            casefile::listed(template_names()));
      if (!o->name.empty() && o->question.given())
        fail(Exit::command_line, "the shipped case {} and a question at once: give one of them", o->name);
      if (o->name.empty())
        answer(*o);
      else
        give(*o, find_template(o->name).text);
      return Exit::ok;
    };
  });
}

}  // namespace livebed::app
