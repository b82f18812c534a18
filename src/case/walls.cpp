#include "case/walls.hpp"

#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace livebed::casefile {
namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(end + 1)) {
    end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
  }
  return parts;
}

std::string_view skip_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  return begin == std::string_view::npos ? std::string_view{} : text.substr(begin);
}

/// Takes a number off the front of the text.
std::optional<double> take_number(std::string_view& text) {
  text = skip_blanks(text);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return {};
  text.remove_prefix(end - text.data());
  return number;
}

}  // namespace

WallsRead read_walls(std::string_view text) {
  WallsRead result;
  if (skip_blanks(text).empty()) return result;
  for (const std::string_view line : split(text, ';')) {
    grains::Polyline points;
    for (const std::string_view point : split(line, ',')) {
      std::string_view rest = point;
      const std::optional<double> x = take_number(rest), y = take_number(rest);
      if (!x || !y || !skip_blanks(rest).empty())
        return {{}, fmt::format("\"{}\" is no point: give x and y in metres, as in \"0.1 0.3, 0.1 0\"", point)};
      if (!points.empty() && points.back().x == *x && points.back().y == *y)
        return {{}, fmt::format("the point {} {} stands twice in a row", *x, *y)};
      points.push_back({*x, *y});
    }
    if (points.size() < 2) return {{}, fmt::format("\"{}\" is no line: it needs two points or more", line)};
    result.lines.push_back(std::move(points));
  }
  return result;
}

}  // namespace livebed::casefile
