#include "app/server.hpp"

#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
// The header-only part of the library; what it is compiled with is fixed by Debian's package.
#include <httplib.h>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sys/random.h>

#include "base/fault.hpp"
#include "io/file.hpp"
#include "report/analysis.hpp"
#include "report/page.hpp"
#include "report/page_data.hpp"
#include "run/control.hpp"

namespace livebed::app {

namespace {

using base::Exit;
using base::fail;
using httplib::Request;
using httplib::Response;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr std::size_t all_rows = static_cast<std::size_t>(-1) / 2;

std::string random_word(int bytes) {
  std::array<unsigned char, 16> raw{};
  if (::getrandom(raw.data(), raw.size(), 0) != static_cast<ssize_t>(raw.size()))
    fail(Exit::internal, "the system has no random numbers");
  std::string word;
  for (int n = 0; n < bytes; ++n) word += fmt::format("{:02x}", raw[n]);
  return word;
}

/// Compares in a time that does not tell how many letters are right.
bool same(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t n = 0; n < a.size(); ++n) difference |= static_cast<unsigned char>(a[n] ^ b[n]);
  return difference == 0;
}

/// The run folder as the page sees it.  One look at the disk answers all requests of a second.
class Watched {
public:
  explicit Watched(fs::path folder) : folder_(std::move(folder)) {}

  template <class Use>
  std::string with_run(Use&& use) {
    const std::lock_guard hold(mutex_);
    if (Clock::now() - looked_ > std::chrono::milliseconds(900)) {
      // A bed that is being packed has no resolved case yet.
      if (!fs::exists(folder_ / "case.resolved.toml") && run::is_running(folder_)) {
        run_ = report::RunFolder{};
        run_.path = folder_;
        run_.title = fs::weakly_canonical(folder_).filename().string();
      } else {
        run_ = report::read_run(folder_);
      }
      looked_ = Clock::now();
    }
    return use(run_);
  }

  std::string analysis() {
    const report::RunFolder run = copy();
    const std::lock_guard hold(near_bed_mutex_);  // frames are measured while other requests go on
    near_bed_.update(run);
    return report::analyse(run, near_bed_).dump();
  }
  std::string motion() {
    const std::lock_guard hold(near_bed_mutex_);
    return report::pack_motion(near_bed_);
  }
  report::RunFolder copy() {
    report::RunFolder run;
    with_run([&](const report::RunFolder& r) { return run = r, std::string(); });
    return run;
  }

private:
  fs::path folder_;
  std::mutex mutex_, near_bed_mutex_;
  report::RunFolder run_;
  Clock::time_point looked_{};
  report::NearBed near_bed_;
};

nlohmann::ordered_json status_of(const fs::path& folder) {
  nlohmann::ordered_json status = nlohmann::ordered_json::object();
  std::error_code ignored;
  if (fs::exists(folder / "status.json", ignored)) {
    try {
      status = nlohmann::ordered_json::parse(io::read_file(folder / "status.json"), nullptr, false);
    } catch (const base::Fault&) {  // it went away in between: the run has ended
    }
    if (!status.is_object()) status = nlohmann::ordered_json::object();
  }
  status["alive"] = run::is_running(folder);
  return status;
}

std::size_t whole_number(const std::string& text) {
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(Exit::input_output, "\"{}\" is no whole number", text);
  return n;
}

/// The library's threads, which tell when nothing has been asked for a while.
class Threads : public httplib::ThreadPool {
public:
  explicit Threads(std::function<void()> idle) : httplib::ThreadPool(4), idle_(std::move(idle)) {}
  void on_idle() override { idle_(); }

private:
  std::function<void()> idle_;
};

class PageServer {
public:
  PageServer(fs::path folder, const ServerOptions& options)
      : folder_(std::move(folder)), options_(options), watched_(folder_) {
    bind();
    routes();
  }

  void listen() {
    http_.new_task_queue = [this] { return new Threads([this] { end_if_unneeded(); }); };
    http_.set_idle_interval(1);
    if (!options_.ready(fmt::format("http://127.0.0.1:{}/", port_))) return;
    asked_ = Clock::now();
    if (!http_.listen_after_bind())
      fail(Exit::input_output, "the page can no longer be served on port {}; begin again with: livebed watch DIR",
           port_);
  }

private:
  void bind() {
    // Not the library's own options: they let two servers share one port without a word.
    http_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    const int first = options_.port > 0 ? options_.port : default_port, tries = options_.port > 0 ? 1 : 10;
    for (port_ = first; port_ < first + tries; ++port_)
      if (http_.bind_to_port("127.0.0.1", port_)) return;
    fail(Exit::input_output, "port {} is taken; name a free one with --port",
         tries == 1 ? fmt::to_string(first) : fmt::format("{} to {}", first, first + tries - 1));
  }

