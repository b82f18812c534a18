#include "coupling/gusts.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"
#include "coupling/eddies.hpp"

namespace livebed::coupling {

void Gusts::fill(const flow::Mesh& mesh, const flow::State& state, const base::Field& packed, int top, double C_T,
                 double nu) {
  constexpr int wide = 64;  // columns that go down together
  base::for_each_item(0, (mesh.nx + wide - 1) / wide, [&](int block) {
    const int first = block * wide, last = std::min(mesh.nx, first + wide);
    // The strongest eddies on the way down that still reach.
    double above[wide] = {}, down_to[wide] = {}, life[wide] = {};
    for (int j = mesh.ny - 1; j >= 0; --j) {
      const double y = mesh.centre_y(j);
      const double *here = state.k.row(j), *epsilon = state.epsilon.row(j), *open = mesh.volume.row(j);
      base::vector_loop(first, last, [&](int i) {
        const int c = i - first;
        const bool reached = down_to[c] < y && above[c] > here[i] && open[i] > 0;
        const double size = here[i] * std::sqrt(here[i]) / epsilon[i];
        const double lasts = Eddies::life_time(C_T, here[i], epsilon[i], nu);
        down_to[c] = reached ? down_to[c] : y - size;
        life[c] = reached ? life[c] : lasts;
        above[c] = reached ? above[c] : here[i];
      });
      if (j >= top) continue;
      const double* filled = packed.row(j);
      double *energy = k.row(j), *lasting = time.row(j);
      base::vector_loop(first, last, [&](int i) {
        const int c = i - first;
        const double enters = std::max(0.0, 1.0 - filled[i]) * above[c];
        const double own = Eddies::life_time(C_T, here[i], epsilon[i], nu);
        lasting[i] = enters > here[i] ? life[c] : own;
        energy[i] = std::max(here[i], enters);
      });
    }
  });
}

}  // namespace livebed::coupling
