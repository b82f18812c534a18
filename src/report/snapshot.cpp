#include "report/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "base/fault.hpp"
#include "report/ticks.hpp"

namespace livebed::report {

using base::Exit;
using base::fail;

namespace {

constexpr Colour white{255, 255, 255}, ink{30, 30, 34}, pipe_fill{225, 228, 232};
constexpr int letter = 2;                                               ///< pixels a dot of the text
constexpr int left = 64, right = 20, top = 34, bottom = 52, bars = 62;  ///< margins; bars: strip of the colour scales

/// Velocity in cells, with bilinear look-up between centres.  Cells count by their open part, so that the pipe does not
/// slow down the water beside it in the picture.
class Velocities {
public:
  explicit Velocities(const io::Grid& grid)
      : nx_(grid.nx()),
        ny_(grid.ny()),
        velocity_(io::array(grid.cells, "velocity").values),
        open_(velocity_.size() / 3, 1.0) {
    for (int i = 0; i < nx_; ++i) x_.push_back((grid.x[i] + grid.x[i + 1]) / 2);
    for (int j = 0; j < ny_; ++j) y_.push_back((grid.y[j] + grid.y[j + 1]) / 2);
    if (io::has_array(grid.cells, "open")) open_ = io::array(grid.cells, "open").values;
  }
  /// (u, v) [m/s] at a point; 0 where nothing round it is open.
  std::pair<double, double> at(double x, double y) const {
    const auto [i, fx] = place(x_, x);
    const auto [j, fy] = place(y_, y);
    double u = 0, v = 0, weights = 0;
    const auto add = [&](int a, int b, double weight) {
      const auto cell = static_cast<std::size_t>(std::min(b, ny_ - 1)) * static_cast<std::size_t>(nx_) +
                        static_cast<std::size_t>(std::min(a, nx_ - 1));
      weight *= open_[cell];
      u += weight * velocity_[3 * cell];
      v += weight * velocity_[3 * cell + 1];
      weights += weight;
    };
    add(i, j, (1 - fx) * (1 - fy));
    add(i + 1, j, fx * (1 - fy));
    add(i, j + 1, (1 - fx) * fy);
    add(i + 1, j + 1, fx * fy);
    if (weights <= 0) return {0.0, 0.0};
    return {u / weights, v / weights};
  }

private:
  /// Index of the centre before s and the fraction of the way to the next.
  static std::pair<int, double> place(const std::vector<double>& centres, double s) {
    const auto next = std::upper_bound(centres.begin(), centres.end(), s);
    if (next == centres.begin()) return {0, 0.0};
    const int i = static_cast<int>(next - centres.begin()) - 1;
    if (next == centres.end()) return {i, 0.0};
    return {i, (s - *(next - 1)) / (*next - *(next - 1))};
  }
  int nx_, ny_;
  std::vector<double> x_, y_;
  const std::vector<double>& velocity_;
  std::vector<double> open_;
};

/// From metres to pixels.
struct View {
  double x0, y0, scale;  ///< lower left corner [m], pixels a metre
  int width, height;     ///< of the plot inside the margins [pixels]
  double px(double x) const { return left + (x - x0) * scale; }
  double py(double y) const { return top + height - (y - y0) * scale; }
};

View view_of(const Snapshot& s, const SnapshotOptions& options) {
  double from = options.x_from, to = options.x_to;
  if (!(to > from)) {
    from = s.pipe ? s.pipe->x - 3 * s.pipe->diameter : s.water.x.front();
    to = s.pipe ? s.pipe->x + 6 * s.pipe->diameter : s.water.x.back();
  }
  from = std::max(from, s.water.x.front());
  to = std::min(to, s.water.x.back());
  if (!(to > from))
    fail(Exit::internal, "the window {} m to {} m shows nothing of the run", options.x_from, options.x_to);
  const int width = options.width - left - right;
  const double scale = width / (to - from);
  const double height = s.water.y.back() - s.water.y.front();
  return {from, s.water.y.front(), scale, width, std::max(1, static_cast<int>(std::lround(height * scale)))};
}

void draw_water(Picture& picture, const View& view, const Velocities& water, const SnapshotOptions& options,
                double largest) {
  for (int j = 0; j < view.height; ++j)
    for (int i = 0; i < view.width; ++i) {
      const auto [u, v] = water.at(view.x0 + (i + 0.5) / view.scale, view.y0 + (view.height - j - 0.5) / view.scale);
      picture.set(left + i, top + j, viridis(std::hypot(u, v) / largest));
    }
  if (!options.arrows) return;
  constexpr double spacing = 44, longest = 36;  // [pixels]
  for (double y = spacing / 2; y < view.height; y += spacing)
    for (double x = spacing / 2; x < view.width; x += spacing) {
      const auto [u, v] = water.at(view.x0 + x / view.scale, view.y0 + (view.height - y) / view.scale);
      const double length = longest * std::hypot(u, v) / largest;
      if (length < 3) continue;
      const double ex = u / std::hypot(u, v), ey = -v / std::hypot(u, v);
      const double tip_x = left + x + ex * length / 2, tip_y = top + y + ey * length / 2;
      picture.line(tip_x - ex * length, tip_y - ey * length, tip_x, tip_y, 1.2, white, 0.75);
      for (int side : {-1, 1})
        picture.line(tip_x, tip_y, tip_x - 5 * ex - 2.5 * side * ey, tip_y - 5 * ey + 2.5 * side * ex, 1.2, white,
                     0.75);
    }
}

std::vector<double> speeds_of(const io::Points& grains) {
  const std::vector<double>& velocity = io::array(grains.data, "velocity").values;
  std::vector<double> speeds(grains.x.size());
  for (std::size_t n = 0; n < speeds.size(); ++n) speeds[n] = std::hypot(velocity[3 * n], velocity[3 * n + 1]);
  return speeds;
}

void draw_grains(Picture& picture, const View& view, const io::Points& grains, double largest) {
  const std::vector<double>& diameter = io::array(grains.data, "diameter").values;
  const std::vector<double> speed = speeds_of(grains);
  for (std::size_t n = 0; n < grains.x.size(); ++n)
    picture.disc(view.px(grains.x[n]), view.py(grains.y[n]), std::max(0.6, diameter[n] / 2 * view.scale - 0.25),
                 sand(speed[n] / largest));
}

void draw_overlay(Picture& picture, const View& view, const Overlay& overlay) {
  for (std::size_t n = 0; n < overlay.x.size(); ++n) {
    const double x = view.px(overlay.x[n]), y = view.py(overlay.y[n]);
    if (overlay.dots) {
      picture.disc(x, y, 5, white);
      picture.disc(x, y, 3.5, overlay.colour);
    } else if (n > 0) {
      picture.line(view.px(overlay.x[n - 1]), view.py(overlay.y[n - 1]), x, y, 2.2, overlay.colour);
    }
  }
}

/// Everything outside the plot: clears what was drawn over the rim, then frame, ticks and labels.
void draw_frame(Picture& picture, const View& view, const Snapshot& s, const SnapshotOptions& options) {
  const int x1 = left + view.width, y1 = top + view.height;
  picture.rectangle(0, 0, picture.width(), top, white);
  picture.rectangle(0, y1, picture.width(), picture.height(), white);
  picture.rectangle(0, 0, left, picture.height(), white);
  picture.rectangle(x1, 0, picture.width(), picture.height(), white);
  picture.text(left + 24, 10, options.title, letter, ink);

  // With a pipe lengths are in D from its centre and the original bed; without one in metres.
  const double unit = s.pipe ? s.pipe->diameter : 1, origin_x = s.pipe ? s.pipe->x : 0;
  const double origin_y = !std::isnan(options.level) ? options.level : s.pipe ? s.pipe->y - unit / 2 : 0;
  const Ticks tx = ticks((view.x0 - origin_x) / unit, (view.x0 + view.width / view.scale - origin_x) / unit, 10);
  for (double t : tx.places) {
    const double x = view.px(origin_x + t * unit);
    picture.line(x, y1, x, y1 + 6, 1.4, ink);
    const std::string label = tx.text(t);
    picture.text(static_cast<int>(x) - Picture::text_width(label, letter) / 2, y1 + 10, label, letter, ink);
  }
  const Ticks ty = ticks((view.y0 - origin_y) / unit, (view.y0 + view.height / view.scale - origin_y) / unit, 6);
  for (double t : ty.places) {
    const double y = view.py(origin_y + t * unit);
    picture.line(left - 6, y, left, y, 1.4, ink);
    const std::string label = ty.text(t);
    picture.text(left - 9 - Picture::text_width(label, letter), static_cast<int>(y) - 7, label, letter, ink);
  }
  const std::string x_name = s.pipe ? "x/D from the pipe" : "x [m]";
  picture.text(left + (view.width - Picture::text_width(x_name, letter)) / 2, y1 + 31, x_name, letter, ink);
  picture.text(4, 10, s.pipe ? "y/D" : "y [m]", letter, ink);
  for (auto [a, b, c, d] :
       {std::array<int, 4>{left, top, x1, top}, {left, y1, x1, y1}, {left, top, left, y1}, {x1, top, x1, y1}})
    picture.line(a, b, c, d, 1.4, ink);
}

/// A horizontal colour scale from 0 to largest with its name on the left.
void draw_bar(Picture& picture, int x, int y, int width, const std::string& name, double largest,
              Colour (*map)(double)) {
  const int named = Picture::text_width(name, letter) + 12;
  picture.text(x, y, name, letter, ink);
  const int from = x + named, length = width - named - 40;
  for (int i = 0; i < length; ++i)
    picture.rectangle(from + i, y, from + i + 1, y + 14, map(static_cast<double>(i) / (length - 1)));
  const Ticks marks = ticks(0, largest, 4);
  for (double t : marks.places) {
    const double at = from + t / largest * (length - 1);
    picture.line(at, y + 14, at, y + 18, 1.4, ink);
    const std::string label = marks.text(t);
    picture.text(static_cast<int>(at) - Picture::text_width(label, letter) / 2, y + 21, label, letter, ink);
  }
}

}  // namespace

Pipe read_pipe(const io::Path& path) {
  const io::Points line = io::read_vtp(path);
  if (line.x.size() < 3) fail(Exit::input_output, "{}: a pipe of {} points", path.string(), line.x.size());
  const auto [x0, x1] = std::minmax_element(line.x.begin(), line.x.end());
  const auto [y0, y1] = std::minmax_element(line.y.begin(), line.y.end());
  return {(*x0 + *x1) / 2, (*y0 + *y1) / 2, *x1 - *x0};
}

double largest_water_speed(const Snapshot& snapshot) {
  const std::vector<double>& u = io::array(snapshot.water.cells, "velocity").values;
  double largest = 0;
  for (std::size_t n = 0; n + 2 < u.size(); n += 3) largest = std::max(largest, std::hypot(u[n], u[n + 1]));
  return largest;
}

double largest_grain_speed(const Snapshot& snapshot) {
  if (!snapshot.grains || snapshot.grains->x.empty()) return 0;
  std::vector<double> speeds = speeds_of(*snapshot.grains);
  const auto rank = static_cast<std::ptrdiff_t>(0.998 * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), speeds.begin() + rank, speeds.end());
  return speeds[static_cast<std::size_t>(rank)];
}

