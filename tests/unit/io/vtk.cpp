#include "io/vtk.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "expect_fault.hpp"
#include "io/base64.hpp"
#include "temporary_folder.hpp"

namespace livebed::io {
namespace {

/// What VTK's own reader finds in a file: first word of each line (for arrays "array NAME") -> the rest.
std::map<std::string, std::string> seen_by_vtk(const Path& path) {
  const std::string command =
      "/usr/bin/python3 " LIVEBED_SOURCE_DIR "/tests/unit/io/read_with_vtk.py '" + path.string() + "' 2>&1";
  std::string text;
  FILE* pipe = ::popen(command.c_str(), "r");
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, n);
  EXPECT_EQ(::pclose(pipe), 0) << "this test needs Debian's python3-vtk9; it said:\n" << text;
  std::map<std::string, std::string> facts;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    auto space = line.find(' ');
    if (line.starts_with("array ")) space = line.find(' ', space + 1);
    if (space != line.npos) facts[line.substr(0, space)] = line.substr(space + 1);
  }
  return facts;
}

/// Compares "TYPE COMPONENTS v v v" with what was written.
void expect_array(std::map<std::string, std::string>& facts, const DataArray& expected, double tolerance) {
  ASSERT_TRUE(facts.contains("array " + expected.name)) << expected.name;
  std::istringstream in(facts["array " + expected.name]);
  std::string type;
  int components = 0;
  in >> type >> components;
  EXPECT_EQ(type, expected.store == Store::float32 ? "float" : expected.store == Store::float64 ? "double" : "int");
  EXPECT_EQ(components, expected.components);
  for (std::size_t n = 0; n < expected.values.size(); ++n) {
    double value = NAN;
    in >> value;
    ASSERT_NEAR(value, expected.values[n], tolerance * std::abs(expected.values[n]))
        << expected.name << '[' << n << ']';
  }
  std::string more;
  EXPECT_FALSE(in >> more) << expected.name << " has more values than were written";
}

flow::Mesh stretched_mesh(int nx, int ny) {
  flow::Mesh mesh;
  mesh.nx = nx;
  mesh.ny = ny;
  for (int i = 0; i <= nx; ++i) mesh.x.push_back(0.01 * i * (1 + 0.1 * i));
  for (int j = 0; j <= ny; ++j) mesh.y.push_back(0.02 * j);
  mesh.volume = base::Field(nx, ny, 2, 1.0);
  return mesh;
}

flow::State numbered_state(int nx, int ny) {
  flow::State s;
  for (base::Field* f : {&s.u, &s.v, &s.p, &s.k, &s.epsilon, &s.nut}) *f = base::Field(nx, ny);
  for (int j = -2; j < ny + 2; ++j)
    for (int i = -2; i < nx + 2; ++i) {
      s.u(i, j) = i * i + 10 * j;
      s.v(i, j) = -i + 0.1 * j * j;
      s.p(i, j) = std::sin(i + 3.0 * j);
      s.k(i, j) = 1e-3 * (i + 2) * (j + 2);
      s.epsilon(i, j) = 1e-8 * i;
      s.nut(i, j) = 1e-4;
    }
  return s;
}

grains::State numbered_grains(int n) {
  grains::State g;
  for (int k = 0; k < n; ++k) {
    g.x.push_back(0.001 * k);
    g.y.push_back(0.002 * k * k);
    g.u.push_back(std::cos(k));
    g.v.push_back(std::sin(k));
    g.omega.push_back(-10.0 * k);
    g.diameter.push_back(0.002 + 1e-5 * k);
    g.id.push_back((k * 3) % n);  // a shuffled order
    g.fluid.u.push_back(1.0);
    g.fluid.v.push_back(0.0);
    g.fluid.beta.push_back(0.5);
  }
  return g;
}

TEST(vtk, velocity_in_cells_is_the_mean_of_the_faces) {
  const Grid grid = flow_fields(stretched_mesh(4, 3), numbered_state(4, 3), nullptr, 1.25);
  const DataArray& velocity = array(grid.cells, "velocity");
  ASSERT_EQ(velocity.values.size(), 36u);
  EXPECT_DOUBLE_EQ(velocity.values[3 * (4 * 2 + 3)], 0.5 * (9 + 16) + 20);      // cell (3,2): faces 3 and 4 of row 2
  EXPECT_DOUBLE_EQ(velocity.values[3 * (4 * 2 + 3) + 1], -3 + 0.05 * (4 + 9));  // faces 2 and 3 of column 3
  EXPECT_FALSE(has_array(grid.cells, "solid"));
}

