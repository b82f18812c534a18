#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace livebed::app {

/// Where a server is found, and what it does when nobody needs it any more.
struct ServerOptions {
  int port = 0;       ///< 0: the first free one of default_port and the nine after it
  double linger = 0;  ///< ends when the run is over and no page has asked for this long [s]; 0: serves for ever
  /// Called once the port is taken, before the folder is looked at; serves if it returns true.
  std::function<bool(const std::string& address)> ready;
};
inline constexpr int default_port = 7333;

/// Serves the page of a run folder, of a run that is going on or has ended, to this machine alone.
///
/// It listens on 127.0.0.1 only.  A request must name that address (or localhost) as its Host, and as its Origin if it
/// has one, so that no page from elsewhere can read anything, not even through a name that points here.  Commands (POST
/// /command, one word) must also carry the token that is only in the page which this server hands out; they become the
/// file `command` in the run folder.  Fault (input/output): no folder, no free port.
void serve(const std::filesystem::path& folder, const ServerOptions& options);

}  // namespace livebed::app
