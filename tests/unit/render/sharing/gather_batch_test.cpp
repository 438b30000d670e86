// SPDX-License-Identifier: BSD-2-Clause
// These tests render passes that share their gathers in one batch.
#include "core/render/sharing/passes/gather_batch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr PixelBounds kPart{17, 9, 23, 14};

using Sharing = RenderPass::Sharing;

// A room whose walls get light from a lamp and from each other.
std::string Room(const std::string& filter) {
  return "PixelFilter \"" + filter + "\"\n" +
         TestHeader(R"("exphotonmap" "integer indirectphotons" [ 5000 ] "integer causticphotons" )"
                    R"([ 0 ] "integer finalgathersamples" [ 8 ] "bool sharedgather" "true" )"
                    R"("integer edgesamples" 1)",
                    40, 32, 4) +
         R"(WorldBegin
    AttributeBegin
      AreaLightSource "area" "color L" [ 20 18 15 ]
      Translate 0 .9 2 Rotate 90 1 0 0 Shape "disk" "float radius" [ .3 ]
    AttributeEnd
    Material "matte" "color Kd" [ .7 .5 .2 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point P" [ -1 -1 0  1 -1 0  1 -1 3  -1 -1 3 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point P" [ -1 -1 3  1 -1 3  1 1 3  -1 1 3 ]
    WorldEnd
)";
}

struct Settings {
  bool isBatch = true;
  RenderOptions options = {};
  const char* filter = "box";
  std::optional<PixelBounds> crop = {};
  int threads = 1;
};

// Renders four samples a pixel in passes of these sizes.
Image RenderPasses(const std::vector<std::int64_t>& sizes, const Settings& settings) {
  LoadOptions load;
  load.pixelBounds = settings.crop;
  LoadedScene scene = LoadSceneText(Room(settings.filter), load);
  RenderSetup& setup = *scene.setup;
  Film film(setup.film.Full(), setup.crop), one(film);
  ThreadPool threads(settings.threads);
  ProgressReporter progress(ProgressReporter::Mode::Quiet);
  Statistics statistics;
  const RenderJob job{*setup.scene, *setup.integrator, *setup.sampler, *setup.filter, *setup.camera,
                      film,         threads,           *scene.log,     progress,      statistics};
  PassRenderer renderer(job, settings.options);
  std::int64_t first = 0;
  for (const std::int64_t size : sizes) {
    RenderPass pass{1, 2, first, size};
    if (settings.isBatch)
      pass.sharing = first == 0 ? Sharing::BeginsBatch : Sharing::ContinuesBatch;
    one.Clear();
    renderer.Run(pass, *setup.sampler, &one);
    film.Add(one);
    first += size;
  }
  renderer.Finish();
  return film.ToImage(true);
}

double LargestDifference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, double(std::abs(a.pixels[i] - b.pixels[i])));
  return largest;
}

// The part is the crop window that the tests use.
void ExpectPart(const Image& part, const Image& whole) {
  for (int y = 9; y < 14; ++y)
    for (int x = 17; x < 23; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_EQ(part.pixels[std::size_t((y - 9) * 6 + x - 17) * 4 + c],
                  whole.pixels[std::size_t(y * 40 + x) * 4 + c]);
}

TEST(GatherBatch, GivesThePictureOfOnePass) {
  for (const char* filter : {"box", "mitchell"}) {
    const Image whole = RenderPasses({4}, {false, {}, filter});
    const Image batch = RenderPasses({1, 1, 2}, {true, {}, filter});
    const Image apart = RenderPasses({1, 1, 2}, {false, {}, filter});
    // Sums in another order may change the choice of a window.
    const double difference = LargestDifference(apart, whole);
    EXPECT_GT(difference, .01) << filter;
    EXPECT_LT(LargestDifference(batch, whole), .2 * difference) << filter;
  }
}

TEST(GatherBatch, DependsOnNoThreadTileOrCrop) {
  const Image whole = RenderPasses({2, 2}, {});
  RenderOptions options;
  options.tileSize = 5;
  options.tileOrder = TileOrder::Reversed;
  EXPECT_EQ(RenderPasses({2, 2}, {true, options, "box", {}, 3}).pixels, whole.pixels);
  const Image part = RenderPasses({2, 2}, {true, {}, "box", kPart});
  ExpectPart(part, whole);
}

// A crop does not change what fits, so it does not change the picture either.
TEST(GatherBatch, EndsWhereTheMemoryEnds) {
  const double pixels = 40 * 32;
  RenderOptions options;
  options.sharingMemory = pixels * GatherFragments::BytesPerPixel(2) / 4;
  ASSERT_TRUE(GatherBatch::Fits({0, 0, 40, 32}, 2, 4 * options.sharingMemory));
  const Image batches = RenderPasses({1, 1, 2}, {true, options});
  const Image part = RenderPasses({1, 1, 2}, {true, options, "box", kPart});
  ExpectPart(part, batches);
  EXPECT_GT(LargestDifference(batches, RenderPasses({1, 1, 2}, {})), 1e-2);
  options.sharingMemory = 0;
  EXPECT_EQ(RenderPasses({1, 1, 2}, {true, options}).pixels,
            RenderPasses({1, 1, 2}, {false, options}).pixels);
}

}  // namespace
}  // namespace exphoton
