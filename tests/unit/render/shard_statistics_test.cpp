// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/shards/shard_statistics.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

TEST(ShardStatisticsTest, TimesOfAllShardsAddUp) {
  Statistics merged;
  for (const double share : {1., 2.}) {
    Statistics statistics;
    statistics.AddPhase("shoot", 10 * share, 30 * share);
    ShardStatistics saved(statistics), loaded;
    ByteArchive saving;
    saved.Transfer(&saving);
    const std::string bytes = saving.Take();
    ByteArchive loading(bytes);
    loaded.Transfer(&loading);
    loaded.AddTimes(&merged);
  }
  ASSERT_EQ(merged.Phases().size(), 1u);
  EXPECT_EQ(merged.Phases()[0].name, "shoot");
  EXPECT_EQ(merged.Phases()[0].wallSeconds, 30);
  EXPECT_EQ(merged.Phases()[0].cpuSeconds, 90);
}

}  // namespace
}  // namespace exphoton
