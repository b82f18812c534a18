#include "report/chart.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "report/ticks.hpp"

namespace livebed::report {

namespace {

constexpr int left = 74, right = 14, top = 12, bottom = 44;

struct Range {
  double from = std::numeric_limits<double>::infinity(), to = -std::numeric_limits<double>::infinity();
  void take(double v) {
    from = std::min(from, v);
    to = std::max(to, v);
  }
  bool empty() const { return !(to >= from); }
};

/// y as drawn: itself or its decimal logarithm.
double height_of(const Axis& axis, double y) { return axis.logarithmic ? std::log10(y) : y; }

bool drawable(const Axis& y_axis, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (!y_axis.logarithmic || y > 0);
}

/// The range of the data widened a little, where the axis does not fix it.
Range fitted(const Axis& axis, Range data) {
  if (data.empty()) data = {0, 1};
  if (data.to == data.from) {
    const double pad = data.from == 0 ? 1 : 0.1 * std::abs(data.from);
    data = {data.from - pad, data.to + pad};
  }
  const double margin = 0.04 * (data.to - data.from);
  Range result{data.from - margin, data.to + margin};
  if (!axis.logarithmic && data.from >= 0 && data.from < 0.3 * data.to)
    result.from = 0;  // charts of amounts start at zero
  if (!std::isnan(axis.from)) result.from = height_of(axis, axis.from);
  if (!std::isnan(axis.to)) result.to = height_of(axis, axis.to);
  return result;
}

/// Keeps the first, smallest, largest and last point of each of `bins` stretches, so that no peak is lost.
std::vector<std::pair<double, double>> thinned(std::vector<std::pair<double, double>> points, std::size_t bins) {
  if (points.size() <= 4 * bins) return points;
  std::vector<std::pair<double, double>> kept;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto from = points.begin() + static_cast<std::ptrdiff_t>(b * points.size() / bins);
    const auto to = points.begin() + static_cast<std::ptrdiff_t>((b + 1) * points.size() / bins);
    const auto [low, high] =
        std::minmax_element(from, to, [](const auto& p, const auto& q) { return p.second < q.second; });
    for (const auto& p : {*from, *std::min(low, high), *std::max(low, high), *(to - 1)})
      if (kept.empty() || kept.back() != p) kept.push_back(p);
  }
  return kept;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  return safe;
}

std::string svg(const Chart& chart) {
  Range data_x, data_y;
  for (const Curve& curve : chart.curves)
    for (std::size_t n = 0; n < curve.x.size(); ++n)
      if (drawable(chart.y, curve.x[n], curve.y[n])) {
        data_x.take(curve.x[n]);
        data_y.take(height_of(chart.y, curve.y[n]));
      }
  for (const Band& band : chart.bands)
    for (std::size_t n = 0; n < band.x.size(); ++n)
      for (double y : {band.low[n], band.high[n]})
        if (drawable(chart.y, band.x[n], y)) {
          data_x.take(band.x[n]);
          data_y.take(height_of(chart.y, y));
        }
  const Range rx = fitted(chart.x, data_x), ry = fitted(chart.y, data_y);
  const double width = chart.width - left - right;
  const double height =
      chart.equal_scales ? width * (ry.to - ry.from) / (rx.to - rx.from) : chart.height - top - bottom;
  const auto px = [&](double x) { return left + width * (x - rx.from) / (rx.to - rx.from); };
  const auto py = [&](double y) { return top + height * (ry.to - y) / (ry.to - ry.from); };

  std::string out = fmt::format(
      R"svg(<svg class="chart" viewBox="0 0 {} {:.0f}" width="{}" role="img" aria-label="{} against {}">)svg",
      chart.width, height + top + bottom, chart.width, escaped(chart.y.name), escaped(chart.x.name));
  out += R"svg(<g class="axis">)svg";
  const auto mark_x = [&](double x, const std::string& label) {
    out += fmt::format(
        R"svg(<path d="M{0:.1f} {1}V{2:.1f}"/><text x="{0:.1f}" y="{3:.1f}" text-anchor="middle">{4}</text>)svg", px(x),
        top, top + height, top + height + 16, escaped(label));
  };
  if (chart.x.words.empty()) {
    const Ticks tx = ticks(rx.from, rx.to, chart.width / 80);
    for (double t : tx.places) mark_x(t, tx.text(t));
  } else {
    for (std::size_t n = 0; n < chart.x.words.size(); ++n) mark_x(static_cast<double>(n), chart.x.words[n]);
  }
  const Ticks ty = ticks(ry.from, ry.to, static_cast<int>(std::max(2.0, height / 45)));
  for (double t : ty.places) {
    if (chart.y.logarithmic && t != std::round(t)) continue;
    const std::string label = chart.y.logarithmic ? fmt::format("1e{:.0f}", t) : ty.text(t);
    out += fmt::format(R"svg(<path d="M{0} {1:.1f}H{2}"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)svg",
                       left, py(t), left + width, left - 6, py(t) + 4, label);
  }
  out += fmt::format(R"svg(<rect x="{}" y="{}" width="{}" height="{:.1f}"/>)svg", left, top, width, height);
  out += fmt::format(R"svg(<text x="{:.0f}" y="{:.0f}" text-anchor="middle">{}</text>)svg", left + width / 2,
                     top + height + 36, escaped(chart.x.name));
  out += fmt::format(R"svg(<text transform="translate(14 {:.0f}) rotate(-90)" text-anchor="middle">{}</text></g>)svg",
                     top + height / 2, escaped(chart.y.name));

  // An inner <svg> clips what leaves the frame.
  out += fmt::format(R"svg(<svg x="{0}" y="{1}" width="{2}" height="{3:.1f}" viewBox="{0} {1} {2} {3:.1f}">)svg", left,
                     top, width, height);
  for (const Band& band : chart.bands) {
    std::string there, back;  // along the upper edge and back along the lower one
    for (std::size_t n = 0; n < band.x.size(); ++n) {
      if (!drawable(chart.y, band.x[n], band.low[n]) || !drawable(chart.y, band.x[n], band.high[n])) continue;
      there += fmt::format("{}{:.1f} {:.1f}", there.empty() ? "M" : "L", px(band.x[n]),
                           py(height_of(chart.y, band.high[n])));
      back = fmt::format("L{:.1f} {:.1f}", px(band.x[n]), py(height_of(chart.y, band.low[n]))) + back;
    }
    if (!there.empty())
      out += fmt::format(R"svg(<path class="band" d="{}{}Z" fill="{}" fill-opacity="0.22"/>)svg", there, back,
                         band.colour);
  }
  for (const Curve& curve : chart.curves) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t n = 0; n < curve.x.size(); ++n)
      if (drawable(chart.y, curve.x[n], curve.y[n]))
        points.emplace_back(px(curve.x[n]), py(height_of(chart.y, curve.y[n])));
    if (points.empty()) continue;
    if (curve.dots) {
      for (const auto& [x, y] : points)
        out += fmt::format(R"svg(<circle cx="{:.1f}" cy="{:.1f}" r="3" fill="{}"/>)svg", x, y, curve.colour);
      continue;
    }
    std::string path;
    for (const auto& [x, y] : thinned(std::move(points), static_cast<std::size_t>(width)))
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    out += fmt::format(R"svg(<path d="{}" fill="none" stroke="{}" stroke-width="1.8"{}/>)svg", path, curve.colour,
                       curve.dashed ? R"svg( stroke-dasharray="5 4")svg" : "");
  }
  out += "</svg></svg>";

  std::string legend;
  const auto entry = [&](const char* kind, const std::string& colour, const std::string& name) {
    if (!name.empty())
      legend += fmt::format(R"svg(<span><i class="{}" style="--c:{}"></i>{}</span> )svg", kind, colour, escaped(name));
  };
  for (const Curve& curve : chart.curves)
    entry(curve.dots ? "dot" : curve.dashed ? "dash" : "line", curve.colour, curve.name);
  for (const Band& band : chart.bands) entry("band", band.colour, band.name);
  return legend.empty() ? out : out + "<div class=\"legend\">" + legend + "</div>";
}

}  // namespace livebed::report
