#include "report/pack.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <zlib.h>

namespace livebed::report {
namespace {

template <class Number>
Number at(const std::string& bytes, std::size_t place) {
  Number value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

TEST(pack, arrays_stand_where_the_page_looks_for_them) {
  Pack pack;
  pack.head = {{"time", 0.25}};
  pack.floats("x", std::vector<double>{0.5, -1.5, 2});
  pack.bytes("share", std::vector<double>{0, 0.5, 1});
  pack.shorts("speed", std::vector<double>{2, 4, 3});
  const std::string bytes = pack.str();
  EXPECT_EQ(bytes.substr(0, 4), "LBP1");
  const auto size = at<std::uint32_t>(bytes, 4);
  EXPECT_EQ(size % 4, 0u);
  const auto head = nlohmann::json::parse(bytes.substr(8, size));
  EXPECT_EQ(head["time"], 0.25);
  ASSERT_EQ(head["arrays"].size(), 3u);
  EXPECT_EQ(head["arrays"][1],
            (nlohmann::json{{"name", "share"}, {"type", "u1"}, {"count", 3}, {"from", 0}, {"to", 1}}));
  const std::size_t start = 8 + size;
  EXPECT_EQ(at<float>(bytes, start + 4), -1.5f);
  EXPECT_EQ(at<std::uint8_t>(bytes, start + 12 + 1), 128);
  EXPECT_EQ(at<std::uint16_t>(bytes, start + 16 + 2), 65535);  // behind three bytes and one of padding
  EXPECT_EQ(at<std::uint16_t>(bytes, start + 16 + 4), 32768);
  EXPECT_EQ(bytes.size(), start + 12 + 4 + 8);
}

TEST(pack, equal_and_missing_values_do_no_harm) {
  Pack pack;
  pack.shorts("same", std::vector<double>{7, 7});
  pack.bytes("none", {});
  const std::string bytes = pack.str();
  const auto head = nlohmann::json::parse(bytes.substr(8, at<std::uint32_t>(bytes, 4)));
  EXPECT_EQ(head["arrays"][0]["from"], 7);
  EXPECT_EQ(head["arrays"][1]["count"], 0);
}

TEST(pack, what_is_deflated_can_be_inflated) {
  std::string text;
  for (int n = 0; n < 1000; ++n) text += "grain ";
  const std::string small = deflated(text);
  EXPECT_LT(small.size(), 100u);
  std::string back(text.size(), ' ');
  uLongf size = back.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(back.data()), &size, reinterpret_cast<const Bytef*>(small.data()),
                       small.size()),
            Z_OK);
  EXPECT_EQ(back, text);
}

}  // namespace
}  // namespace livebed::report
