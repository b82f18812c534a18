#include "report/picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "io/png.hpp"
#include "report/font.hpp"

namespace livebed::report {

namespace {

/// Linear between equally spaced stops.
Colour along(std::span<const Colour> stops, double s) {
  const double last = static_cast<double>(stops.size() - 1);
  const double place = last * std::clamp(std::isfinite(s) ? s : 0.0, 0.0, 1.0);
  const auto a = static_cast<std::size_t>(std::min(place, last - 1));
  const double f = place - static_cast<double>(a);
  const auto mix = [f](std::uint8_t p, std::uint8_t q) {
    return static_cast<std::uint8_t>(std::lround(p + f * (q - p)));
  };
  return {mix(stops[a].r, stops[a + 1].r), mix(stops[a].g, stops[a + 1].g), mix(stops[a].b, stops[a + 1].b)};
}

}  // namespace

Colour viridis(double s) {
  static constexpr Colour stops[] = {{68, 1, 84},    {71, 24, 106},  {70, 47, 124},  {64, 69, 136},
                                     {56, 88, 140},  {48, 106, 142}, {41, 123, 142}, {35, 139, 141},
                                     {31, 155, 138}, {41, 171, 130}, {68, 187, 116}, {105, 201, 96},
                                     {148, 212, 70}, {193, 221, 48}, {234, 224, 46}, {253, 231, 37}};
  return along(stops, s);
}

Colour sand(double s) {
  static constexpr Colour stops[] = {{214, 190, 150}, {240, 170, 90}, {235, 110, 45}, {200, 45, 35}, {120, 10, 40}};
  return along(stops, s);
}

Picture::Picture(int width, int height, Colour background)
    : width_(width), height_(height), rgb_(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set(x, y, background);
}

Colour Picture::at(int x, int y) const {
  const std::uint8_t* p =
      rgb_.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  return {p[0], p[1], p[2]};
}

void Picture::set(int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  std::uint8_t* p =
      rgb_.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  p[0] = colour.r;
  p[1] = colour.g;
  p[2] = colour.b;
}

void Picture::blend(int x, int y, Colour colour, double opacity) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || opacity <= 0) return;
  const Colour below = at(x, y);
  const auto mix = [f = std::min(opacity, 1.0)](std::uint8_t p, std::uint8_t q) {
    return static_cast<std::uint8_t>(std::lround(p + f * (q - p)));
  };
  set(x, y, {mix(below.r, colour.r), mix(below.g, colour.g), mix(below.b, colour.b)});
}

void Picture::rectangle(double x0, double y0, double x1, double y1, Colour colour) {
  for (int y = static_cast<int>(std::lround(y0)); y < std::lround(y1); ++y)
    for (int x = static_cast<int>(std::lround(x0)); x < std::lround(x1); ++x) set(x, y, colour);
}

void Picture::disc(double x, double y, double radius, Colour colour) {
  const int x0 = static_cast<int>(std::floor(x - radius - 1)), x1 = static_cast<int>(std::ceil(x + radius + 1));
  const int y0 = static_cast<int>(std::floor(y - radius - 1)), y1 = static_cast<int>(std::ceil(y + radius + 1));
  for (int j = y0; j <= y1; ++j)
    for (int i = x0; i <= x1; ++i) blend(i, j, colour, radius + 0.5 - std::hypot(i + 0.5 - x, j + 0.5 - y));
}

void Picture::line(double x0, double y0, double x1, double y1, double thickness, Colour colour, double opacity) {
  const double length2 = (x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0), half = thickness / 2;
  const int i0 = static_cast<int>(std::floor(std::min(x0, x1) - half - 1)),
            i1 = static_cast<int>(std::ceil(std::max(x0, x1) + half + 1));
  const int j0 = static_cast<int>(std::floor(std::min(y0, y1) - half - 1)),
            j1 = static_cast<int>(std::ceil(std::max(y0, y1) + half + 1));
  for (int j = std::max(0, j0); j <= std::min(height_ - 1, j1); ++j)
    for (int i = std::max(0, i0); i <= std::min(width_ - 1, i1); ++i) {
      const double px = i + 0.5 - x0, py = j + 0.5 - y0;
      const double s = length2 > 0 ? std::clamp((px * (x1 - x0) + py * (y1 - y0)) / length2, 0.0, 1.0) : 0;
      const double distance = std::hypot(px - s * (x1 - x0), py - s * (y1 - y0));
      blend(i, j, colour, opacity * std::min(1.0, half + 0.5 - distance));
    }
}

void Picture::text(int x, int y, std::string_view letters, int scale, Colour colour) {
  for (const char letter : letters) {
    const int index = letter < ' ' || letter > '~' ? '?' - ' ' : letter - ' ';
    for (int column = 0; column < 5; ++column)
      for (int row = 0; row < 8; ++row)
        if (font[index][column] >> row & 1)
          rectangle(x + column * scale, y + row * scale, x + (column + 1) * scale, y + (row + 1) * scale, colour);
    x += 6 * scale;
  }
}

std::string Picture::png() const { return io::png(width_, height_, rgb_); }

}  // namespace livebed::report
