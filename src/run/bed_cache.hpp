#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "case/case.hpp"
#include "grains/packing.hpp"

namespace livebed::run {

/// Packed beds kept from run to run, so that the second run of a case starts at once and with the same bits as the
/// first. A bed belongs to everything that decides it: all keys that could matter, the seed among them, and the program
/// itself. One HDF5 file a bed, written atomically.  Nothing that goes wrong here stops a run: a file that is damaged
/// or foreign is told and made anew, a folder that cannot be written is told.
class BedCache {
public:
  using Say = std::function<void(const std::string& line)>;
  using Make = std::function<grains::Packing()>;

  /// Beds of the folder are kept below this size in all; the ones used least recently go first.
  static constexpr std::uintmax_t most_bytes = 2'000'000'000;

  /// folder: made when a bed is kept first; empty: no bed is looked for or kept.
  explicit BedCache(
      std::filesystem::path folder = {}, Say say = [](const std::string&) {}, std::uintmax_t limit = most_bytes)
      : folder_(std::move(folder)), say_(std::move(say)), limit_(limit) {}

  /// The bed of the key, or else what `make` returns, which is kept.  complete: its parameters but for the count.
  grains::Packing get(const std::string& key, const grains::Params& complete, const Make& make) const;

  std::filesystem::path file_of(const std::string& key) const;

private:
  void keep(const std::string& key, const grains::Packing& packing) const;
  void make_room(std::uintmax_t bytes) const;

  std::filesystem::path folder_;
  Say say_;
  std::uintmax_t limit_;
};

/// Everything of a case and of this program that decides how its bed is packed, as text.
std::string packing_key(const casefile::Case& c);

/// $XDG_CACHE_HOME/livebed, or else ~/.cache/livebed; empty where neither is known.
std::filesystem::path default_bed_cache();

}  // namespace livebed::run
