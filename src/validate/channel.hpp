#pragma once
#include <vector>

#include "flow/advance.hpp"
#include "validate/result.hpp"

namespace livebed::validate {

/// Developed flow over a smooth floor of an open channel, far from its inlet, in wall units of its own floor shear.
struct ChannelRun {
  double re_tau = 0;            ///< u* h / nu, as it came out
  std::vector<double> y, u, k;  ///< y+, U+, k+ of the cells
  double seconds = 0;
};

/// first: y+ of the first cell's centre.  The channel is 60 depths long and starts from the log law.
ChannelRun run_channel(flow::Closure closure, double re_tau, double first);

Result channel(const Tell& tell);

}  // namespace livebed::validate
