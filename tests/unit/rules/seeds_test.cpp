// SPDX-License-Identifier: BSD-2-Clause
// These tests check the files that hold the seeds of the fuzz targets.
#include "tests/fuzz/seeds.h"

#include <gtest/gtest.h>

namespace exphoton::fuzz {
namespace {

TEST(FuzzSeeds, AreTheSameAfterPackingAndUnpacking) {
  const std::vector<std::string> seeds{"", "\n", "12\n", std::string("a\0b\xff", 4), "3\nabc\n"};
  EXPECT_EQ(UnpackSeeds(PackSeeds(seeds)), seeds);
  EXPECT_TRUE(UnpackSeeds("").empty());
}

TEST(FuzzSeeds, ThatAreDamagedAreErrors) {
  const std::string packed = PackSeeds({"abc", "de"});
  for (std::size_t size = 1; size < packed.size(); ++size)
    if (size != PackSeeds({"abc"}).size())
      EXPECT_THROW(UnpackSeeds(packed.substr(0, size)), std::runtime_error) << size;
  for (const char* text :
       {"x\nabc\n", "4\nabc\n", "2\nabc\n", "-1\n\n", "99999999999999999999\na\n"})
    EXPECT_THROW(UnpackSeeds(text), std::runtime_error) << text;
}

}  // namespace
}  // namespace exphoton::fuzz
