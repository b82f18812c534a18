#pragma once
#include "validate/result.hpp"

namespace livebed::validate {

/// What is too long for a test: oblique impacts against the measured ones, the energy of colliding grains, beds that
/// come to rest with every damping, heaps, bins.
Result grains(const Tell& tell);

}  // namespace livebed::validate
