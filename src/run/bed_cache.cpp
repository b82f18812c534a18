#include "run/bed_cache.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "base/version.hpp"
#include "case/schema.hpp"
#include "grains/kernels.hpp"
#include "io/file.hpp"
#include "run/bed_file.hpp"

namespace livebed::run {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t format_version = 1;
constexpr std::string_view prefix = "bed-", suffix = ".h5";

/// FNV-1a.
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char byte : bytes) {
    h ^= static_cast<unsigned char>(byte);
    h *= 0x100000001b3u;
  }
  return h;
}

/// Another build may round differently or pack otherwise, whatever its version says.
std::string this_build() {
  return fmt::format("{} {} {} {}", base::version(), base::compiler(), base::instruction_set(), base::packing_code());
}

/// Can a key change the packing?  Better a bed too many than a wrong one: all count but those known not to.
bool decides_packing(std::string_view name) {
  for (const std::string_view needed : {"time.grain_step", "mesh.length", "flow.density"}) {
    if (name == needed) return true;
  }
  for (const std::string_view table :
       {"case.", "mesh.", "pipe.", "flow.", "current.", "coupling.", "time.", "output."}) {
    if (name.starts_with(table)) return false;
  }
  return name != "preset" && name != "bed.level" && name != "grains.precision";
}

std::uintmax_t size_of(const grains::Bed& bed) {
  std::uintmax_t bytes = 1 << 16;  // names, attributes and scalars
  grains::each_array(bed, [&](const char*, const auto& a) {
    bytes += a.size() * std::max<std::size_t>(sizeof a[0], sizeof(std::int32_t));
  });
  return bytes;
}

}  // namespace

std::string packing_key(const casefile::Case& c) {
  std::string key = fmt::format("build = {}\nkernels = {}\n", this_build(), grains::kernels().name);
  for (const casefile::Row& row : casefile::schema()) {
    if (decides_packing(row.name)) key += fmt::format("{} = {}\n", row.name, casefile::written(row.get(c)));
  }
  return key;
}

fs::path default_bed_cache() {
  // A relative path in XDG_CACHE_HOME is to be ignored, says the specification.
  const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
  if (cache && *cache == '/') return fs::path(cache) / "livebed";
  return home && *home == '/' ? fs::path(home) / ".cache" / "livebed" : fs::path();
}

fs::path BedCache::file_of(const std::string& key) const {
  return folder_ / fmt::format("{}{:016x}{}", prefix, hash_of(key), suffix);
}

grains::Packing BedCache::get(const std::string& key, const grains::Params& complete, const Make& make) const {
  if (folder_.empty()) return make();
  const fs::path file = file_of(key);
  if (fs::exists(file)) {
    try {
      const io::Hdf5Reader reader(file);
      const io::Group root = reader.root();
      std::int64_t format = 0;
      std::string its_key;
      root.read("format", format);
      if (format != format_version) base::fail(base::Exit::input_output, "{} has the format {}", file.string(), format);
      root.read("key", its_key);
      if (its_key != key) base::fail(base::Exit::input_output, "{} holds the bed of another case", file.string());
      grains::Params p = complete;
      const io::Group bed = root.open("bed");
      p.count = static_cast<int>(bed.length("id"));
      grains::Packing packing{.bed = read_bed(bed, p), .convergence = {}};
      grains::check_count(packing.bed);
      std::vector<double> rows;
      root.read("convergence", rows);
      for (std::size_t k = 0; k + 3 < rows.size(); k += 4) {
        packing.convergence.push_back({rows[k], rows[k + 1], rows[k + 2], rows[k + 3]});
      }
      std::error_code ignored;
      fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // used last of all
      say_(fmt::format("bed of {} grains taken from {}", p.count, file.string()));
      return packing;
    } catch (const base::Fault& fault) {
      say_(fmt::format("{}; packing the bed anew", fault.what()));
    }
  }
  grains::Packing packing = make();
  try {
    keep(key, packing);
  } catch (const base::Fault& fault) {
    say_(fmt::format("the bed is not kept: {}", fault.what()));
  }
  return packing;
}

void BedCache::keep(const std::string& key, const grains::Packing& packing) const {
  const std::uintmax_t bytes =
      size_of(packing.bed) + key.size() + packing.convergence.size() * sizeof(grains::SettleRow);
  if (bytes > limit_) {
    base::fail(base::Exit::input_output, "{:.0f} MB are more than the {:.0f} MB that {} may hold",
               1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(limit_), folder_.string());
  }
  io::make_folder(folder_);
  make_room(bytes);
  io::Hdf5Writer writer(file_of(key));
  io::Group root = writer.root();
  root.write("format", format_version);
  root.write("key", key);
  std::vector<double> rows;
  for (const grains::SettleRow& r : packing.convergence)
    rows.insert(rows.end(), {r.time, r.mean_speed, r.max_speed, r.height});
  root.write("convergence", rows);
  io::Group bed = root.make("bed");
  write_bed(bed, packing.bed);
  writer.save();
}

void BedCache::make_room(std::uintmax_t bytes) const {
  struct Kept {
    fs::file_time_type used;
    std::uintmax_t size;
    fs::path file;
  };
  std::vector<Kept> all;
  std::uintmax_t sum = bytes;
  std::error_code gone;  // another run may clear up at the same time
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const std::uintmax_t size = entry.file_size(gone);
    const fs::file_time_type used = gone ? fs::file_time_type{} : entry.last_write_time(gone);
    if (gone) continue;
    all.push_back({used, size, entry.path()});
    sum += size;
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (const Kept& oldest : all) {
    if (sum <= limit_) return;
    fs::remove(oldest.file, gone);
    sum -= oldest.size;
  }
}

}  // namespace livebed::run
