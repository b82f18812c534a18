#include "report/pack.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <zlib.h>

#include "base/fault.hpp"

namespace livebed::report {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

namespace {

void pad(std::string& bytes, char with) { bytes.resize((bytes.size() + 3) / 4 * 4, with); }

template <class Number>
void append(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

void Pack::floats(std::string name, std::span<const double> values) {
  arrays_.push_back({{"name", std::move(name)}, {"type", "f4"}, {"count", values.size()}});
  for (double v : values) append(block_, static_cast<float>(v));
}

template <class Integer>
void Pack::steps(std::string name, const char* type, std::span<const double> values) {
  constexpr double largest = std::numeric_limits<Integer>::max();
  double from = 0, to = 0;
  if (!values.empty()) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    from = *least, to = *most;
  }
  arrays_.push_back({{"name", std::move(name)}, {"type", type}, {"count", values.size()}, {"from", from}, {"to", to}});
  const double scale = to > from ? largest / (to - from) : 0;
  for (double v : values) append(block_, static_cast<Integer>(std::lround((v - from) * scale)));
  pad(block_, '\0');
}

void Pack::shorts(std::string name, std::span<const double> values) {
  steps<std::uint16_t>(std::move(name), "u2", values);
}
void Pack::bytes(std::string name, std::span<const double> values) {
  steps<std::uint8_t>(std::move(name), "u1", values);
}

std::string Pack::str() const {
  nlohmann::ordered_json all = head;
  all["arrays"] = arrays_;
  std::string text = all.dump();
  pad(text, ' ');
  std::string out = "LBP1";
  append(out, static_cast<std::uint32_t>(text.size()));
  return out + text + block_;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int failed = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  if (failed != Z_OK) base::fail(base::Exit::internal, "zlib could not compress {} bytes: {}", bytes.size(), failed);
  out.resize(size);
  return out;
}

}  // namespace livebed::report
