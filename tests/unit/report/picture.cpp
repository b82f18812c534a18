#include "report/picture.hpp"

#include <gtest/gtest.h>

namespace livebed::report {
namespace {

constexpr Colour white{255, 255, 255}, black{0, 0, 0};

double darkness(const Picture& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) sum += (255 - picture.at(x, y).r) / 255.0;
  return sum;
}

TEST(picture, discs_and_lines_cover_their_area) {
  Picture disc(60, 60, white);
  disc.disc(30.3, 29.6, 20, black);
  EXPECT_NEAR(darkness(disc), 3.14159265 * 400, 0.01 * 3.14159265 * 400);
  Picture line(60, 60, white);
  line.line(10, 10, 40, 50, 3, black);  // 50 long, with round ends
  EXPECT_NEAR(darkness(line), 50 * 3 + 3.14159265 * 2.25, 6);
}

TEST(picture, drawing_outside_is_clipped) {
  Picture picture(10, 10, white);
  picture.disc(-20, 5, 4, black);
  picture.line(-5, 30, 60, 30, 2, black);
  picture.text(20, 20, "far", 2, black);
  picture.rectangle(-5, -5, 0, 20, black);
  EXPECT_EQ(darkness(picture), 0);
  picture.rectangle(-5, -5, 2, 3, black);
  EXPECT_EQ(darkness(picture), 6);
}

TEST(picture, letters_have_their_dots) {
  Picture picture(20, 20, white);
  picture.text(1, 1, "I", 2, black);  // 2 + 7 + 2 dots of 4 pixels
  EXPECT_EQ(darkness(picture), 11 * 4);
}

TEST(picture, colour_maps_run_from_end_to_end_and_clamp) {
  EXPECT_EQ(viridis(0).r, 68);
  EXPECT_EQ(viridis(1).g, 231);
  EXPECT_EQ(viridis(7).g, 231);
  EXPECT_EQ(viridis(-1).b, 84);
  EXPECT_EQ(viridis(0.0 / 0.0).b, 84);
  double before = -1;  // brightness rises all the way
  for (int n = 0; n <= 100; ++n) {
    const Colour c = viridis(n / 100.0);
    const double brightness = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    EXPECT_GT(brightness, before);
    before = brightness;
  }
}

}  // namespace
}  // namespace livebed::report
