#include "report/report.hpp"

#include "report/sections.hpp"

namespace livebed::report {

namespace {

constexpr const char* style = R"css(
:root{--ink:#1d2126;--dim:#667;--paper:#fff;--box:#f3f5f7;--rule:#d5dae0}
@media(prefers-color-scheme:dark){:root{--ink:#e4e7ea;--dim:#9aa3ad;--paper:#14171a;--box:#20252a;--rule:#3a424a}}
body{margin:0 auto;max-width:1240px;padding:1rem 1.5rem 4rem;font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper)}
h1{margin:.5rem 0 0;font-size:1.6rem}h2{margin:2.2rem 0 .4rem;font-size:1.2rem;border-bottom:1px solid var(--rule)}h3{margin:.8rem 0 .2rem;font-size:.95rem}
p{margin:.4rem 0;color:var(--dim)}.origin{font-size:.85rem}
.cards{display:flex;flex-wrap:wrap;gap:.6rem;margin:1rem 0}.card{background:var(--box);border-radius:.4rem;padding:.5rem .8rem;min-width:8rem;max-width:17rem}
.card b{display:block;font-size:1.3rem}.card span,.card small{display:block;color:var(--dim)}.card small{font-size:.78rem}
.missing{border-left:4px solid #d9a32e;background:var(--box);padding:.4rem .8rem}.missing ul{margin:.2rem 0;padding-left:1.2rem}
img{display:block;width:100%;margin:.6rem 0;border:1px solid var(--rule)}
.row{display:flex;flex-wrap:wrap;gap:.4rem 1.4rem}.chart{max-width:100%;height:auto;font-size:12px}
.chart text{fill:var(--ink)}.axis path{stroke:var(--rule)}.axis rect{fill:none;stroke:var(--dim)}
.legend{font-size:.85rem;padding-left:74px}.legend span{margin-right:1rem}.legend i{display:inline-block;margin-right:.35rem;vertical-align:middle}
.legend .line{width:22px;border-top:2px solid var(--c)}.legend .dash{width:22px;border-top:2px dashed var(--c)}.legend .dot{width:8px;height:8px;border-radius:50%;background:var(--c)}
pre{background:var(--box);padding:.8rem;overflow:auto;font-size:.82rem}summary{cursor:pointer;padding:.3rem 0}
)css";

}  // namespace

Written write_report(const io::Path& folder) {
  const RunFolder run = read_run(folder);
  const std::vector<Stage> shown = stages(run);
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>Livebed report</title><style>";
  page += style;
  page += "</style></head><body>\n";
  page += head_section(run) + depth_section(run) + snapshot_section(run, shown) + profile_section(run) +
          series_section(run) + case_section(run);
  page += "</body></html>\n";
  const io::Path path = folder / "report.html";
  io::write_atomically(path, page);
  return {path, static_cast<int>(shown.size()), run.missing};
}

double write_picture(const io::Path& folder, double time, const io::Path& out_png) {
  const RunFolder run = read_run(folder);
  const Stage stage = nearest_stage(run, time);
  const auto [snapshot, options] = load_stage(run, stage);
  io::write_atomically(out_png, draw(snapshot, options).png());
  return stage.time;
}

}  // namespace livebed::report
