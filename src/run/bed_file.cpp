#include "run/bed_file.hpp"

namespace livebed::run {

namespace {

/// Arrays of bytes travel as int32.
template <class Vector>
void write_array(io::Group& group, const char* name, const Vector& values) {
  if constexpr (std::is_same_v<typename Vector::value_type, std::uint8_t>)
    group.write(name, std::vector<std::int32_t>(values.begin(), values.end()));
  else
    group.write(name, values);
}
template <class Vector>
void read_array(const io::Group& group, const char* name, Vector& values) {
  if constexpr (std::is_same_v<typename Vector::value_type, std::uint8_t>) {
    std::vector<std::int32_t> wide;
    group.read(name, wide);
    values.assign(wide.begin(), wide.end());
  } else {
    group.read(name, values);
  }
}

template <class GroupLike, class BedLike>
void pass_bed_scalars(GroupLike& g, BedLike& bed) {
  pass(g, "pipe_present", bed.pipe.present), pass(g, "pipe_x", bed.pipe.x), pass(g, "pipe_y", bed.pipe.y);
  pass(g, "pipe_diameter", bed.pipe.diameter);
  auto& built = bed.contacts.pipe_built;
  pass(g, "built_pipe_present", built.present), pass(g, "built_pipe_x", built.x), pass(g, "built_pipe_y", built.y);
  pass(g, "built_pipe_diameter", built.diameter);
  pass(g, "rebuilds", bed.contacts.rebuilds), pass(g, "refreshed", bed.contacts.refreshed), pass(g, "steps", bed.steps);
  pass(g, "outside", bed.outside);
  pass(g, "pipe_impulse_x", bed.pipe_impulse.x), pass(g, "pipe_impulse_y", bed.pipe_impulse.y);
}

}  // namespace

void write_bed(io::Group& group, const grains::Bed& bed) {
  grains::each_array(bed, [&](const char* name, const auto& a) { write_array(group, name, a); });
  pass_bed_scalars(group, bed);
}

grains::Bed read_bed(const io::Group& group, const grains::Params& complete) {
  grains::Bed bed = grains::make_bed(complete);
  bed.contacts.set_single(complete.precision == grains::Precision::mixed);
  grains::each_array(bed, [&](const char* name, auto& a) { read_array(group, name, a); });
  pass_bed_scalars(group, bed);
  return bed;
}

}  // namespace livebed::run
