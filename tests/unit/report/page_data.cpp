#include "report/page_data.hpp"

#include <cstring>
#include <gtest/gtest.h>

#include "../io/expect_fault.hpp"
#include "../io/temporary_folder.hpp"
#include "synthetic_run.hpp"

namespace livebed::report {
namespace {

/// Reads a Pack as the page does.
struct Opened {
  nlohmann::json head;
  std::map<std::string, std::vector<double>> arrays;

  explicit Opened(const std::string& bytes) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 4, 4);
    head = nlohmann::json::parse(bytes.substr(8, size));
    std::size_t at = 8 + size;
    for (const auto& array : head["arrays"]) {
      const std::string type = array["type"];
      std::vector<double>& values = arrays[array["name"]];
      const double from = array.value("from", 0.0), to = array.value("to", 0.0);
      for (std::size_t n = 0; n < array["count"].get<std::size_t>(); ++n) {
        if (type == "f4") values.push_back(read<float>(bytes, at));
        if (type == "u2") values.push_back(from + read<std::uint16_t>(bytes, at) / 65535.0 * (to - from));
        if (type == "u1") values.push_back(from + read<std::uint8_t>(bytes, at) / 255.0 * (to - from));
      }
      at = (at + 3) / 4 * 4;
    }
    EXPECT_EQ(at, bytes.size());
  }

private:
  template <class Number>
  static double read(const std::string& bytes, std::size_t& at) {
    Number value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
    return value;
  }
};

class PageData : public testing::Test {
protected:
  void SetUp() override {
    synthetic.snapshots = 2;
    synthetic.write(folder.path());
    run = read_run(folder.path());
  }
  TemporaryFolder folder;
  SyntheticRun synthetic;
  RunFolder run;
};

TEST_F(PageData, tables_are_thinned_to_so_many_rows_and_the_last) {
  const Opened series(pack_series(run, 0, 100));
  EXPECT_EQ(series.head["rows"], 710);
  const std::vector<double>& t = series.arrays.at("time_s");
  EXPECT_LE(t.size(), 101u);
  EXPECT_GT(t.size(), 80u);
  EXPECT_NEAR(t[1], 0.08, 1e-6);
  EXPECT_NEAR(t.back(), 7.09, 1e-6);
  EXPECT_NEAR(series.arrays.at("S_over_D").back(), synthetic.depth(7.09) / synthetic.D, 1e-6);
}

TEST_F(PageData, of_a_growing_table_only_the_new_rows_are_told) {
  const Opened series(pack_series(run, 700, 5000)), none(pack_series(run, 710, 5000));
  EXPECT_EQ(series.arrays.at("time_s").size(), 10u);
  EXPECT_NEAR(series.arrays.at("time_s").front(), 7, 1e-6);
  EXPECT_EQ(none.head["rows"], 710);
  EXPECT_TRUE(none.arrays.at("time_s").empty());

  const Opened bed(pack_bed(run, 140, 5000));
  EXPECT_EQ(bed.head["rows"], 142);
  EXPECT_NEAR(bed.head["level_m"].get<double>(), synthetic.level, 1e-9);
  ASSERT_EQ(bed.arrays.at("time").size(), 2u);
  ASSERT_EQ(bed.arrays.at("y").size(), 2u * 500u);
  EXPECT_NEAR(bed.arrays.at("y")[500 + 200], synthetic.bed(0.2005, 7.05), 1e-6);
}

TEST_F(PageData, a_frame_has_its_fields_and_grains_to_a_step_of_sixteen_bits) {
  const Opened frame(pack_frame(run, 1));
  EXPECT_NEAR(frame.head["time"].get<double>(), 7.1, 1e-9);
  EXPECT_EQ(frame.head["nx"], 200);
  const io::Grid water = io::read_vtr(run.path / run.fields[1].file);
  const auto& u = io::array(water.cells, "velocity").values;
  for (std::size_t n = 0; n < 16000; n += 97) EXPECT_NEAR(frame.arrays.at("u")[n], u[3 * n], 5e-5) << n;
  const io::Points sand = io::read_vtp(run.path / run.grains[1].file);
  ASSERT_EQ(frame.arrays.at("grain_x").size(), sand.x.size());
  for (std::size_t n = 0; n < sand.x.size(); n += 101) {
    EXPECT_NEAR(frame.arrays.at("grain_x")[n], sand.x[n], 4e-6);
    EXPECT_NEAR(frame.arrays.at("grain_d")[n], 0.002, 1e-9);
  }
  expect_io_fault([&] { pack_frame(run, 2); }, {"no frame 2", "there are 2"});
}

TEST_F(PageData, the_head_describes_the_case) {
  const auto head = describe(run, all_frames(run));
  EXPECT_EQ(head["title"], "A hole made of <formulas>");
  EXPECT_EQ(head["frames"].size(), 2u);
  EXPECT_EQ(head["frames"][1]["n"], 1);
  EXPECT_EQ(head["measured"]["S_over_D"].size(), 48u - 6u);
  EXPECT_NEAR(head["pipe"]["D_m"].get<double>(), 0.05, 1e-6);
}

}  // namespace
}  // namespace livebed::report
