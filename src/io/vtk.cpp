#include "io/vtk.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "io/vtk_xml.hpp"

namespace livebed::io {

using base::Exit;
using base::fail;

namespace {

/// VTK's name for the time of a file, in its field data.
std::string time_element(double time) {
  return "<FieldData>\n" + element({"TimeValue", 1, Store::float64, {time}}, " NumberOfTuples=\"1\"") +
         "</FieldData>\n";
}

/// (x, y, 0) triples of two components.
std::vector<double> with_zero(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> triples;
  triples.reserve(3 * x.size());
  for (std::size_t n = 0; n < x.size(); ++n) triples.insert(triples.end(), {x[n], y[n], 0.0});
  return triples;
}

/// offsets and connectivity of the cells of a poly data set.
std::string topology(std::string_view kind, std::vector<double> connectivity, std::vector<double> offsets) {
  return fmt::format("<{}>\n{}{}</{}>\n", kind, element({"connectivity", 1, Store::int32, std::move(connectivity)}),
                     element({"offsets", 1, Store::int32, std::move(offsets)}), kind);
}

}  // namespace

bool has_array(const std::vector<DataArray>& arrays, std::string_view name) {
  return std::any_of(arrays.begin(), arrays.end(), [&](const DataArray& a) { return a.name == name; });
}

const DataArray& array(const std::vector<DataArray>& arrays, std::string_view name) {
  for (const DataArray& a : arrays)
    if (a.name == name) return a;
  std::string names;
  for (const DataArray& a : arrays) names += (names.empty() ? "" : ", ") + a.name;
  fail(Exit::input_output, "no array {} in the file; it has {}", name, names);
}

Grid flow_fields(const flow::Mesh& mesh, const flow::State& state, const base::Field* solid, double time) {
  Grid grid{time, mesh.x, mesh.y, {}};
  const auto scalar = [&](const char* name, const base::Field& field) {
    DataArray a{name, 1, Store::float32, {}};
    a.values.reserve(static_cast<std::size_t>(mesh.nx) * mesh.ny);
    for (int j = 0; j < mesh.ny; ++j) a.values.insert(a.values.end(), field.row(j), field.row(j) + mesh.nx);
    grid.cells.push_back(std::move(a));
  };
  DataArray velocity{"velocity", 3, Store::float32, {}};
  velocity.values.reserve(3u * static_cast<std::size_t>(mesh.nx) * mesh.ny);
  for (int j = 0; j < mesh.ny; ++j)
    for (int i = 0; i < mesh.nx; ++i)
      velocity.values.insert(velocity.values.end(), {0.5 * (state.u(i, j) + state.u(i + 1, j)),
                                                     0.5 * (state.v(i, j) + state.v(i, j + 1)), 0.0});
  grid.cells.push_back(std::move(velocity));
  scalar("p", state.p);
  scalar("k", state.k);
  scalar("epsilon", state.epsilon);
  scalar("nut", state.nut);
  scalar("open", mesh.volume);
  if (solid != nullptr) scalar("solid", *solid);
  return grid;
}

Points grain_points(const grains::State& grains, double time) {
  const std::size_t n = grains.x.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return grains.id[a] < grains.id[b]; });

  Points points{time, Shape::points, {}, {}, {}};
  points.data = {{"id", 1, Store::int32, {}},
                 {"diameter", 1, Store::float32, {}},
                 {"velocity", 3, Store::float32, {}},
                 {"omega", 1, Store::float32, {}},
                 {"drag", 3, Store::float32, {}}};
  const bool has_drag = grains.fluid.beta.size() == n;
  for (std::size_t g : order) {
    points.x.push_back(grains.x[g]);
    points.y.push_back(grains.y[g]);
    points.data[0].values.push_back(grains.id[g]);
    points.data[1].values.push_back(grains.diameter[g]);
    points.data[2].values.insert(points.data[2].values.end(), {grains.u[g], grains.v[g], 0.0});
    points.data[3].values.push_back(grains.omega[g]);
    if (has_drag) {
      const double beta = grains.fluid.beta[g];
      points.data[4].values.insert(points.data[4].values.end(), {beta * (grains.fluid.u[g] - grains.u[g]),
                                                                 beta * (grains.fluid.v[g] - grains.v[g]), 0.0});
    }
  }
  if (!has_drag) points.data.pop_back();  // grains that no fluid has met yet
  return points;
}

Points circle_line(double x, double y, double diameter) {
  constexpr int corners = 180;
  Points line;
  line.shape = Shape::closed_line;
  for (int n = 0; n < corners; ++n) {
    line.x.push_back(x + diameter / 2 * std::cos(2 * base::pi * n / corners));
    line.y.push_back(y + diameter / 2 * std::sin(2 * base::pi * n / corners));
  }
  return line;
}

void write_vtr(const Path& path, const Grid& grid) {
  const std::size_t cells = static_cast<std::size_t>(grid.nx()) * static_cast<std::size_t>(grid.ny());
  const std::string extent = fmt::format("0 {} 0 {} 0 0", grid.nx(), grid.ny());
  std::string body = fmt::format("<RectilinearGrid WholeExtent=\"{}\">\n", extent) + time_element(grid.time) +
                     fmt::format("<Piece Extent=\"{}\">\n<CellData>\n", extent);
  for (const DataArray& a : grid.cells) {
    if (a.values.size() != cells * static_cast<std::size_t>(a.components))
      fail(Exit::internal, "{}: {} has {} values for {} cells", path.string(), a.name, a.values.size(), cells);
    body += element(a);
  }
  body += "</CellData>\n<Coordinates>\n" + element({"x", 1, Store::float64, grid.x}) +
          element({"y", 1, Store::float64, grid.y}) + element({"z", 1, Store::float64, {0.0}}) +
          "</Coordinates>\n</Piece>\n</RectilinearGrid>\n";
  write_atomically(path, xml_file("RectilinearGrid", body));
}

