#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/approach.hpp"
#include "report/near_bed.hpp"
#include "report/run_folder.hpp"

/// The numbers that the page shows beside the curves.
namespace livebed::report {

/// A stage of scour and when it begins.
struct ScourStage {
  std::string name;
  double begins = 0;  ///< [s]
  std::string rule;   ///< how it was found
};

/// Onset, tunnel erosion, lee-wake erosion and equilibrium as far as the run has come, by the rules told with them:
/// onset: the bed under the pipe's centre has fallen by a grain for good; tunnel: a gap of a tenth of D; lee-wake: the
/// hole, smoothed over a fifth of T, deepens at less than a fifth of its fastest; equilibrium: the depth, smoothed
/// over half a T, has come within 5 % of its steady value for good.  The steady value is that of base::equilibrium over
/// 2 T with a change of 0.02.
std::vector<ScourStage> find_stages(const std::vector<double>& t, const std::vector<double>& S_over_D,
                                    const std::vector<double>& under_over_D, double T, double d_over_D);

/// Is this Mao's (1986) experiment: D = 5 cm, e/D = 0, theta = 0.33?  Grains may be enlarged: times compare as t/T.
bool is_maos_case(const RunFolder& run);

/// Everything at once, as the page reads it; what the run has nothing for is null or missing.
nlohmann::ordered_json analyse(const RunFolder& run, const NearBed& near_bed);

}  // namespace livebed::report
