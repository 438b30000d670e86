// SPDX-License-Identifier: BSD-2-Clause
// Tests of searches among points in a build with EXPHOTON_STOCHASTIC. The last block of a tree
// repeats its last point, and the last node its last box. There these repetitions have other
// distances than the original, and no search may choose them.
#ifdef EXPHOTON_STOCHASTIC

#include <gtest/gtest.h>

#include "core/spatial/nearest_search.h"
#include "tests/rounding/measure/results.h"
#include "tests/rounding/measure/subjects.h"
#include "tests/rounding/runtime/rounding.h"
#include "tests/support/point_trees.h"

namespace exphoton::rounding {
namespace {

// Returns disks along a line, each of which covers all of it.
std::vector<TestDisk> Disks(int count) {
  std::vector<TestDisk> disks;
  for (int i = 0; i < count; ++i) {
    TestDisk disk;
    disk.p = {Real(i) / 7, Real(1) / 3, Real(1) / 3};
    disk.direction = EncodeOctahedral({0, 0, 1});
    disk.radius2 = 1e4;
    disks.push_back(disk);
  }
  return disks;
}

TEST(RoundingSearches, FindNoPointOrBlockBeyondTheLast) {
  for (const int count : {1, 17, 16 * 17 + 1}) {
    RoundAtRandom(0);
    const TestPointTree tree(Disks(count));
    const std::vector<ClosestQuery> queries(3, {{Real(count) / 7, Real(.1), 0}, {0, 0, 1}});
    for (std::uint64_t key = 1; key <= 50; ++key) {
      RoundAtRandom(key);
      const NearestSearch& search = FastestNearestSearch();
      ASSERT_LE(search.blockNear(tree.View(), queries[0].p), std::uint32_t(count - 1) / 16);
      for (const std::size_t together : {1, 3}) {
        std::vector<ClosestPoint> found(together);
        search.closest(tree.View(), {0, Real(1e4)}, {queries.data(), together}, found.data());
        for (const ClosestPoint& each : found) ASSERT_LT(each.index, std::uint32_t(count));
      }
    }
  }
  RoundAtRandom(0);
}

// A search that read beyond the last block found what memory happened to hold there, so this case
// had other pictures in each run.
TEST(RoundingSearches, GiveTheSamePicturesEachTime) {
  std::vector<Subject> cases = ReadHardCases().all;
  std::erase_if(cases, [](const Subject& each) { return NameOf(each) != "54 caustics/2"; });
  ASSERT_EQ(cases.size(), 1u);
  const auto render = [&] {
    constexpr std::uint64_t kKeys[] = {5, 9, 12};  // these pictures differed
    std::vector<std::vector<double>> pictures;
    for (const TestRender& each :
         RenderSubject(cases[0], 3, [&](int i) { RoundAtRandom(kKeys[i]); }))
      pictures.push_back(each.values);
    RoundAtRandom(0);
    return pictures;
  };
  render();  // makes tables of the process
  const auto first = render();
  std::vector<std::vector<char>> moved;  // other pieces of memory are free now
  for (std::size_t i = 0; i < 200; ++i) moved.emplace_back(1000 + 37 * i, char(i));
  EXPECT_EQ(first, render());
}

}  // namespace
}  // namespace exphoton::rounding

#endif
