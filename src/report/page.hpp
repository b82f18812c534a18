#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// The page of web/, built into the program.
namespace livebed::report {

extern const std::string_view page_script, page_style;

/// Data that a frozen page holds under a name (page_data.hpp): an element of its body.
std::string frozen(std::string_view name, std::string_view bytes);

/// The whole page.  settings: what the script begins with, {"mode": "report" | "live" | "compare", ...}; nonce: of the
/// server's content security policy, empty for a file, which carries its own policy: nothing from anywhere.
std::string page(std::string_view title, const nlohmann::ordered_json& settings, std::string_view frozen_data,
                 std::string_view nonce);

}  // namespace livebed::report