  /// Is this request from a page of ours, or from a program on this machine?
  bool trusted(const Request& request) const {
    const auto ours = [this](const std::string& host) {
      return host == fmt::format("127.0.0.1:{}", port_) || host == fmt::format("localhost:{}", port_);
    };
    if (!ours(request.get_header_value("Host"))) return false;
    if (request.has_header("Origin")) {
      const std::string origin = request.get_header_value("Origin");
      if (!origin.starts_with("http://") || !ours(origin.substr(7))) return false;
    }
    const std::string site = request.get_header_value("Sec-Fetch-Site");
    // A link from elsewhere may open the page itself; its data may not be asked for from there.
    return site.empty() || site == "same-origin" || site == "none" || request.path == "/";
  }

  void routes() {
    http_.set_payload_max_length(64);
    http_.set_keep_alive_timeout(2);
    http_.set_default_headers({{"Cache-Control", "no-store"},
                               {"X-Content-Type-Options", "nosniff"},
                               {"X-Frame-Options", "DENY"},
                               {"Referrer-Policy", "no-referrer"},
                               {"Cross-Origin-Resource-Policy", "same-origin"}});
    http_.set_pre_routing_handler([this](const Request& request, Response& response) {
      if (trusted(request)) {
        asked_ = Clock::now();
        return Server::HandlerResponse::Unhandled;
      }
      refuse(response, 403, "this server answers to its own page on this machine only");
      return Server::HandlerResponse::Handled;
    });
    http_.set_exception_handler([](const Request&, Response& response, std::exception_ptr error) {
      try {
        std::rethrow_exception(error);
      } catch (const std::exception& told) {
        refuse(response, 500, told.what());
      }
    });
    http_.Get("/", [this](const Request&, Response& response) { give_page(response); });
    http_.Get("/data/run.json", [this](const Request&, Response& response) { give_head(response); });
    http_.Get(R"(/data/(series|bed))", [this](const Request& request, Response& response) {
      const std::size_t first = request.has_param("first") ? whole_number(request.get_param_value("first")) : 0;
      const bool series = request.matches[1] == "series";
      give(response, watched_.with_run([&](const report::RunFolder& run) {
        return series ? report::pack_series(run, first, all_rows) : report::pack_bed(run, first, all_rows);
      }));
    });
    http_.Get(R"(/data/frame/(\d+))", [this](const Request& request, Response& response) {
      give(response, report::pack_frame(watched_.copy(), whole_number(request.matches[1])));
    });
    http_.Get("/data/analysis.json", [this](const Request&, Response& response) {
      response.set_content(watched_.analysis(), "application/json");
    });
    http_.Get("/data/motion", [this](const Request&, Response& response) { give(response, watched_.motion()); });
    http_.Post("/command", [this](const Request& request, Response& response) { take_command(request, response); });
  }

  void give_page(Response& response) {
    const std::string nonce = random_word(16);
    response.set_header(
        "Content-Security-Policy",
        fmt::format("default-src 'none'; script-src 'nonce-{}'; style-src 'unsafe-inline'; img-src data: "
                    "blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
                    nonce));
    const std::string title = watched_.with_run([](const report::RunFolder& run) { return run.title; });
    response.set_content(report::page(title, {{"mode", "live"}, {"token", token_}, {"server", server_}}, "", nonce),
                         "text/html; charset=utf-8");
  }

  void give_head(Response& response) {
    response.set_content(watched_.with_run([this](const report::RunFolder& run) {
      nlohmann::ordered_json head = report::describe(run, report::all_frames(run));
      head["status"] = status_of(folder_);
      head["server"] = server_;
      return head.dump();
    }),
                         "application/json");
  }

  void take_command(const Request& request, Response& response) {
    if (!same(request.get_header_value("X-Livebed-Token"), token_))
      return refuse(response, 403, "wrong token: load the page anew");
    if (!run::command_of(request.body))
      return refuse(response, 400, fmt::format("no such command; there are {}", run::command_words));
    if (!run::is_running(folder_)) return refuse(response, 409, "the run is not going on");
    io::write_atomically(folder_ / "command", request.body + "\n");
    response.set_content("asked", "text/plain");
  }

  static void give(Response& response, const std::string& bytes) {
    response.set_content(bytes, "application/octet-stream");
  }
  static void refuse(Response& response, int status, const std::string& why) {
    response.status = status;
    response.set_content(why, "text/plain; charset=utf-8");
  }

  void end_if_unneeded() {
    if (options_.linger <= 0 || run::is_running(folder_)) return;
    if (std::chrono::duration<double>(Clock::now() - asked_.load()).count() > options_.linger) http_.stop();
  }

  using Server = httplib::Server;
  fs::path folder_;
  ServerOptions options_;
  Watched watched_;
  Server http_;
  int port_ = 0;
  const std::string token_ = random_word(16), server_ = random_word(4);
  std::atomic<Clock::time_point> asked_{Clock::now()};
};

}  // namespace

void serve(const fs::path& folder, const ServerOptions& options) { PageServer(folder, options).listen(); }

}  // namespace livebed::app
