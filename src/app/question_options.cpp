#include "app/question_options.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

#include "base/fault.hpp"
#include "case/units.hpp"

namespace livebed::app {
namespace {

using base::Exit;
using base::fail;

/// Reads flags and gathers what is wrong with them.
class Flags {
public:
  /// A number with its unit, or a bare one in SI, between two limits; 0 when it is empty.
  double number(const char* flag, const std::string& text, const char* unit, double least, double most) {
    if (text.empty()) return 0;
    const auto quantity = casefile::parse_quantity(text);
    const bool bare = quantity && quantity->unit.empty();
    const casefile::Measured read = casefile::measured(flag, text, text, bare ? "-" : unit);
    if (!read.fault.empty()) {
      wrong(fmt::format("{}, as in {}", read.fault, example(unit)));
    } else if (!(read.value >= least && read.value <= most)) {
      wrong(fmt::format("{} = {} is {:.6g}{}{}, outside [{:g}, {:g}]{}", flag, text, read.value,
                        *unit == '-' ? "" : " ", *unit == '-' ? "" : unit, least, most,
                        bare && *unit == 'm' ? "; a bare number is in SI: give a unit, as in " + example(unit) : ""));
    }
    return read.value;
  }
  void wrong(std::string what) { faults_.push_back(std::move(what)); }
  void report() const {
    if (!faults_.empty()) fail(Exit::command_line, "{}", fmt::join(faults_, "\n"));
  }

private:
  static std::string example(std::string_view unit) {
    return unit == "m" ? "0.2mm or 0.5m" : unit == "m/s" ? "0.8m/s" : "0.3";
  }
  std::vector<std::string> faults_;
};

constexpr double finest_sand = 0.06e-3, coarsest_sand = 0.1;
constexpr const char* sand_flag = "--sand";

double read_sand(Flags& flags, const std::string& text) {
  return flags.number(sand_flag, text, "m", finest_sand, coarsest_sand);
}

}  // namespace

void QuestionOptions::add_to(CLI::App& verb) {
  verb.add_option("--pipe", pipe_, "diameter of the pipe, 0.5m")->type_name("LENGTH");
  verb.add_option("--current", current_, "mean speed of the current over the depth, 0.8 or 80cm/s")->type_name("SPEED");
  verb.add_option("--theta", theta_, "its Shields parameter u*^2/((s-1) g d) instead")->type_name("NUMBER");
  verb.add_option(sand_flag, sand_, "grain diameter of the sand, 0.2mm")->type_name("LENGTH");
  verb.add_option("--gap", gap_, "gap under the pipe, e/D or a length; below 0: it lies in the bed (0)")
      ->type_name("NUMBER");
  verb.add_option("--depth", depth_, "water above the bed (6 pipe diameters)")->type_name("LENGTH");
}

bool QuestionOptions::given() const {
  for (const std::string* text : {&pipe_, &current_, &theta_, &sand_, &gap_, &depth_})
    if (!text->empty()) return true;
  return false;
}

bool QuestionOptions::sand_alone() const {
  return !sand_.empty() && pipe_.empty() && current_.empty() && theta_.empty() && gap_.empty() && depth_.empty();
}

double QuestionOptions::sand() const {
  Flags flags;
  const double d = read_sand(flags, sand_);
  flags.report();
  return d;
}

casefile::Question QuestionOptions::read() const {
  Flags flags;
  const std::array<std::pair<const char*, const std::string*>, 2> needed{{{"--pipe", &pipe_}, {sand_flag, &sand_}}};
  for (const auto& [flag, text] : needed)
    if (text->empty())
      flags.wrong(fmt::format("{} is missing: a question is --pipe 0.5m --current 0.8 --sand 0.2mm", flag));
  if (current_.empty() && theta_.empty())
    flags.wrong("--current or --theta is missing: how strong is the current? --current 0.8 (m/s) or --theta 0.3");
  if (!current_.empty() && !theta_.empty())
    flags.wrong("--current and --theta contradict each other: give one of them");

  casefile::Question q;
  q.pipe = flags.number("--pipe", pipe_, "m", 1e-3, 10);
  q.sand = read_sand(flags, sand_);
  q.current = flags.number("--current", current_, "m/s", 1e-3, 20);
  q.theta = flags.number("--theta", theta_, "-", 1e-3, 5);
  q.depth = flags.number("--depth", depth_, "m", 0, 1000);
  const auto gap = casefile::parse_quantity(gap_);
  const bool length = gap && !gap->unit.empty() && gap->unit != "%";
  q.gap_ratio = length ? flags.number("--gap", gap_, "m", -10, 50) / (q.pipe > 0 ? q.pipe : 1)
                       : flags.number("--gap", gap_, "-", -1, 5);
  flags.report();

  if (!(q.gap_ratio >= -1 && q.gap_ratio <= 5))
    flags.wrong(fmt::format("--gap = {} is e/D = {:.3g}, outside [-1, 5]", gap_, q.gap_ratio));
  if (q.sand > casefile::coarsest_grain * q.pipe)
    flags.wrong(
        fmt::format("--sand = {} is more than a tenth of --pipe = {}: too coarse to show a hole", sand_, pipe_));
  if (!depth_.empty() && q.depth < (q.gap_ratio + 2) * q.pipe)
    flags.wrong(
        fmt::format("--depth = {} leaves less than one pipe diameter of water above the pipe: give at least {:.4g} m",
                    depth_, (q.gap_ratio + 2) * q.pipe));
  flags.report();
  const double theta = casefile::expect(casefile::scene_of(q)).theta;
  if (theta < 1e-3 || theta > 5)
    flags.wrong(fmt::format("--current = {} gives the Shields parameter {:.3g} on sand of {}, outside [0.001, 5]",
                            current_, theta, sand_));
  flags.report();
  return q;
}

}  // namespace livebed::app