void write_vtp(const Path& path, const Points& points) {
  const std::size_t n = points.x.size();
  const std::size_t lines = points.shape == Shape::pairs ? n / 2 : points.shape == Shape::closed_line ? 1 : 0;
  std::string body = "<PolyData>\n" + time_element(points.time) +
                     fmt::format(
                         "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                         "NumberOfPolys=\"0\">\n",
                         n, points.shape == Shape::points ? n : 0, lines);
  const auto section = [&](const char* name, const std::vector<DataArray>& arrays, std::size_t count) {
    body += fmt::format("<{}>\n", name);
    for (const DataArray& a : arrays) {
      if (a.values.size() != count * static_cast<std::size_t>(a.components))
        fail(Exit::internal, "{}: {} has {} values for {} of {}", path.string(), a.name, a.values.size(), count, name);
      body += element(a);
    }
    body += fmt::format("</{}>\n", name);
  };
  section("PointData", points.data, n);
  if (!points.lines.empty()) section("CellData", points.lines, lines);
  body += "<Points>\n" + element({"points", 3, Store::float32, with_zero(points.x, points.y)}) + "</Points>\n";
  std::vector<double> corners(n);
  std::iota(corners.begin(), corners.end(), 0.0);
  if (points.shape == Shape::closed_line) {
    corners.push_back(0.0);
    body += topology("Lines", corners, {static_cast<double>(n + 1)});
  } else {
    const int step = points.shape == Shape::pairs ? 2 : 1;
    std::vector<double> ends(n / step);
    for (std::size_t k = 0; k < ends.size(); ++k) ends[k] = static_cast<double>((k + 1) * step);
    body += topology(step == 2 ? "Lines" : "Verts", corners, ends);
  }
  write_atomically(path, xml_file("PolyData", body + "</Piece>\n</PolyData>\n"));
}

Grid read_vtr(const Path& path) {
  const XmlReader in(path, "RectilinearGrid");
  Grid grid;
  grid.time = in.array("FieldData", "TimeValue").values.at(0);
  grid.x = in.array("Coordinates", "x").values;
  grid.y = in.array("Coordinates", "y").values;
  grid.cells = in.arrays("CellData");
  const std::size_t cells = static_cast<std::size_t>(std::max(0, grid.nx()) * std::max(0, grid.ny()));
  for (const DataArray& a : grid.cells)
    if (cells == 0 || a.values.size() != cells * static_cast<std::size_t>(a.components))
      fail(Exit::input_output, "{}: {} has {} values for {} cells", path.string(), a.name, a.values.size(), cells);
  return grid;
}

Points read_vtp(const Path& path) {
  const XmlReader in(path, "PolyData");
  Points points;
  points.time = in.array("FieldData", "TimeValue").values.at(0);
  const DataArray triples = in.array("Points", "points");
  for (std::size_t n = 0; n + 2 < triples.values.size(); n += 3) {
    points.x.push_back(triples.values[n]);
    points.y.push_back(triples.values[n + 1]);
  }
  const std::string count = in.attributes("Piece").at("NumberOfLines");
  points.data = in.arrays("PointData");
  points.lines = in.arrays("CellData");
  points.shape = !points.lines.empty() ? Shape::pairs : count == "0" ? Shape::points : Shape::closed_line;
  for (const DataArray& a : points.data)
    if (a.values.size() != points.x.size() * static_cast<std::size_t>(a.components))
      fail(Exit::input_output, "{}: {} has {} values for {} points", path.string(), a.name, a.values.size(),
           points.x.size());
  return points;
}

TimeSeries::TimeSeries(const Path& path, double keep_until) : path_(path) {
  if (keep_until < 0 || !std::filesystem::exists(path)) return;
  for (TimedFile& entry : read_pvd(path))
    if (entry.time <= keep_until) files_.push_back(std::move(entry));
}

void TimeSeries::add(double time, const std::string& file) {
  files_.push_back({time, file});
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const TimedFile& entry : files_)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  write_atomically(path_, text + "</Collection>\n</VTKFile>\n");
}

std::vector<TimedFile> read_pvd(const Path& path) {
  const std::string text = read_file(path);
  if (text.find("<VTKFile type=\"Collection\"") == text.npos)
    fail(Exit::input_output, "{} is not a .pvd time series", path.string());
  const auto quoted = [&](std::size_t from, const char* key) {
    const std::string opening = fmt::format("{}=\"", key);
    const auto start = text.find(opening, from) + opening.size();
    return std::string_view(text).substr(start, text.find('"', start) - start);
  };
  std::vector<TimedFile> files;
  for (auto at = text.find("<DataSet "); at != text.npos; at = text.find("<DataSet ", at + 1)) {
    const std::string_view time = quoted(at, "timestep");
    TimedFile entry{0, std::string(quoted(at, "file"))};
    if (std::from_chars(time.data(), time.data() + time.size(), entry.time).ec != std::errc{})
      fail(Exit::input_output, "{}: timestep = \"{}\" is not a number", path.string(), time);
    files.push_back(std::move(entry));
  }
  return files;
}

}  // namespace livebed::io
