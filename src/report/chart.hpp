#pragma once
#include <limits>
#include <string>
#include <vector>

namespace livebed::report {

/// A curve or a cloud of points of a chart.
struct Curve {
  std::string name;    ///< in the legend; empty = not listed
  std::string colour;  ///< CSS
  std::vector<double> x, y;
  bool dots = false;
  bool dashed = false;
};

/// An area between two curves over the same x.
struct Band {
  std::string name, colour;
  std::vector<double> x, low, high;
};

struct Axis {
  std::string name;
  double from = std::numeric_limits<double>::quiet_NaN();  ///< NaN = fit the data
  double to = std::numeric_limits<double>::quiet_NaN();
  bool logarithmic = false;             ///< y only; what is not positive is left out
  std::vector<std::string> words = {};  ///< x only: what stands at 0, 1, 2, ... instead of numbers
};

struct Chart {
  Axis x, y;
  std::vector<Curve> curves;
  int width = 560, height = 320;
  bool equal_scales = false;     ///< one unit is as long in y as in x: the height follows from the width
  std::vector<Band> bands = {};  ///< behind the curves
};

/// The chart as one <svg> element whose ink follows the page's text colour.  Long curves are thinned to their smallest
/// and largest value per pixel.  Curves without a finite point are left out.
std::string svg(const Chart& chart);

/// Text made safe for HTML.
std::string escaped(const std::string& text);

}  // namespace livebed::report
