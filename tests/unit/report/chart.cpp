#include "report/chart.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "report/ticks.hpp"

namespace livebed::report {
namespace {

TEST(chart, ticks_are_round_and_inside) {
  EXPECT_EQ(ticks(0, 1, 5).places.size(), 6u);
  EXPECT_EQ(ticks(0, 1, 5).text(0.2), "0.2");
  EXPECT_EQ(ticks(0, 7.1, 7).places.back(), 7);
  EXPECT_EQ(ticks(0, 7.1, 7).text(7), "7");
  const Ticks small = ticks(-0.0031, 0.0042, 6);
  EXPECT_EQ(small.step, 0.001);
  EXPECT_EQ(small.places.front(), -0.003);
  EXPECT_EQ(small.text(-0.003), "-0.003");
  EXPECT_EQ(ticks(0, 3e-7, 3).text(1e-7), "1e-07");
  EXPECT_TRUE(ticks(1, 1, 5).places.empty());
  EXPECT_TRUE(ticks(0, NAN, 5).places.empty());
}

TEST(chart, points_land_where_the_axes_say) {
  Chart chart{{"x", 0, 10}, {"y", 0, 1}, {{"", "red", {0, 5, 10}, {0, 0.5, 1}, true}}, 188, 156};
  const std::string text = svg(chart);  // 100 x 100 inside the margins
  EXPECT_NE(text.find(R"(cx="74.0" cy="112.0")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"(cx="124.0" cy="62.0")"), std::string::npos);
  EXPECT_NE(text.find(R"(cx="174.0" cy="12.0")"), std::string::npos);
}

TEST(chart, a_band_fills_what_lies_between_its_edges_and_belongs_to_the_range) {
  Chart chart{{"x", 0, 10}, {"y", 0, 1}, {}, 188, 156};
  chart.bands = {{"seeds", "red", {0, 5, 10}, {0, 0.25, 0.5}, {0.5, NAN, 1}}};
  const std::string text = svg(chart);  // the point without an upper edge is left out
  EXPECT_NE(text.find(R"(d="M74.0 62.0L174.0 12.0L174.0 62.0L74.0 112.0Z")"), std::string::npos) << text;
  EXPECT_NE(text.find(R"(<i class="band" style="--c:red"></i>seeds)"), std::string::npos);
}

TEST(chart, words_stand_on_an_axis_without_numbers) {
  Chart chart{{"law", -1, 3}, {"y", 0, 1}, {{"", "red", {0, 1, 2}, {0, 0.5, 1}, true}}, 188, 156};
  chart.x.words = {"paper", "a<b", "rong"};
  const std::string text = svg(chart);
  EXPECT_NE(text.find(R"(x="99.0" y="128.0" text-anchor="middle">paper<)"), std::string::npos) << text;
  EXPECT_NE(text.find("a&lt;b"), std::string::npos);
  EXPECT_EQ(text.find(">1.5<"), std::string::npos);
}

TEST(chart, the_same_chart_is_the_same_text) {
  const Chart chart{{"x"}, {"y"}, {{"a", "red", {0, 1}, {0, 1}}}};
  EXPECT_EQ(svg(chart), svg(chart));
}

TEST(chart, long_curves_are_thinned_without_losing_a_peak) {
  Curve curve{"long", "blue", {}, {}};
  for (int n = 0; n < 200000; ++n) {
    curve.x.push_back(n);
    curve.y.push_back(n == 77777 ? 5 : std::sin(0.001 * n));
  }
  const std::string text = svg({{"x"}, {"y", -1, 5}, {curve}});
  EXPECT_LT(text.size(), 60000u);
  EXPECT_NE(text.find(" 12.0"), std::string::npos);  // the peak touches the upper edge
}

TEST(chart, logarithms_leave_out_what_has_none_and_text_is_made_safe) {
  const std::string text =
      svg({{"a<b"}, {"y", NAN, NAN, true}, {{"c&d", "red", {1, 2, 3, 4}, {1e-6, 0, -1, 1e-2}, true}}});
  std::size_t circles = 0;
  for (auto at = text.find("<circle"); at != text.npos; at = text.find("<circle", at + 1)) ++circles;
  EXPECT_EQ(circles, 2u);
  EXPECT_NE(text.find("1e-4"), std::string::npos);
  EXPECT_NE(text.find("a&lt;b"), std::string::npos);
  EXPECT_NE(text.find("c&amp;d"), std::string::npos);
  EXPECT_EQ(svg({{"x"}, {"y"}, {}}).find("nan"), std::string::npos);  // no data at all
}

}  // namespace
}  // namespace livebed::report
