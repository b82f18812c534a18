#include <cstdio>

#include "../tests/unit/report/synthetic_run.hpp"

/// Writes a run folder made of formulas, as large as those of real sand: 194,000 grains of 0.36 mm, 400,000 cells,
/// eight frames.  For tests/browser/speed.mjs.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: page_run FOLDER\n");
    return 2;
  }
  livebed::SyntheticRun run;
  run.d = 0.00036;
  run.cells = 5;
  run.snapshots = 8;
  run.write(argv[1]);
}
