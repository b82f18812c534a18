#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace livebed::casefile {

/// Grains named by their ids, "12, 40"; fault: what is wrong with the text, empty when nothing is.
struct IdsRead {
  std::vector<int> ids;
  std::string fault;
};
IdsRead read_ids(std::string_view text);

}  // namespace livebed::casefile
