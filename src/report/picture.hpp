#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace livebed::report {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
};

/// Viridis, the perceptually uniform map of matplotlib: s in [0, 1] (values outside are clamped).
Colour viridis(double s);
/// Sand: tan at 0 over orange to dark red at 1.
Colour sand(double s);

/// A raster of pixels, (0,0) at the top left; drawing is antialiased and clipped.  Positions are in pixels.
class Picture {
public:
  Picture(int width, int height, Colour background);

  int width() const { return width_; }
  int height() const { return height_; }
  Colour at(int x, int y) const;

  void set(int x, int y, Colour colour);
  void blend(int x, int y, Colour colour, double opacity);
  void rectangle(double x0, double y0, double x1, double y1, Colour colour);
  void disc(double x, double y, double radius, Colour colour);
  void line(double x0, double y0, double x1, double y1, double thickness, Colour colour, double opacity = 1);
  /// Printable ASCII in a 5 x 7 dot matrix, each dot `scale` pixels wide; (x, y) is the top left corner.
  void text(int x, int y, std::string_view letters, int scale, Colour colour);
  static int text_width(std::string_view letters, int scale) { return static_cast<int>(letters.size()) * 6 * scale; }

  /// The file's bytes.
  std::string png() const;

private:
  int width_, height_;
  std::vector<std::uint8_t> rgb_;
};

}  // namespace livebed::report
