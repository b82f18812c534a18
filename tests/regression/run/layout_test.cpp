#include <algorithm>
#include <hdf5.h>
#include <regex>
#include <set>
#include <sstream>

#include "run/checkpoint.hpp"
#include "same_run.hpp"

/// docs/checkpoints.md names every dataset of a checkpoint, and no other.
namespace livebed {
namespace {

using CheckpointLayout = Program;
using Names = std::set<std::string>;

/// The datasets of a page's tables; a heading like "## `/flow`" names the group of the rows below.
Names documented() {
  Names names;
  std::istringstream page(content(LIVEBED_SOURCE_DIR "/docs/checkpoints.md"));
  std::string group;
  const std::regex word("`([a-z_]+)`");
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## `/")) group = line.substr(5, line.rfind('`') - 5) + "/";
    if (line.starts_with("## ") && !line.starts_with("## `")) group.clear();
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find('|', 1));
    for (std::sregex_iterator it(cell.begin(), cell.end(), word), end; it != end; ++it)
      names.insert(group + (*it)[1].str());
  }
  return names;
}

/// The datasets of a file, as HDF5 itself lists them.
Names stored(const fs::path& file) {
  Names names;
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_GE(id, 0) << "HDF5 cannot open " << file;
  const auto take = [](hid_t from, const char* name, const H5L_info_t*, void* found) -> herr_t {
    const hid_t object = H5Oopen(from, name, H5P_DEFAULT);
    if (H5Iget_type(object) == H5I_DATASET) static_cast<Names*>(found)->insert(name);
    return H5Oclose(object);
  };
  H5Lvisit(id, H5_INDEX_NAME, H5_ITER_INC, take, &names);
  H5Fclose(id);
  return names;
}

/// Those of one set that another has not.
Names without(const Names& some, const Names& others) {
  Names rest;
  std::set_difference(some.begin(), some.end(), others.begin(), others.end(), std::inserter(rest, rest.end()));
  return rest;
}

TEST_F(CheckpointLayout, is_what_the_page_says) {
  ASSERT_EQ(run("--threads 1 " + small_run("0.01", "paper")).exit, 0);
  const std::string ours =
      " --set coupling.voidage=on --set coupling.drag=di_felice --set coupling.dispersion=random_walk"
      " --set coupling.exchange=implicit --set output.profiles_every=0.1 --set output.tracks_every=0.1"
      " --set output.contacts_every=0.1 --set bed.supply=none";
  ASSERT_EQ(run("--threads 1 " + small_run("0.01", "ours" + ours)).exit, 0);
  const Names paper = stored(run::list_checkpoints(*this / "paper").back());
  Names all = stored(run::list_checkpoints(*this / "ours").back());
  EXPECT_GT(all.size(), paper.size());
  all.insert(paper.begin(), paper.end());
  const Names page = documented();
  EXPECT_EQ(without(all, page), Names{}) << "docs/checkpoints.md does not name these";
  EXPECT_EQ(without(page, all), Names{}) << "docs/checkpoints.md names these, which are not in the files";
}

}  // namespace
}  // namespace livebed
