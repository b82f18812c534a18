#include "io/png.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <sstream>
#include <vector>

#include "base/fault.hpp"
#include "io/file.hpp"
#include "temporary_folder.hpp"

namespace livebed::io {
namespace {

TEST(png, vtk_reads_the_pixels_that_were_written) {
  const TemporaryFolder folder;
  const int width = 7, height = 5;
  std::vector<std::uint8_t> rgb;
  for (int n = 0; n < 3 * width * height; ++n) rgb.push_back(static_cast<std::uint8_t>(n * 37 % 256));
  write_atomically(folder / "a.png", png(width, height, rgb));
  const std::string command =
      "/usr/bin/python3 -c \"from vtkmodules.vtkIOImage import vtkPNGReader as R; r = R(); r.SetFileName('" +
      (folder / "a.png").string() +
      "'); r.Update(); o = r.GetOutput(); w, h = o.GetDimensions()[:2]; "
      "print(w, h, *[int(o.GetScalarComponentAsDouble(i, h - 1 - j, 0, c)) for j in range(h) for i in range(w) for c "
      "in "
      "range(3)])\" 2>&1";
  std::string text;
  FILE* pipe = ::popen(command.c_str(), "r");
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, n);
  ASSERT_EQ(::pclose(pipe), 0) << "this test needs Debian's python3-vtk9; it said:\n" << text;
  std::istringstream in(text);
  int w = 0, h = 0;
  in >> w >> h;
  EXPECT_EQ(w, width);
  EXPECT_EQ(h, height);
  for (std::size_t n = 0; n < rgb.size(); ++n) {
    int value = -1;
    in >> value;
    ASSERT_EQ(value, rgb[n]) << n;
  }
}

TEST(png, a_wrong_number_of_bytes_is_refused) {
  EXPECT_THROW(png(2, 2, std::vector<std::uint8_t>(11)), base::Fault);
  EXPECT_THROW(png(0, 2, {}), base::Fault);
}

}  // namespace
}  // namespace livebed::io
