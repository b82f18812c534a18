#include "validate/picture.hpp"

#include <fmt/format.h>
#include <set>

namespace livebed::validate {

namespace {

constexpr int line = 18, left = 74;

/// The drawing alone, as an <svg> element.  The chart is an element of a page, whose style and legend it does without
/// here.
struct Element {
  std::string svg;
  int width, height;
};
Element element(const report::Chart& chart) {
  Element e{report::svg(chart), chart.width, 0};
  const std::size_t end = e.svg.find("</svg><div");
  if (end != std::string::npos) e.svg.erase(end + 6);
  const std::string view = fmt::format("viewBox=\"0 0 {} ", chart.width);
  e.height = std::stoi(e.svg.substr(e.svg.find(view) + view.size()));
  const std::string width = fmt::format("width=\"{}\"", chart.width);
  e.svg.replace(e.svg.find(width), width.size(), fmt::format("{} height=\"{}\"", width, e.height));
  return e;
}

/// What the curves and bands of the charts are called, each once, one below the other from y on; y <- below them.
std::string legend(const std::vector<const report::Chart*>& charts, int& y) {
  std::string out;
  std::set<std::pair<std::string, std::string>> listed;
  const auto list = [&](const std::string& name, const std::string& colour, auto&& sign) {
    if (name.empty() || !listed.emplace(name, colour).second) return;
    y += line;
    out += sign() + fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", left + 30, y, report::escaped(name));
  };
  for (const report::Chart* chart : charts) {
    for (const report::Curve& c : chart->curves) {
      if (c.x.empty()) continue;
      list(c.name, c.colour, [&] {
        return c.dots ? fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>", left + 11, y - 4, c.colour)
                      : fmt::format("<path d=\"M{} {}h22\" stroke=\"{}\" stroke-width=\"2\"{}/>", left, y - 4, c.colour,
                                    c.dashed ? " stroke-dasharray=\"5 4\"" : "");
      });
    }
    for (const report::Band& b : chart->bands)
      list(b.name, b.colour, [&] {
        return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"22\" height=\"10\" fill=\"{}\"/>", left, y - 9, b.colour);
      });
  }
  return out;
}

std::string page(int width, int height, const std::string& inner) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">"
      "<style>text{{font:12px sans-serif;fill:#111}}.axis path{{stroke:#ddd}}.axis "
      "rect{{fill:none;stroke:#777}}</style>"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>{2}</svg>\n",
      width, height, inner);
}

}  // namespace

std::string picture(const report::Chart& chart) {
  const Element e = element(chart);
  int y = e.height;
  const std::string entries = legend({&chart}, y);
  return page(e.width, y + line, e.svg + entries);
}

std::string panels(const std::vector<Panel>& all, int columns) {
  std::string inner;
  int width = 0, y = 0, row_height = 0, column = 0;
  for (const Panel& panel : all) {
    const Element e = element(panel.chart);
    if (column == columns) column = 0, y += row_height;
    const int x = column * e.width;
    inner += fmt::format("<text x=\"{}\" y=\"{}\" font-weight=\"bold\">{}</text><svg x=\"{}\" y=\"{}\">{}</svg>",
                         x + left, y + line, report::escaped(panel.title), x, y + line, e.svg);
    row_height = e.height + line;
    width = std::max(width, x + e.width);
    ++column;
  }
  y += row_height;
  std::vector<const report::Chart*> charts;
  for (const Panel& panel : all) charts.push_back(&panel.chart);
  inner += legend(charts, y);
  return page(width, y + line, inner);
}

}  // namespace livebed::validate