TEST(vtk, grains_come_in_the_order_of_their_id_with_their_drag) {
  const grains::State g = numbered_grains(10);
  const Points points = grain_points(g, 0.5);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(array(points.data, "id").values[k], k);
  for (int k = 0; k < 10; ++k) {
    const auto place = static_cast<std::size_t>(g.id[k]);
    EXPECT_EQ(points.x[place], g.x[k]);
    EXPECT_NEAR(array(points.data, "drag").values[3 * place], 0.5 * (1 - g.u[k]), 1e-15);
    EXPECT_NEAR(array(points.data, "drag").values[3 * place + 1], -0.5 * g.v[k], 1e-15);
  }
}

TEST(vtk, fields_open_in_vtk_and_in_our_reader) {
  const TemporaryFolder folder;
  const int nx = 300, ny = 250;  // several compressed blocks an array, the last one partial
  const base::Field solid(nx, ny, 2, 0.55);
  const Grid grid = flow_fields(stretched_mesh(nx, ny), numbered_state(nx, ny), &solid, 1.25);
  write_vtr(folder / "a.vtr", grid);

  auto facts = seen_by_vtk(folder / "a.vtr");
  EXPECT_EQ(facts["extent"], "0 300 0 250 0 0");
  EXPECT_EQ(facts["time"], "1.25");
  expect_array(facts, {"x", 1, Store::float64, grid.x}, 0);
  expect_array(facts, {"y", 1, Store::float64, grid.y}, 0);
  for (const DataArray& a : grid.cells) expect_array(facts, a, 1e-7);

  const Grid back = read_vtr(folder / "a.vtr");
  EXPECT_EQ(back.time, 1.25);
  EXPECT_EQ(back.x, grid.x);
  EXPECT_EQ(back.y, grid.y);
  ASSERT_EQ(back.cells.size(), 7u);
  for (std::size_t a = 0; a < grid.cells.size(); ++a) {
    EXPECT_EQ(back.cells[a].name, grid.cells[a].name);
    for (std::size_t n = 0; n < grid.cells[a].values.size(); ++n)
      ASSERT_EQ(back.cells[a].values[n], static_cast<float>(grid.cells[a].values[n]));
  }
}

TEST(vtk, an_array_of_exactly_one_block_has_no_partial_one) {
  const TemporaryFolder folder;
  const int nx = 256, ny = 256;  // 256 kB of floats
  const Grid grid = flow_fields(stretched_mesh(nx, ny), numbered_state(nx, ny), nullptr, 0);
  write_vtr(folder / "a.vtr", grid);
  auto facts = seen_by_vtk(folder / "a.vtr");
  expect_array(facts, array(grid.cells, "p"), 1e-7);
  EXPECT_EQ(array(read_vtr(folder / "a.vtr").cells, "p").values.size(), 65536u);
}

TEST(vtk, grains_open_in_vtk_and_in_our_reader) {
  const TemporaryFolder folder;
  const Points points = grain_points(numbered_grains(1000), 0.125);
  write_vtp(folder / "a.vtp", points);
  auto facts = seen_by_vtk(folder / "a.vtp");
  EXPECT_EQ(facts["points"], "1000");
  EXPECT_EQ(facts["verts"], "1000");
  EXPECT_EQ(facts["lines"], "0");
  EXPECT_EQ(facts["time"], "0.125");
  DataArray triples{"points", 3, Store::float32, {}};
  for (std::size_t n = 0; n < 1000; ++n) triples.values.insert(triples.values.end(), {points.x[n], points.y[n], 0.0});
  expect_array(facts, triples, 1e-7);
  for (const DataArray& a : points.data) expect_array(facts, a, 1e-7);

  const Points back = read_vtp(folder / "a.vtp");
  EXPECT_EQ(back.time, 0.125);
  EXPECT_EQ(back.shape, Shape::points);
  EXPECT_EQ(array(back.data, "id").values, array(points.data, "id").values);
  for (std::size_t n = 0; n < 1000; ++n) ASSERT_EQ(back.x[n], static_cast<float>(points.x[n]));
}

TEST(vtk, the_pipe_is_one_closed_line) {
  const TemporaryFolder folder;
  write_vtp(folder / "pipe.vtp", circle_line(0.2, 0.075, 0.05));
  auto facts = seen_by_vtk(folder / "pipe.vtp");
  EXPECT_EQ(facts["lines"], "1");
  EXPECT_EQ(facts["verts"], "0");
  EXPECT_EQ(facts["length"], "181 0 0");
  const Points back = read_vtp(folder / "pipe.vtp");
  EXPECT_EQ(back.shape, Shape::closed_line);
  for (std::size_t n = 0; n < back.x.size(); ++n)
    EXPECT_NEAR(std::hypot(back.x[n] - 0.2, back.y[n] - 0.075), 0.025, 1e-7);
}

