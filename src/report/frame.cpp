#include "report/frame.hpp"

#include <cmath>

#include "report/pack.hpp"

namespace livebed::report {

std::string pack_frame(const io::Grid& water, const io::Points* grains) {
  Pack pack;
  pack.head = {{"time", water.time},
               {"nx", water.nx()},
               {"ny", water.ny()},
               {"grains", grains != nullptr ? grains->x.size() : 0}};
  pack.floats("x", water.x);
  pack.floats("y", water.y);
  const std::vector<double>& velocity = io::array(water.cells, "velocity").values;
  std::vector<double> u, v;
  for (std::size_t n = 0; n + 2 < velocity.size(); n += 3) u.push_back(velocity[n]), v.push_back(velocity[n + 1]);
  pack.shorts("u", u);
  pack.shorts("v", v);
  if (io::has_array(water.cells, "p")) pack.shorts("p", io::array(water.cells, "p").values);
  for (const char* share : {"solid", "open"})
    if (io::has_array(water.cells, share)) pack.bytes(share, io::array(water.cells, share).values);
  if (grains == nullptr) return pack.str();

  pack.shorts("grain_x", grains->x);
  pack.shorts("grain_y", grains->y);
  pack.bytes("grain_d", io::array(grains->data, "diameter").values);
  const std::vector<double>& motion = io::array(grains->data, "velocity").values;
  std::vector<double> speed;
  for (std::size_t n = 0; n + 2 < motion.size(); n += 3) speed.push_back(std::hypot(motion[n], motion[n + 1]));
  pack.shorts("grain_speed", speed);
  return pack.str();
}

}  // namespace livebed::report
