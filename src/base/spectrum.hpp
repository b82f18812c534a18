#pragma once
#include <vector>

namespace livebed::base {

/// Power spectral density of a signal, its mean taken away.
struct Spectrum {
  std::vector<double> frequency;  ///< [1/time]
  std::vector<double> power;      ///< [signal^2 time]; its integral is the variance, but for the window's leakage
};

/// Periodogram under a Hann window of the signal at the times t (ascending, any distances; linear in between), on
/// frequencies four times as dense as the record's 1/length, up to `highest`.
Spectrum power_spectrum(const std::vector<double>& t, const std::vector<double>& signal, double highest);

/// Frequency of the largest power above three times 1/length of the record (below that a spectrum shows drift), from
/// the parabola through the logarithms of the three powers about it; 0 when all are 0.
double peak_frequency(const Spectrum& spectrum);

/// Times at which the signal goes up through its mean.
std::vector<double> upward_crossings(const std::vector<double>& t, const std::vector<double>& signal);

/// Mean of the signal in time (trapezoids).
double time_mean(const std::vector<double>& t, const std::vector<double>& signal);
/// Root of the mean square of the signal less its mean.
double time_rms(const std::vector<double>& t, const std::vector<double>& signal);

}  // namespace livebed::base
