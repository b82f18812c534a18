#include "validate/result.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "base/version.hpp"
#include "io/file.hpp"
#include "validate/bedload.hpp"
#include "validate/cavity.hpp"
#include "validate/channel.hpp"
#include "validate/cylinder.hpp"
#include "validate/design_chart.hpp"
#include "validate/duct.hpp"
#include "validate/grains.hpp"
#include "validate/mao.hpp"
#include "validate/mao_study.hpp"
#include "validate/oner.hpp"
#include "validate/step.hpp"

namespace livebed::validate {

namespace {

/// FNV-1a of 64 bits.
std::string hash(const std::string& text) {
  std::uint64_t h = 14695981039346656037ull;
  for (const unsigned char c : text) h = (h ^ c) * 1099511628211ull;
  return fmt::format("{:016x}", h);
}

/// A case of several runs, all of them.
template <Result (*some)(const Only&, const Tell&)>
Result all_of(const Tell& tell) {
  return some({}, tell);
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"cavity", "lid-driven cavity, Re 100 and 1000, against Ghia et al. (1982)", cavity},
      {"cylinder", "free cylinder, Re 20, 40 and 100: drag, bubble, shedding against the literature", cylinder},
      {"duct", "cylinder in a channel, Re 20: drag and lift against Schaefer and Turek (1996), order of the cut cells",
       duct},
      {"channel", "open channel, each closure against the log law and direct numerical simulation", channel},
      {"step", "backward-facing step of Driver and Seegmiller (1985), each closure: reattachment, Cf, Cp, profiles",
       step},
      {"step-walls", "the same step with its walls resolved: k-omega SST as it is published", step_walls},
      {"grains", "grains: oblique impacts, energy of a gas, rest for every damping, heaps, bins", grains},
      {"bedload", "sand on a flat bed: fall speed, heap, threshold and rate of transport, 2 mm and 0.36 mm", bedload},
      {"sheet-flow", "sheet flow of Revil-Baudard et al. (2015): speed and solid fraction over the height", sheet_flow},
      {"mao", "live-bed scour of Mao (1986), his sand of 0.36 mm, in seconds: depth in time, bed profiles; hours",
       all_of<mao>, mao},
      {"mao-1mm", "the same with grains of 1 mm on a deep bed, time scaled", all_of<mao_1mm>, mao_1mm},
      {"mao-0.7mm", "the same with grains of 0.7 mm", all_of<mao_07mm>, mao_07mm},
      {"mao-2mm-livebed", "the same with grains of 2 mm: cases/mao, not the paper's model", all_of<mao_2mm>, mao_2mm},
      {"mao-2mm", "the same with the paper's grains of 2 mm, time scaled: Figures 11 and 12", all_of<mao_paper>,
       mao_paper},
      {"mao-study",
       "the same with grains of 0.7 mm, one thing changed at a time: grid, steps, parts of the model; hours",
       all_of<mao_study>, mao_study},
      {"design-chart", "live-bed scour over gap and Shields number: depth and time scale against formulas; hours",
       all_of<design_chart>, design_chart},
      {"oner", "current past a pipe near the bed, 540 x 94 cells: the paper's Figures 3-8, each closure and gap", oner},
      {"oner-layer", "a laminar boundary layer on the pipe beside a turbulent one", oner_layer},
      {"oner-depth", "what sets its Strouhal number: depth, approach profile, scheme, grid", oner_depth},
      {"oner-fine", "the same on the paper's 1500 x 260 cells: k-epsilon, e/D 0.3", oner_fine},
      {"oner-fine-bed", "the same, e/D 0", oner_fine_bed},
      {"oner-fine-closures", "on the paper's grid, e/D 0.3: realizable k-epsilon and k-omega SST", oner_fine_closures},
      {"oner-fine-bed-closures", "the same, e/D 0", oner_fine_bed_closures},
  };
  return all;
}

bool Result::pass() const {
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.pass(); });
}

std::string to_json(const Result& result) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : result.rows) {
    nlohmann::ordered_json entry = {{"name", row.name}, {"value", row.value}, {"unit", row.unit}};
    entry["target"] = row.judged() ? nlohmann::ordered_json{row.low, row.high} : nlohmann::ordered_json(nullptr);
    entry["pass"] = row.judged() ? nlohmann::ordered_json(row.pass()) : nlohmann::ordered_json(nullptr);
    entry["reference"] = row.reference;
    entry["setup"] = row.setup;
    entry["setup_hash"] = hash(row.setup);
    entry["commit"] = row.commit.empty() ? std::string(base::commit()) : row.commit;
    entry["wall_s"] = row.seconds;
    list.push_back(entry);
  }
  return list.dump(1) + "\n";
}

std::vector<Row> rows_of_json(const std::string& text, const std::string& source) {
  try {
    std::vector<Row> rows;
    for (const nlohmann::json& entry : nlohmann::json::parse(text)) {
      Row row{entry.at("name"), entry.at("value").is_null() ? std::nan("") : entry.at("value").get<double>(),
              entry.at("unit")};
      if (!entry.at("target").is_null()) row.low = entry.at("target").at(0), row.high = entry.at("target").at(1);
      row.reference = entry.at("reference"), row.setup = entry.at("setup");
      row.seconds = entry.at("wall_s"), row.commit = entry.at("commit");
      rows.push_back(row);
    }
    return rows;
  } catch (const nlohmann::json::exception& e) {
    base::fail(base::Exit::input_output, "{} is no list of results of `livebed validate`: {}", source, e.what());
  }
}

void keep_rows(const std::filesystem::path& file, const std::vector<std::string>& but, Result& result) {
  if (!std::filesystem::exists(file)) return;
  for (Row& row : rows_of_json(io::read_file(file), file.string()))
    if (std::none_of(but.begin(), but.end(),
                     [&](const std::string& label) { return row.name.starts_with(label + ": "); }))
      result.rows.push_back(std::move(row));
}

}  // namespace livebed::validate
