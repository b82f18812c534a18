#include "io/base64.hpp"

#include <gtest/gtest.h>

namespace livebed::io {
namespace {

TEST(base64, has_its_padding) {
  EXPECT_EQ(base64("sand"), "c2FuZA==");
  EXPECT_EQ(base64("sands"), "c2FuZHM=");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
  EXPECT_EQ(base64(""), "");
}

TEST(base64, comes_back_whatever_the_bytes) {
  std::string bytes;
  for (int n = 0; n < 300; ++n) {
    EXPECT_EQ(from_base64(base64(bytes)), bytes);
    bytes += static_cast<char>(n * 37);
  }
}

TEST(base64, refuses_other_letters_and_lengths) {
  for (const char* text : {"c2FuZA=", "c2Fu_A==", "c2F=ZA==", "=", "c2Fu\n"}) EXPECT_FALSE(from_base64(text)) << text;
}

}  // namespace
}  // namespace livebed::io
