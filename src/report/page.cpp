#include "report/page.hpp"

#include <fmt/format.h>

#include "io/base64.hpp"
#include "report/chart.hpp"
#include "report/pack.hpp"

namespace livebed::report {

std::string frozen(std::string_view name, std::string_view bytes) {
  return fmt::format("<script type=\"text/plain\" data-name=\"{}\">{}</script>\n", name, io::base64(deflated(bytes)));
}

std::string page(std::string_view title, const nlohmann::ordered_json& settings, std::string_view frozen_data,
                 std::string_view nonce) {
  constexpr std::string_view policy =
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:\">";
  // A closing tag inside the settings (a title may hold one) must not end their element.
  std::string plain = settings.dump();
  for (std::size_t at = plain.find('<'); at != plain.npos; at = plain.find('<', at)) plain.replace(at, 1, "\\u003c");
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">{}<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><link rel=\"icon\" href=\"data:,\"><title>{}</title>"
      "<style>{}</style></head><body><main id=\"main\"></main>\n"
      "<script type=\"application/json\" id=\"settings\">{}</script>\n{}<script{}>{}</script></body></html>\n",
      nonce.empty() ? policy : "", escaped(std::string(title)), page_style, plain, frozen_data,
      nonce.empty() ? "" : fmt::format(" nonce=\"{}\"", nonce), page_script);
}

}  // namespace livebed::report
