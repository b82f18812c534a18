#pragma once
#include <cmath>
#include <numbers>

/// Small numbers and helpers that every part shares.
namespace livebed::base {

inline constexpr double pi = std::numbers::pi;

inline constexpr double square(double a) { return a * a; }
inline constexpr double cube(double a) { return a * a * a; }

/// Volume of a sphere of diameter d [m3].  The only place where pi/6 d^3 is typed (A3 of the paper's Table 2).
inline constexpr double sphere_volume(double d) { return pi / 6.0 * cube(d); }
/// Frontal area of a sphere of diameter d [m2] (A2 d^2 of the paper's Table 2).
inline constexpr double sphere_area(double d) { return pi / 4.0 * square(d); }

}  // namespace livebed::base
