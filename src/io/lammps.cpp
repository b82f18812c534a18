#include "io/lammps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <numeric>
#include <string_view>

#include "base/fault.hpp"

namespace livebed::io {

namespace {

using base::Exit;
using base::fail;

/// The lines of a file that are not empty, without comments and blanks around.
class Lines {
public:
  Lines(const Path& path, std::string_view text) : path_(path), text_(text) {}

  /// Goes to the next one; false at the end.
  bool next() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++number_;
      line = line.substr(0, line.find('#'));
      words_.clear();
      for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos;) {
        const std::size_t stop = std::min(line.find_first_of(" \t\r", at), line.size());
        words_.push_back(line.substr(at, stop - at));
        at = stop;
      }
      if (!words_.empty()) return true;
    }
    return false;
  }
  const std::vector<std::string_view>& words() const { return words_; }
  bool begins_with_number() const {
    double ignored = 0;
    return std::from_chars(words_[0].data(), words_[0].data() + words_[0].size(), ignored).ec == std::errc{};
  }
  double number(std::size_t n, const char* what) const {
    if (n >= words_.size()) fault(fmt::format("{} is missing: the line has {} words", what, words_.size()));
    double value = 0;
    const std::string_view word = words_[n];
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(value))
      fault(fmt::format("{} = \"{}\" is not a number", what, word));
    return value;
  }
  [[noreturn]] void fault(const std::string& what) const {
    fail(Exit::input_output, "{}:{}: {}", path_.string(), number_, what);
  }

private:
  const Path& path_;
  std::string_view text_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

struct Atom {
  double diameter, density, x, y, u = 0, v = 0, omega = 0;
};

Atom read_atom(const Lines& line) {
  if (line.words().size() != 7 && line.words().size() != 10)
    line.fault(
        fmt::format("{} numbers; atom_style sphere has 7 (id, type, diameter, density, x, y, z), or 10 with image "
                    "flags",
                    line.words().size()));
  const Atom atom{line.number(2, "diameter"), line.number(3, "density"), line.number(4, "x"), line.number(5, "y")};
  const double z = line.number(6, "z");
  if (atom.diameter <= 0) line.fault(fmt::format("diameter = {} m; a grain has one above 0", atom.diameter));
  constexpr double out_of_plane = 1e-6;  // over the diameter
  if (std::abs(z) > out_of_plane * atom.diameter)
    line.fault(fmt::format("z = {} m; the grains of a bed lie in the plane z = 0", z));
  if (atom.y <= 0) line.fault(fmt::format("y = {} m; the floor of a bed is y = 0 and its grains lie above", atom.y));
  return atom;
}

}  // namespace

void write_lammps(const Path& path, const grains::Params& params, const grains::State& g, double height) {
  std::vector<int> order(static_cast<std::size_t>(g.count()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return g.id[a] < g.id[b]; });
  double largest = params.diameter, top = height;
  for (int i : order) largest = std::max(largest, g.diameter[i]), top = std::max(top, g.y[i] + g.diameter[i]);
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "Bed of livebed: SI units, floor at y = 0, periodic in x\n\n{} atoms\n1 atom types\n\n0 {} xlo xhi\n{} {} "
      "ylo yhi\n{} {} zlo zhi\n\nAtoms # sphere\n\n",
      g.count(), params.length, -2 * largest, top, -2 * largest, 2 * largest);
  for (int i : order)
    fmt::format_to(out, "{} 1 {} {} {} {} 0\n", g.id[i] + 1, g.diameter[i], params.density, g.x[i], g.y[i]);
  text += "\nVelocities\n\n";
  for (int i : order) fmt::format_to(out, "{} {} {} 0 0 0 {}\n", g.id[i] + 1, g.u[i], g.v[i], g.omega[i]);
  write_atomically(path, text);
}

LammpsBed read_lammps(const Path& path) {
  const std::string text = read_file(path);
  Lines line(path, std::string_view(text).substr(std::min(text.find('\n'), text.size())));  // the first is a title
  double count = -1, low = 0, high = 0;
  std::map<long long, Atom> found;
  enum class Section { header, atoms, velocities, other } section = Section::header;
  while (line.next()) {
    const auto& words = line.words();
    if (!line.begins_with_number()) {
      section = words[0] == "Atoms" ? Section::atoms : words[0] == "Velocities" ? Section::velocities : Section::other;
      continue;
    }
    if (section == Section::header) {
      if (words.size() == 2 && words[1] == "atoms") count = line.number(0, "number of atoms");
      if (words.size() == 4 && words[2] == "xlo") low = line.number(0, "xlo"), high = line.number(1, "xhi");
    } else if (section == Section::atoms) {
      if (!found.emplace(static_cast<long long>(line.number(0, "id")), read_atom(line)).second)
        line.fault(fmt::format("the id {} comes twice", words[0]));
    } else if (section == Section::velocities) {
      const auto atom = found.find(static_cast<long long>(line.number(0, "id")));
      if (atom == found.end())
        line.fault(fmt::format("velocity of atom {}, which the section Atoms does not have", words[0]));
      atom->second.u = line.number(1, "vx"), atom->second.v = line.number(2, "vy");
      atom->second.omega = words.size() > 6 ? line.number(6, "wz") : 0;
    }
  }
  if (count < 0 || !(high > low) || found.empty())
    fail(Exit::input_output,
         "{} is no LAMMPS data file of grains: it needs \"N atoms\", \"xlo xhi\" and a section Atoms", path.string());
  if (static_cast<double>(found.size()) != count)
    fail(Exit::input_output, "{} holds {} atoms and tells of {}", path.string(), found.size(), count);
  LammpsBed bed;
  bed.length = high - low;
  for (const auto& [id, a] : found) {
    if (a.x < low || a.x > high)
      fail(Exit::input_output, "{}: atom {} at x = {} m lies outside the box, {} to {} m", path.string(), id, a.x, low,
           high);
    const double x = a.x - low;
    bed.x.push_back(x < bed.length ? x : x - bed.length);
    bed.y.push_back(a.y), bed.diameter.push_back(a.diameter), bed.density.push_back(a.density);
    bed.u.push_back(a.u), bed.v.push_back(a.v), bed.omega.push_back(a.omega);
  }
  return bed;
}

}  // namespace livebed::io
