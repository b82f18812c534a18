#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "app/plan_text.hpp"
#include "app/question_options.hpp"
#include "app/sizing.hpp"
#include "app/verbs.hpp"
#include "base/loops.hpp"
#include "case/check.hpp"

namespace livebed::app {
namespace {

using base::Exit;
using base::fail;

constexpr double default_hours = 12;

struct Options {
  CaseOptions which;
  QuestionOptions question;
  double hours = default_hours, seconds = seconds_to_time;
  bool json = false;
};

Plan plan_of(const Options& o) {
  Plan p;
  p.hours = o.hours, p.threads = base::threads();
  Sizable what;
  if (!o.which.path.empty()) {
    if (o.question.given() && !o.question.sand_alone())
      fail(Exit::command_line,
           "a case and a question at once: give CASE, with --sand for the sand its grains stand for, or --pipe, "
           "--current "
           "and --sand without CASE");
    const casefile::Case c = o.which.read();
    p.title = c.title, p.scene = casefile::scene_of(c), p.notes = casefile::notes(c);
    if (c.grains.count == 0) p.notes.push_back("there is no sand in this case: nothing is scoured");
    if (o.question.given()) p.real = casefile::with_sand(p.scene, o.question.sand(), casefile::expect(p.scene).theta);
    what = sizable(o.which);
  } else {
    if (!o.question.given())
      fail(Exit::command_line,
           "what is to be planned? Give a case file, or a question: --pipe 0.5m --current 0.8 --sand 0.2mm");
    if (!o.which.overrides.empty())
      fail(Exit::command_line, "--set changes a case, and a question has none yet: write it with livebed new first");
    const casefile::Question q = o.question.read();
    p.scene = casefile::scene_of(q);
    p.title = casefile::title_of(q, q.sand);
    what = sizable(q);
  }
  p.work = what.work;
  p.speeds = time_on_this_machine(what, o.seconds);
  p.prediction = run::predict(p.work, p.speeds);
  if (p.prediction.wall() > 3600 * p.hours && p.work.grains > 0) {
    p.size = finest_within(p.hours, what, p.speeds, o.seconds);
    p.model = casefile::with_sand(p.scene, p.size->d, casefile::expect(p.scene).theta);
  }
  return p;
}

}  // namespace

void add_plan(CLI::App& app, Action& chosen) {
  auto o = std::make_shared<Options>();
  CLI::App* verb =
      app.add_subcommand("plan", "tell what to expect and how long it takes, of a case or a question; run nothing");
  o->which.add_to(*verb, false);
  o->question.add_to(*verb);
  verb->add_option("--hours", o->hours, "hours you would give to a run: what does not fit gets larger grains proposed")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--seconds", o->seconds, "processor time to spend on timing this machine")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_flag("--json", o->json, "as JSON");
  verb->callback([o, &chosen] {
    chosen = [o] {
      const Plan plan = plan_of(*o);
      fmt::print("{}\n", o->json ? json_of(plan).dump(2) : text_of(plan));
      return Exit::ok;
    };
  });
}

}  // namespace livebed::app