TEST(vtk, no_grains_is_a_valid_file_for_us) {
  const TemporaryFolder folder;
  write_vtp(folder / "none.vtp", grain_points(grains::State{}, 1));
  EXPECT_TRUE(read_vtp(folder / "none.vtp").x.empty());
}

/// The same file as the first versions of the program wrote it: all arrays in one raw block at the end.
std::string with_raw_block(std::string text) {
  std::string block;
  for (auto at = text.find(" format=\"binary\">\n"); at != text.npos; at = text.find(" format=\"binary\">\n", at)) {
    const auto from = text.find('\n', at) + 1, to = text.find('\n', from);
    // One block an array: its head of 32 bytes is a text of 44 letters.
    const std::string packed =
        *from_base64(text.substr(from, 44)) + *from_base64(text.substr(from + 44, to - from - 44));
    text.replace(at, text.find("</DataArray>", to) + 12 - at,
                 " format=\"appended\" offset=\"" + std::to_string(block.size()) + "\"/>");
    block += packed;
  }
  text.resize(text.rfind("</VTKFile>"));
  return text + "<AppendedData encoding=\"raw\">\n_" + block + "\n</AppendedData>\n</VTKFile>\n";
}

TEST(vtk, files_with_a_raw_block_are_read_too) {
  const TemporaryFolder folder;
  const Points grains = grain_points(numbered_grains(50), 2.5);
  write_vtp(folder / "new.vtp", grains);
  write_atomically(folder / "old.vtp", with_raw_block(read_file(folder / "new.vtp")));
  const Points read = read_vtp(folder / "old.vtp");
  EXPECT_EQ(read.time, 2.5);
  EXPECT_EQ(read.x, read_vtp(folder / "new.vtp").x);
  EXPECT_EQ(array(read.data, "id").values, array(grains.data, "id").values);
  const std::string bytes = read_file(folder / "old.vtp");
  write_atomically(folder / "cut.vtp", std::string_view(bytes).substr(0, bytes.size() - 300));
  expect_io_fault([&] { read_vtp(folder / "cut.vtp"); }, {"cut.vtp", "ends inside"});
}

TEST(vtk, damaged_and_foreign_files_are_refused_by_name) {
  const TemporaryFolder folder;
  write_vtp(folder / "a.vtp", grain_points(numbered_grains(500), 0));
  std::string bytes = read_file(folder / "a.vtp");
  expect_io_fault([&] { read_vtr(folder / "a.vtp"); }, {"a.vtp", "RectilinearGrid"});
  write_atomically(folder / "cut.vtp", std::string_view(bytes).substr(0, bytes.size() - 3000));
  expect_io_fault([&] { read_vtp(folder / "cut.vtp"); }, {"cut.vtp", "ends inside"});
  const auto start = bytes.find("\n_") + 200;
  for (std::size_t n = start; n < bytes.size() - 40; n += 50) bytes[n] ^= 0x55;
  write_atomically(folder / "bad.vtp", bytes);
  expect_io_fault([&] { read_vtp(folder / "bad.vtp"); }, {"bad.vtp"});
  write_atomically(folder / "text.vtp", "<VTKFile type=\"PolyData\">");
  expect_io_fault([&] { read_vtp(folder / "text.vtp"); }, {"text.vtp"});
  expect_io_fault([&] { array(grain_points(numbered_grains(2), 0).data, "speed"); }, {"speed", "diameter"});
}

TEST(vtk, a_time_series_grows_and_continues_from_a_checkpoint) {
  const TemporaryFolder folder;
  {
    TimeSeries series(folder / "grains.pvd");
    for (int n = 0; n < 5; ++n) series.add(0.1 * n, "grains/" + std::to_string(n) + ".vtp");
  }
  TimeSeries continued(folder / "grains.pvd", 0.2);
  EXPECT_EQ(continued.files().size(), 3u);
  continued.add(0.25, "grains/again.vtp");
  const auto files = read_pvd(folder / "grains.pvd");
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[1].time, 0.1);
  EXPECT_EQ(files[3].time, 0.25);
  EXPECT_EQ(files[3].file, "grains/again.vtp");
  EXPECT_TRUE(TimeSeries(folder / "grains.pvd").files().empty());
  expect_io_fault([&] { read_pvd(folder / "none.pvd"); }, {"none.pvd"});
  write_atomically(folder / "text.pvd", "nothing");
  expect_io_fault([&] { read_pvd(folder / "text.pvd"); }, {"text.pvd"});
}

}  // namespace
}  // namespace livebed::io
