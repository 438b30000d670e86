// SPDX-License-Identifier: BSD-2-Clause
// A guide serves the camera samples of a pixel that see nearly the same, and no others.
#include "integrators/photon/gather_guide.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/math/random.h"
#include "core/math/sampling.h"
#include "core/scattering/lambert.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kPhotons = 8;

// Photons on the square (0, 0)-(1, 1) of the plane z = 0, from above and from below.
PhotonMap Photons() {
  RandomStream random(7);
  PhotonHaul haul;
  for (int i = 0; i < 1000; ++i) {
    Vector3 w = SampleCosineHemisphere({random.Uniform(), random.Uniform()});
    if (i % 2) w.z = -w.z;
    haul.Add({{random.Uniform(), random.Uniform(), 0}, w, Spectrum(1)});
  }
  haul.paths = 1;
  ThreadPool threads(1);
  return PhotonMap(std::move(haul), threads);
}

class GatherGuideTest : public testing::Test {
 protected:
  using Directions = std::vector<Vector3>;

  // At (x, .5, 0), seen from the side of `wo`.
  Directions At(Real x, const Vector3& wo, PixelNotes* notes) {
    Arena arena;
    RayCounters rays;
    const CameraSamples samples{SampleLayout()};
    SurfaceInteraction surface;
    surface.p = {x, Real(.5), 0};
    surface.ng = surface.shading.n = {0, 0, 1};
    surface.dpdu = surface.shading.dpdu = {1, 0, 0};
    surface.dpdv = surface.shading.dpdv = {0, 1, 0};
    surface.wo = wo;
    ShadingPoint point{surface, Bsdf(surface), RayDifferential(), 0};
    point.bsdf.Add(arena.Make<Lambert>(Spectrum(Real(.8))));
    LiContext context{*scene_.setup->scene, samples, arena, rays, 0};
    context.notes = notes;
    const ConeAxes axes = GatherGuide(kPhotons).Directions(point, photons_, context);
    Directions directions;
    for (std::size_t i = 0; i < axes.size(); ++i) directions.push_back(axes[i]);
    return directions;
  }

  const Vector3 above_{0, 0, 1}, below_{0, 0, -1};
  const Real step_ = Real(.02), far_ = Real(.3);  // a search reaches about .05

 private:
  LoadedScene scene_ = LoadSceneText("WorldBegin\nShape \"sphere\"\nWorldEnd\n");
  PhotonMap photons_ = Photons();
};

TEST_F(GatherGuideTest, HoldsDirectionsThatLightTheSideThatIsSeen) {
  for (const Vector3& wo : {above_, below_}) {
    const Directions directions = At(Real(.5), wo, nullptr);
    EXPECT_FALSE(directions.empty());
    EXPECT_LT(directions.size(), std::size_t(kPhotons));
    for (const Vector3& w : directions) EXPECT_GT(w.z * wo.z, 0);
  }
}

TEST_F(GatherGuideTest, ServesTheNextSampleOfAPixelCloseBy) {
  PixelNotes notes;
  const Directions first = At(Real(.4), above_, &notes);
  EXPECT_EQ(first, At(Real(.4), above_, nullptr));
  ASSERT_NE(At(Real(.4) + step_, above_, nullptr), first);
  EXPECT_EQ(At(Real(.4) + step_, above_, &notes), first);
}

TEST_F(GatherGuideTest, IsFoundAnewWhereASampleSeesAnotherPlaceOrTheOtherSide) {
  PixelNotes notes;
  At(Real(.4), above_, &notes);
  const Real place = Real(.4) + far_;
  EXPECT_EQ(At(place, above_, &notes), At(place, above_, nullptr));
  EXPECT_EQ(At(place, below_, &notes), At(place, below_, nullptr));
  // And that one then serves in its turn.
  EXPECT_EQ(At(place + step_, below_, &notes), At(place, below_, nullptr));
}

TEST_F(GatherGuideTest, IsForgottenWithThePixel) {
  PixelNotes notes;
  const Real next = Real(.4) + step_;
  ASSERT_NE(At(next, above_, nullptr), At(Real(.4), above_, nullptr));
  At(Real(.4), above_, &notes);
  notes.Reset();
  EXPECT_EQ(At(next, above_, &notes), At(next, above_, nullptr));
}

}  // namespace
}  // namespace exphoton
