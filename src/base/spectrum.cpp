#include "base/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/curves.hpp"
#include "base/math.hpp"

namespace livebed::base {

double time_mean(const std::vector<double>& t, const std::vector<double>& signal) {
  double sum = 0;
  for (std::size_t k = 1; k < t.size(); ++k) sum += 0.5 * (signal[k] + signal[k - 1]) * (t[k] - t[k - 1]);
  return sum / (t.back() - t.front());
}

double time_rms(const std::vector<double>& t, const std::vector<double>& signal) {
  const double mean = time_mean(t, signal);
  std::vector<double> squares;
  for (double s : signal) squares.push_back(square(s - mean));
  return std::sqrt(time_mean(t, squares));
}

std::vector<double> upward_crossings(const std::vector<double>& t, const std::vector<double>& signal) {
  const double mean = time_mean(t, signal);
  std::vector<double> times;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double before = signal[k - 1] - mean, now = signal[k] - mean;
    if (before < 0 && now >= 0) times.push_back(t[k] - now / (now - before) * (t[k] - t[k - 1]));
  }
  return times;
}

Spectrum power_spectrum(const std::vector<double>& t, const std::vector<double>& signal, double highest) {
  constexpr int samples_a_period = 8, lines_a_bin = 4;
  const double length = t.back() - t.front(), mean = time_mean(t, signal);
  const int n = static_cast<int>(std::ceil(samples_a_period * highest * length));
  std::vector<double> sample(n);
  double window_power = 0;
  for (int k = 0; k < n; ++k) {
    const double window = 0.5 - 0.5 * std::cos(2 * pi * k / n);
    window_power += square(window);
    sample[k] = window * (interpolate(t, signal, t.front() + length * k / n) - mean);
  }
  Spectrum spectrum;
  const double step = length / n;
  for (int line = 1; line <= lines_a_bin * highest * length; ++line) {
    const double frequency = line / (lines_a_bin * length);
    const std::complex<double> turn = std::polar(1.0, -2 * pi * frequency * step);
    std::complex<double> phase = 1, sum = 0;
    for (double s : sample) sum += s * phase, phase *= turn;
    spectrum.frequency.push_back(frequency);
    spectrum.power.push_back(2 * std::norm(sum) * step / window_power);
  }
  return spectrum;
}

double peak_frequency(const Spectrum& s) {
  constexpr int drift_lines = 12;  // three times 1/length
  if (s.power.size() < drift_lines + 3) return 0;
  const auto first = s.power.begin() + drift_lines;
  const auto peak = std::max_element(first, s.power.end() - 1);
  if (*peak <= 0) return 0;
  const auto k = static_cast<std::size_t>(peak - s.power.begin());
  const double below = std::log(s.power[k - 1]), at = std::log(s.power[k]), above = std::log(s.power[k + 1]);
  const double curvature = below - 2 * at + above;
  const double shift = curvature < 0 ? std::clamp(0.5 * (below - above) / curvature, -0.5, 0.5) : 0.0;
  return s.frequency[k] + shift * (s.frequency[1] - s.frequency[0]);
}

}  // namespace livebed::base
