#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"

/// Many cases out of one: every combination of the values of some keys, each with every seed.
namespace livebed::casefile {

/// A key and the values it goes through, as written on the command line.
struct SweptKey {
  std::string key;
  std::vector<std::string> values;
};

/// Takes "table.key=v1,v2,..." apart.  A comma within quotes, brackets or braces belongs to a value.  Throws
/// base::Fault (command line) when one has no value, one twice, or a key comes twice.
std::vector<SweptKey> swept_keys(const std::vector<std::string>& settings);

/// One case of a sweep.
struct SweptCase {
  std::size_t combination = 0;         ///< cases that differ in nothing but their seed share it
  std::string name;                    ///< of keys that vary: "current.theta=0.2,seed=1"; fit for a folder
  std::vector<std::string> overrides;  ///< of the case file
  Case given;
};

/// All of them: the first key changes slowest, the seed fastest.  No seeds: that of the case.  Throws base::Fault: what
/// read_case throws, with every distinct fault of all combinations.
std::vector<SweptCase> sweep(const std::filesystem::path& path, const std::vector<SweptKey>& keys,
                             const std::vector<long long>& seeds);

/// Column of a table for the value of a key: its name with its unit, "grains.diameter_m".
std::string column_of(const std::string& key);

/// The value of a key in a case without quotes: a number in SI units, or a word.
std::string plain_value(const Case& c, const std::string& key);

}  // namespace livebed::casefile
