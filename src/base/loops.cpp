#include "base/loops.hpp"

#include <omp.h>

#include "base/fault.hpp"

namespace livebed::base {

namespace {
int thread_count = 1;
}

void set_threads(int n) {
  if (n < 1) fail(Exit::command_line, "--threads = {} is not allowed; give 1 or more", n);
  thread_count = n;
}

int threads() { return thread_count; }
int available_threads() { return omp_get_num_procs(); }

}  // namespace livebed::base
