#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Numbers as the page reads them: the same bytes come from the server of a running program and out of report.html.
namespace livebed::report {

/// Named arrays in one block of bytes, little endian:
///   "LBP1", length of the head (uint32), head (JSON, padded with blanks to a multiple of 4), arrays (each padded to
///   4).
/// The head holds what was given to it and "arrays": [{name, type ("f4", "u2", "u1"), count, from, to}].  Integers n of
/// largest value N stand for from + n / N (to - from).
class Pack {
public:
  nlohmann::ordered_json head;

  /// Single precision.
  void floats(std::string name, std::span<const double> values);
  /// 65536 or 256 steps between the smallest and the largest value.
  void shorts(std::string name, std::span<const double> values);
  void bytes(std::string name, std::span<const double> values);

  std::string str() const;

private:
  template <class Integer>
  void steps(std::string name, const char* type, std::span<const double> values);

  nlohmann::ordered_json arrays_ = nlohmann::ordered_json::array();
  std::string block_;
};

/// Compressed by zlib.
std::string deflated(std::string_view bytes);

}  // namespace livebed::report
