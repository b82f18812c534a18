#include "case/schema.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <toml++/toml.h>

#include "case/manual.hpp"
#include "case/read.hpp"

namespace livebed::casefile {
namespace {

bool is_word_of(const Row& row, const std::string& word) {
  return std::find(row.words.begin(), row.words.end(), word) != row.words.end();
}

TEST(schema, names_every_key_once_and_says_what_it_means) {
  std::set<std::string> names;
  for (const Row& row : schema()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.meaning.empty()) << row.name;
  }
}

TEST(schema, sets_what_it_gets) {
  for (const Row& row : schema()) {
    Case c;
    for (const std::string& word : row.words) {
      row.set(c, word);
      EXPECT_EQ(std::get<std::string>(row.get(c)), word) << row.name;
    }
    if (row.type == Type::real) {
      row.set(c, 0.123);
      EXPECT_EQ(std::get<double>(row.get(c)), 0.123) << row.name;
    }
    if (row.type == Type::integer) {
      row.set(c, 123LL);
      EXPECT_EQ(std::get<long long>(row.get(c)), 123) << row.name;
    }
    if (row.type == Type::flag) {
      for (const bool value : {true, false}) {
        row.set(c, value);
        EXPECT_EQ(std::get<bool>(row.get(c)), value) << row.name;
      }
    }
  }
}

TEST(schema, has_no_two_rows_for_one_number) {
  for (const Row& row : schema()) {
    if (row.type != Type::real && row.type != Type::integer) continue;
    Case c;
    const Case before;
    row.type == Type::real ? row.set(c, 0.123) : row.set(c, 123LL);
    for (const Row& other : schema())
      EXPECT_EQ(&other == &row, other.get(c) != other.get(before)) << row.name << " and " << other.name;
  }
}

TEST(schema, defaults_of_the_structs_and_presets_are_allowed) {
  for (const std::string& preset : presets()) {
    const Case c = preset_case(preset);
    EXPECT_EQ(c.preset, preset);
    for (const Row& row : schema()) {
      const Value value = row.get(c);
      const auto in_group = [&](const Alternatives& group) {
        return std::find(group.keys.begin(), group.keys.end(), row.name) != group.keys.end();
      };
      if (row.derived || std::any_of(alternatives().begin(), alternatives().end(), in_group)) continue;
      if (row.type == Type::real) {
        EXPECT_TRUE(row.range.contains(std::get<double>(value))) << row.name;
      }
      if (row.type == Type::word) {
        EXPECT_TRUE(is_word_of(row, std::get<std::string>(value))) << row.name;
      }
    }
  }
}

TEST(schema, presets_choose_known_words_for_known_keys) {
  for (const Choice& choice : choices()) {
    const Row* row = find_row(choice.key);
    ASSERT_TRUE(row) << choice.key;
    for (const std::string& word : {choice.mbs2d, choice.livebed})
      if (row->type == Type::word) {
        EXPECT_TRUE(word.empty() || is_word_of(*row, word)) << choice.key;
      }
  }
}

TEST(schema, preset_mbs2d_is_the_paper_and_livebed_is_not) {
  const Case paper = preset_case("mbs2d"), ours = preset_case("livebed");
  EXPECT_EQ(paper.grains.inertia, grains::Inertia::disk);
  EXPECT_EQ(paper.grains.tension, grains::Tension::spring);
  EXPECT_EQ(paper.grains.friction_limit, grains::FrictionLimit::spring_force);
  EXPECT_EQ(paper.grains.floor, grains::Floor::grains);
  EXPECT_EQ(paper.grains.spread, 0);
  EXPECT_EQ(paper.grains.damping, 1);
  EXPECT_EQ(paper.flow.convection, flow::Convection::hybrid);
  EXPECT_EQ(paper.coupling.exchange, coupling::Exchange::lagged);
  EXPECT_EQ(ours.grains.inertia, grains::Inertia::sphere);
  EXPECT_EQ(ours.grains.tension, grains::Tension::none);
  EXPECT_EQ(ours.grains.friction_limit, grains::FrictionLimit::total_force);
  EXPECT_EQ(ours.grains.floor, grains::Floor::grains);
  EXPECT_EQ(ours.grains.spread, 0.2);
  EXPECT_EQ(ours.coupling.voidage, coupling::Voidage::on);
  EXPECT_EQ(paper.coupling.voidage, coupling::Voidage::off);
  EXPECT_EQ(ours.grains.restitution, 0.3);
  EXPECT_EQ(ours.flow.convection, flow::Convection::bounded);
  EXPECT_EQ(ours.coupling.exchange, coupling::Exchange::implicit);
}

/// The file that says what is calibrated by what is no second place for the numbers.
TEST(presets, livebed_has_the_calibrated_constants) {
  const Case ours = preset_case("livebed");
  const toml::table file = toml::parse_file(LIVEBED_SOURCE_DIR "/cases/calibrated.toml");
  int constants = 0;
  for (const auto& [table, keys] : file)
    for (const auto& [key, value] : *keys.as_table()) {
      const std::string name = std::string(table.str()) + "." + std::string(key.str());
      const Row* row = find_row(name);
      ASSERT_NE(row, nullptr) << name;
      EXPECT_EQ(std::get<double>(row->get(ours)), *value.value<double>()) << name;
      ++constants;
    }
  EXPECT_GE(constants, 6);
}

TEST(manual, in_docs_is_the_one_the_schema_makes) {
  std::ifstream file(LIVEBED_SOURCE_DIR "/docs/keys.md");
  const std::string kept{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(kept, manual_markdown()) << "run: livebed keys --markdown > docs/keys.md";
}

TEST(manual, lists_every_key) {
  for (const std::string& preset : presets())
    for (const Row& row : schema())
      EXPECT_NE(manual_text(preset).find(row.name + " = "), std::string::npos) << row.name;
}

}  // namespace
}  // namespace livebed::casefile
