#pragma once
#include <cmath>

namespace livebed::base {

/// A point or vector in the vertical plane: x along the current, y upwards.
struct Vec2 {
  double x = 0, y = 0;
};

inline constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
inline constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }

}  // namespace livebed::base
