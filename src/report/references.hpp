#pragma once
#include <string_view>

/// Measurements that are part of the program: the files of data/ with their source headers.
namespace livebed::report {

/// S/D against time, Mao (1986), D = 0.05 m, theta = 0.33, e/D = 0: columns t_s, S_over_D.
extern const std::string_view mao_depth;
/// Bed profiles of the same experiment at 11 and 25 s: columns t_s, x_D, y_bed_D and others.
extern const std::string_view mao_profiles;
/// Time scale of that experiment [s]: T = D^2 / sqrt(g (s-1) d^3) theta^(-5/3) / 50.
inline constexpr double mao_time_scale = 11.5;
/// Times of his profiles [s].
inline constexpr double mao_profile_times[] = {11, 25};

}  // namespace livebed::report
