// SPDX-License-Identifier: BSD-2-Clause
// These tests divide pictures into shards and merge them, in process. Little memory for gathers
// makes many bands of rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "core/render/shards/merge_shards.h"
#include "core/render/shards/shard_writer.h"
#include "core/render/sharing/sharing_bands.h"
#include "tests/support/process.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

TEST(ShardTiles, CoverTheWindowOnceForAnyNumberOfShards) {
  const PixelBounds window{-3, 5, 100, 90};
  for (const int count : {1, 2, 7, 1000}) {
    std::vector<int> covered(std::size_t(window.Width()) * std::size_t(window.Height()));
    std::size_t least = 1000000, most = 0;
    for (int index = 1; index <= count; ++index) {
      const std::vector<ShardTile> tiles = TilesOf({index, count}, window);
      least = std::min(least, tiles.size());
      most = std::max(most, tiles.size());
      for (const ShardTile& tile : tiles) {
        EXPECT_EQ(tile.ShardOf(count), index);
        for (int y = tile.bounds.y0; y < tile.bounds.y1; ++y)
          for (int x = tile.bounds.x0; x < tile.bounds.x1; ++x)
            ++covered[std::size_t(y - window.y0) * std::size_t(window.Width()) +
                      std::size_t(x - window.x0)];
      }
    }
    EXPECT_TRUE(std::all_of(covered.begin(), covered.end(), [](int n) { return n == 1; }));
    EXPECT_LE(most - least, 1u);
  }
}

TEST(ShardTiles, AreSharedEvenlyByAnyNumberOfShardsUpToAThousand) {
  const std::vector<ShardTile> tiles = ShardTiles({-3, 5, 500, 405});
  ASSERT_EQ(tiles.size(), 32u * 25);
  for (int count = 1; count <= 1000; ++count) {
    std::vector<int> sizes(std::size_t(count) + 1);  // by index, from 1
    for (const ShardTile& tile : tiles) {
      ASSERT_GE(tile.ShardOf(count), 1) << count;
      ASSERT_LE(tile.ShardOf(count), count);
      ++sizes[std::size_t(tile.ShardOf(count))];
    }
    const auto [least, most] = std::minmax_element(sizes.begin() + 1, sizes.end());
    EXPECT_LE(*most - *least, 1) << count;
  }
}

TEST(ShardTiles, FollowTheMortonCurve) {
  for (const ShardTile& tile : ShardTiles({0, 0, 64, 64})) {
    const int x = tile.bounds.x0 / 16, y = tile.bounds.y0 / 16;
    EXPECT_EQ(tile.number, (x & 1) | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2);
  }
}

constexpr double kSmallMemory = 4e5;  // several bands in the picture below

class ShardedBands : public testing::TestWithParam<const char*> {
 protected:
  // Renders one shard into a file, or the whole picture if `file` is null. Returns the sums.
  std::string Render(Shard shard, StateWriter* file) {
    LoadedScene scene = LoadSceneText(TestHeader("\"path\"", 50, 90, 4) + R"(
      SurfaceIntegrator "exphotonmap" "integer indirectphotons" 500 "integer causticphotons" 0
        "integer finalgathersamples" 2 "bool sharedgather" "true" )" +
                                      GetParam() + R"(
      WorldBegin
      LightSource "point" "point from" [ 0 .8 1 ] "color I" [ 3 3 3 ]
      Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
        "point P" [ -1 -1 0  1 -1 0  1 -1 3  -1 -1 3 ]
      Translate 0 -.5 2.5 Shape "sphere" "float radius" .5
      WorldEnd)");
    RenderSetup& setup = *scene.setup;
    Film film(setup.film.Full(), setup.crop);
    AovFilm aovs(setup.crop, {Aov::Indirect});
    ThreadPool pool(2);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    Statistics statistics;
    Log log(Log::Level::Quiet, Log::Sink::Memory);
    const RenderJob job{
        *setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera, film, pool,
        log,          progress,          statistics};
    RenderOptions options;
    options.aovs = &aovs;
    options.sharingMemory = kSmallMemory;
    if (!file) {
      exphoton::Render(job, options);
      return Sums(&film, &aovs);
    }
    ShardWriter writer(shard, 1, file);
    options.shard = &writer;
    EXPECT_TRUE(RenderShard(job, options, {}).isComplete);
    if (!filter_) filter_ = std::move(setup.filter);
    return "";
  }

  static std::string Sums(Film* film, AovFilm* aovs) {
    ByteArchive archive;
    film->Transfer(&archive);
    aovs->Transfer(&archive);
    return archive.Take();
  }

  std::string RenderAndMerge(int count) {
    std::deque<StateFile> files;
    ShardMerge merge;
    for (int index = 1; index <= count; ++index) {
      // A shard beyond the number of tiles is empty, so one empty shard replaces the others.
      constexpr int kMostRendered = 30;
      if (index > kMostRendered) {
        merge.parts.push_back(merge.parts.back());
        continue;
      }
      const std::string path = folder_.File(std::to_string(index));
      StateWriter writer(path);
      Render({index, count}, &writer);
      writer.Commit();
      merge.parts.push_back(&files.emplace_back(path, StateUse::Part));
    }
    files.front().Read(kShardSection,
                       [&](ByteArchive* archive) { merge.layout.Transfer(archive); });
    const auto weights = SplatWeights::Of(*filter_);
    merge.splatWeights = weights.get();
    merge.sharingMemory = kSmallMemory;
    Film film(merge.layout.full, merge.layout.crop);
    AovFilm aovs(merge.layout.crop, merge.layout.aovs);
    Statistics statistics;
    Log log(Log::Level::Quiet, Log::Sink::Memory);
    ThreadPool pool(2);
    MergeShards(merge, {&film, &aovs}, {statistics, log, "", {}}, &pool);
    return Sums(&film, &aovs);
  }

  const TestFolder folder_;
  std::unique_ptr<Filter> filter_;
};

TEST_P(ShardedBands, HaveTheSumsOfOneProcess) {
  const PixelBounds window{0, 0, 50, 90};
  ASSERT_GT(PlanBands(window, window, 4, kSmallMemory).size(), 2u);
  const std::string one = Render({}, nullptr);
  ASSERT_LT(ShardTiles(window).size(), 30u);
  for (const int count : {1, 3, 7, 1000}) EXPECT_TRUE(RenderAndMerge(count) == one) << count;
}

INSTANTIATE_TEST_SUITE_P(Filters, ShardedBands,
                         testing::Values("PixelFilter \"box\"", "PixelFilter \"mitchell\""));

}  // namespace
}  // namespace exphoton
