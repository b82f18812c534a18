#include "case/ids.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace livebed::casefile {

IdsRead read_ids(std::string_view text) {
  IdsRead result;
  constexpr std::string_view blanks = " \t\n";
  if (text.find_first_not_of(blanks) == text.npos) return result;
  for (std::size_t end = 0; end != text.npos; text.remove_prefix(std::min(text.size(), end + 1))) {
    end = text.find(',');
    std::string_view word = text.substr(0, end);
    word.remove_prefix(std::min(word.size(), word.find_first_not_of(blanks)));
    word = word.substr(0, word.find_last_not_of(blanks) + 1);
    int id = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), id);
    if (error != std::errc{} || stop != word.data() + word.size() || id < 0)
      return {{}, fmt::format("\"{}\" is no id of a grain: give whole numbers from 0 on, as in \"12, 40\"", word)};
    if (std::find(result.ids.begin(), result.ids.end(), id) != result.ids.end())
      return {{}, fmt::format("{} stands there twice", id)};
    result.ids.push_back(id);
    if (end == text.npos) break;
  }
  return result;
}

}  // namespace livebed::casefile
