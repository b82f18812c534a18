#pragma once
// The template part of transfer.hpp.
#include "base/loops.hpp"

namespace livebed::coupling {

template <std::size_t M, class Values>
void Transfer::scatter(const grains::State& g, const std::array<base::Field*, M>& fields, Values&& values) const {
  const int bins = static_cast<int>(bin_first_.size()) - 1;
  for (int parity = 0; parity < 2; ++parity) {
    base::for_each_item(0, (bins - parity + 1) / 2, [&](int half) {
      const int bin = 2 * half + parity;
      Footprint f;
      for (int k = bin_first_[bin]; k < bin_first_[bin + 1]; ++k) {
        const int n = order_[k];
        footprint(g.x[n], g.y[n], f);
        const std::array<double, M> value = values(n);
        for (int b = 0; b < f.nj; ++b) {
          const int j = f.j0 + b;
          const double* open = open_.row(j) + f.i0;
          const double wy = f.wy[b] * f.scale;
          for (std::size_t m = 0; m < M; ++m) {
            double* to = fields[m]->row(j) + f.i0;
            for (int a = 0; a < f.ni; ++a) to[a] += wy * f.wx[a] * open[a] * value[m];
          }
        }
      }
    });
  }
}

}  // namespace livebed::coupling
