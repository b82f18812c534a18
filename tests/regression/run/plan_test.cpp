#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

/// `livebed new` of a question and `livebed plan`.  How long something takes is never tested.
namespace livebed {
namespace {

const std::string question = "--pipe 0.5m --current 0.8 --sand 0.2mm --gap 0";
const std::string quickly = " --seconds 0.3";

class Plan : public Program {};

TEST_F(Plan, of_the_engineers_question_tells_what_to_expect_and_what_larger_grains_lose) {
  const Result text = run("plan " + question + quickly);
  EXPECT_EQ(text.exit, 0) << text.err;
  expect_contains(text.out, {"live bed", "0.3 m ± 0.1 m", "Sumer and Fredsøe 2002", "not checked in its source",
                             "three-dimensional", "Out of reach in 12 h", "compare in t/T"});
  const auto json = nlohmann::json::parse(run("plan " + question + " --json" + quickly).out);
  const auto &sand = json["expected"], &grains = json["larger_grains"];
  EXPECT_NEAR(sand["theta"].get<double>(), 0.27, 0.001);
  EXPECT_NEAR(sand["T_s"].get<double>(), 3904, 20);
  EXPECT_NEAR(grains["expected"]["theta"].get<double>(), sand["theta"].get<double>(), 1e-9);
  EXPECT_GT(grains["diameter_m"].get<double>(), 0.2e-3);
  EXPECT_LE(grains["prediction"]["wall_s"].get<double>(), 12 * 3600);
  for (const char* number : {"theta_critical", "fall_speed_m_s", "S_eq_over_D", "T_s", "undermined_s"})
    EXPECT_TRUE(json["formulas"].contains(number) && json["expected"][number].is_number()) << number;
  expect_contains(json["formulas"]["S_eq_over_D"]["formula"], {"Sumer and Fredsøe 2002"});
  EXPECT_FALSE(json["formulas"]["S_eq_over_D"]["text_seen_in_source"].get<bool>());
  EXPECT_FALSE(json["fits"].get<bool>());
  EXPECT_NEAR(json["work"]["grains"].get<double>(), 1.54e8, 0.02e8);
  EXPECT_TRUE(everything_in(folder()).empty());
}

TEST_F(Plan, of_a_case_predicts_all_parts_and_leaves_nothing) {
  const auto json = nlohmann::json::parse(run("plan " + small_case + " --sand 0.36mm --json" + quickly).out);
  double sum = 0;
  for (const auto& [name, part] : json["prediction"]["parts"].items()) {
    EXPECT_GT(part.get<double>(), 0) << name;
    sum += part.get<double>();
  }
  EXPECT_NEAR(json["prediction"]["wall_s"].get<double>(), sum, 1e-9 * sum);
  EXPECT_EQ(json["expected"]["regime"], "live bed");
  EXPECT_NEAR(json["sand"]["theta"].get<double>(), json["expected"]["theta"].get<double>(), 1e-9);
  EXPECT_NEAR(json["sand"]["T_s"].get<double>() / json["expected"]["T_s"].get<double>(), std::pow(2 / 0.36, 1.5), 1e-6);
  EXPECT_TRUE(json["fits"].get<bool>());
  EXPECT_FALSE(json.contains("larger_grains"));
  EXPECT_TRUE(everything_in(folder()).empty());
}

TEST_F(Plan, of_a_case_that_does_not_fit_proposes_larger_grains) {
  const auto json = nlohmann::json::parse(
      run("plan " + small_case + " --set grains.diameter=1mm --set current.mean_speed=1 --hours 1e-6 --json" + quickly)
          .out);
  EXPECT_FALSE(json["fits"].get<bool>());
  EXPECT_FALSE(json["larger_grains"]["fits"].get<bool>());  // no size fits into a hundredth of a second
  EXPECT_NEAR(json["larger_grains"]["diameter_m"].get<double>(), 2e-3, 1e-9);  // a tenth of the pipe
}

TEST_F(Plan, refuses_what_it_cannot_answer_and_says_what_to_do) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> wrong{
      {"plan", {"Give a case file, or a question"}},
      {"plan --pipe 0.5m", {"--sand is missing", "--current or --theta is missing"}},
      {"plan --pipe 0.5m --sand 0.2 --current 0.8", {"--sand = 0.2 is 0.2 m, outside", "give a unit"}},
      {"plan --pipe 0.5kg --sand 0.2mm --current 0.8", {"--pipe = 0.5kg has the wrong unit kg; a length"}},
      {"plan --pipe wide --sand 0.2mm --current 0.8", {"--pipe = wide is not a number with a unit"}},
      {"plan --pipe 5cm --sand 9mm --current 0.8", {"more than a tenth of --pipe"}},
      {"plan --pipe 5cm --sand 1mm --current 0.8 --theta 0.3", {"contradict each other"}},
      {"plan --pipe 5cm --sand 1mm --current 0.8 --depth 6cm", {"give at least 0.1 m"}},
      {"plan --pipe 5cm --sand 1mm --current 0.01", {"Shields parameter", "outside [0.001, 5]"}},
      {"plan --pipe 5cm --sand 1mm --current 0.8 --gap 1m", {"e/D = 20, outside [-1, 5]"}},
      {"plan " + small_box + " --pipe 5cm", {"a case and a question at once"}},
      {"plan --set bed.seed=2 " + question, {"write it with livebed new first"}},
      {"new quick " + question, {"give one of them"}},
      {"new", {"--pipe 0.5m --current 0.8 --sand 0.2mm", "mao-mbs2d"}},
  };
  for (const auto& [words, sentences] : wrong) {
    const Result result = run(words);
    EXPECT_EQ(result.exit, 2) << words;
    EXPECT_EQ(result.out, "") << words;
    expect_contains(result.err, sentences);
  }
}

TEST_F(Plan, new_writes_a_case_of_the_question_that_passes_the_check) {
  const Result enlarged = run("new " + question + " --hours 100 --out sea.toml" + quickly);
  EXPECT_EQ(enlarged.exit, 0) << enlarged.err;
  expect_contains(enlarged.err, {"ENLARGED GRAINS", "theta", "fall speed", "time scale", "livebed plan sea.toml"});
  expect_contains(content(*this / "sea.toml"), {"ENLARGED GRAINS", "theta = 0.2697"});
  EXPECT_EQ(run("check sea.toml").exit, 0);
  const std::string kept = content(*this / "sea.toml");
  EXPECT_EQ(run("new " + question + " --out sea.toml").exit, 5);
  EXPECT_EQ(content(*this / "sea.toml"), kept);

  const Result real = run("new --pipe 2cm --theta 0.3 --sand 2mm --gap 5mm --hours 1000" + quickly);
  EXPECT_EQ(real.exit, 0) << real.err;
  EXPECT_EQ(real.err.find("ENLARGED"), std::string::npos);
  expect_contains(real.out, {"diameter = \"2 mm\"", "gap_ratio = 0.25"});
}

TEST_F(Plan, new_says_when_no_size_fits) {
  const Result result = run("new " + question + " --hours 1e-6" + quickly);
  EXPECT_EQ(result.exit, 2);
  EXPECT_EQ(result.out, "");
  expect_contains(result.err, {"50 mm", "give more than --hours 1e-06"});
}

}  // namespace
}  // namespace livebed
