#include "validate/picture.hpp"

#include <fmt/format.h>

namespace livebed::validate {

std::string picture(const report::Chart& chart) {
  constexpr int line = 18, left = 74;
  // The chart is an element of a page, whose style and legend it does without here.
  std::string inner = report::svg(chart);
  inner.erase(inner.find("</svg><div") == std::string::npos ? inner.size() : inner.find("</svg><div") + 6);
  const std::string width = fmt::format("width=\"{}\"", chart.width);
  inner.replace(inner.find(width), width.size(), fmt::format("{} height=\"{}\"", width, chart.height));
  std::string legend;
  int y = chart.height;
  for (const report::Curve& curve : chart.curves) {
    if (curve.name.empty()) continue;
    y += line;
    legend += curve.dots
                  ? fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>", left + 11, y - 4, curve.colour)
                  : fmt::format("<path d=\"M{} {}h22\" stroke=\"{}\" stroke-width=\"2\"{}/>", left, y - 4, curve.colour,
                                curve.dashed ? " stroke-dasharray=\"5 4\"" : "");
    legend += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", left + 30, y, report::escaped(curve.name));
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">"
      "<style>text{{font:12px sans-serif;fill:#111}}.axis path{{stroke:#ddd}}.axis "
      "rect{{fill:none;stroke:#777}}</style>"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>{2}{3}</svg>\n",
      chart.width, y + line, inner, legend);
}

}  // namespace livebed::validate