Picture draw(const Snapshot& snapshot, const SnapshotOptions& options) {
  const View view = view_of(snapshot, options);
  // A scale that ends at zero would have no colours: still water and resting grains get 1 cm/s.
  constexpr double least = 0.01;
  const double water_end =
      std::max(least, options.water_speed > 0 ? options.water_speed : largest_water_speed(snapshot));
  const double grain_end =
      std::max(least, options.grain_speed > 0 ? options.grain_speed : largest_grain_speed(snapshot));

  Picture picture(options.width, top + view.height + bottom + bars, white);
  draw_water(picture, view, Velocities(snapshot.water), options, water_end);
  if (snapshot.grains) draw_grains(picture, view, *snapshot.grains, grain_end);
  if (snapshot.pipe) {
    const double x = view.px(snapshot.pipe->x), y = view.py(snapshot.pipe->y),
                 r = snapshot.pipe->diameter / 2 * view.scale;
    picture.disc(x, y, r, ink);
    picture.disc(x, y, r - 2, pipe_fill);
  }
  for (const Overlay& overlay : options.overlays) draw_overlay(picture, view, overlay);
  draw_frame(picture, view, snapshot, options);
  const int y = top + view.height + bottom + 12, half = view.width / 2;
  draw_bar(picture, left, y, half, "water [m/s]", water_end, viridis);
  if (snapshot.grains) draw_bar(picture, left + half + 20, y, half - 20, "grains [m/s]", grain_end, sand);
  return picture;
}

void render_snapshot(const io::Path& vtr, const io::Path& grains_vtp, const io::Path& pipe_vtp, const io::Path& out_png,
                     const SnapshotOptions& options) {
  Snapshot snapshot{io::read_vtr(vtr), {}, {}};
  if (!grains_vtp.empty()) snapshot.grains = io::read_vtp(grains_vtp);
  if (!pipe_vtp.empty()) snapshot.pipe = read_pipe(pipe_vtp);
  io::write_atomically(out_png, draw(snapshot, options).png());
}

}  // namespace livebed::report
