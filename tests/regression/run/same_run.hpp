#pragma once
#include <hdf5.h>

#include "program.hpp"
#include "run/checkpoint.hpp"

namespace livebed {

/// Adds the bytes of every dataset below an HDF5 group to the list.
inline void read_datasets(hid_t group, const std::string& name, std::map<std::string, std::string>& all) {
  hsize_t count = 0;
  H5Gget_num_objs(group, &count);
  for (hsize_t k = 0; k < count; ++k) {
    char leaf[256];
    H5Gget_objname_by_idx(group, k, leaf, sizeof leaf);
    const std::string path = name + "/" + leaf;
    if (H5Gget_objtype_by_idx(group, k) == H5G_GROUP) {
      const hid_t below = H5Gopen2(group, leaf, H5P_DEFAULT);
      read_datasets(below, path, all);
      H5Gclose(below);
      continue;
    }
    const hid_t data = H5Dopen2(group, leaf, H5P_DEFAULT), type = H5Dget_type(data), space = H5Dget_space(data);
    std::string bytes(H5Tget_size(type) * static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), '\0');
    H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    all[path] = bytes;
    H5Sclose(space), H5Tclose(type), H5Dclose(data);
  }
}

/// What a checkpoint holds, but for the times on the wall.
inline std::map<std::string, std::string> datasets_of(const fs::path& checkpoint) {
  const hid_t file = H5Fopen(checkpoint.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  std::map<std::string, std::string> all;
  read_datasets(file, "", all);
  H5Fclose(file);
  for (const char* wall : {"wall_flow", "wall_grains", "wall_exchange", "wall_output", "start_wall"})
    EXPECT_EQ(all.erase(std::string("/run/") + wall), 1u) << wall;
  return all;
}

/// Two finished runs must hold the same: tables, frames and series of frames byte for byte, checkpoints of the same
/// steps, the last one value by value.
inline void expect_same_run(const fs::path& a, const fs::path& b) {
  auto files_a = everything_in(a), files_b = everything_in(b);
  for (auto* files : {&files_a, &files_b})
    std::erase_if(*files, [](const auto& file) {
      // What tells of wall times, of the program's own course and of the folder's place.
      return file.first == "log.txt" || file.first == "paraview-state.py" || file.first == "summary.json" ||
             file.first.ends_with(".h5");
    });
  EXPECT_GT(files_a.size(), 7u);
  for (const auto& [name, bytes] : files_a) {
    ASSERT_TRUE(files_b.contains(name)) << name << " is not in " << b;
    EXPECT_TRUE(bytes == files_b[name]) << name << " differs between " << a << " and " << b;
  }
  EXPECT_EQ(files_a.size(), files_b.size());

  const auto saved_a = run::list_checkpoints(a), saved_b = run::list_checkpoints(b);
  ASSERT_FALSE(saved_a.empty() || saved_b.empty());
  ASSERT_EQ(saved_a.back().filename(), saved_b.back().filename());
  const auto last_a = datasets_of(saved_a.back()), last_b = datasets_of(saved_b.back());
  EXPECT_GT(last_a.size(), 50u);
  ASSERT_EQ(last_a.size(), last_b.size());
  for (const auto& [name, bytes] : last_a)
    EXPECT_TRUE(last_b.contains(name) && bytes == last_b.at(name))
        << name << " differs in the last checkpoint of " << b;
}

}  // namespace livebed
