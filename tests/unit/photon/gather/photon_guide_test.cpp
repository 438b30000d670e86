// SPDX-License-Identifier: BSD-2-Clause
// These tests check PhotonGuide. It must follow photons from directions where light is dense.
// A pixel's camera samples must share guiding directions if they see nearly the same place,
// and only then.
#include "integrators/photon/gather/photon_guide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/lambert.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kPhotons = 8;
const Cone kGuideCone(Radians(20));
const Vector3 kPatch = Normalize(Vector3(1, 0, 1));

enum class Light { OfAPatch, OfTheSky, OfBoth };

// Returns photons on the square (0, 0)-(1, 1) of the plane z = 0, from above and from below.
// Photons of a patch come from within 6 degrees of kPatch or of its mirror image.
PhotonMap Photons(Light light) {
  RandomStream random(7);
  PhotonBuffer buffer;
  for (int i = 0; i < 1000; ++i) {
    const bool isOfPatch = light == Light::OfAPatch || (light == Light::OfBoth && i % 4 < 2);
    const Vector3 sky = SampleCosineHemisphere({random.Uniform(), random.Uniform()});
    Vector3 w = isOfPatch ? Normalize(kPatch + Real(.1) * sky) : sky;
    if (i % 2) w.z = -w.z;
    buffer.Add({{random.Uniform(), random.Uniform(), 0}, w, Spectrum(1), Real(1e-9)});
  }
  buffer.paths = 1;
  ThreadPool threads(1);
  return PhotonMap(std::move(buffer), threads);
}

class PhotonGuideTest : public testing::Test {
 protected:
  using Directions = std::vector<Vector3>;

  ThreadState* threadState_ = nullptr;

  // Returns the guiding directions at (x, .5, 0), seen from the side of `wo`.
  Directions At(Real x, const Vector3& wo, PixelState* pixelState) {
    Arena arena;
    return Listed(Guide(x, wo, {photons_, kPhotons}, pixelState, &arena));
  }
  struct Nearest {
    const PhotonMap& photons;
    int count;
  };
  GuidedDirections Guide(Real x, const Vector3& wo, const Nearest& nearest, PixelState* pixelState,
                         Arena* arenaPointer) {
    const auto& [photons, count] = nearest;
    Arena& arena = *arenaPointer;
    PhotonGuide guide(count, kGuideCone);
    guide.Prepare(photons);
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
    context.pixelState = pixelState;
    context.threadState = threadState_;
    return guide.Directions(point, context);
  }
  static Directions Listed(const GuidedDirections& guide) {
    Directions directions;
    for (std::size_t i = 0; i < guide.axes.size(); ++i) directions.push_back(guide.axes[i]);
    return directions;
  }

  const Vector3 above_{0, 0, 1}, below_{0, 0, -1};
  const Real step_ = Real(.01), far_ = Real(.3);  // the k-NN radius is about .05

 private:
  LoadedScene scene_ = LoadSceneText("WorldBegin\nShape \"sphere\"\nWorldEnd\n");
  PhotonMap photons_ = Photons(Light::OfAPatch);
};

TEST_F(PhotonGuideTest, HoldsDirectionsThatLightTheSideThatIsSeen) {
  for (const Vector3& wo : {above_, below_}) {
    const Directions directions = At(Real(.5), wo, nullptr);
    EXPECT_FALSE(directions.empty());
    EXPECT_LT(directions.size(), std::size_t(kPhotons));
    for (const Vector3& w : directions) EXPECT_GT(w.z * wo.z, 0);
  }
}

TEST_F(PhotonGuideTest, FollowsPhotonsOfAPatchAndLeavesThoseOfTheSkyToTheBsdf) {
  constexpr int kMany = 200;
  const PhotonMap both = Photons(Light::OfBoth);
  Arena arena;
  const GuidedDirections guide = Guide(Real(.5), above_, {both, kMany}, nullptr, &arena);
  const Directions followed = Listed(guide);
  ASSERT_FALSE(followed.empty());
  for (const Vector3& w : followed) EXPECT_GT(Dot(w, kPatch), std::cos(Radians(30)));
  EXPECT_NEAR(guide.share, .5, .15);  // photons of the patch, and photons of the sky near it
}

TEST_F(PhotonGuideTest, LeavesASurfaceThatIsLitFromEverywhereToTheBsdf) {
  constexpr int kMany = 400;
  const PhotonMap sky = Photons(Light::OfTheSky);
  Arena arena;
  const GuidedDirections guide = Guide(Real(.5), above_, {sky, kMany}, nullptr, &arena);
  EXPECT_LT(guide.share, .05);
}

TEST_F(PhotonGuideTest, ServesTheNextSampleOfAPixelCloseBy) {
  PixelState pixelState;
  const Directions first = At(Real(.4), above_, &pixelState);
  EXPECT_EQ(first, At(Real(.4), above_, nullptr));
  ASSERT_NE(At(Real(.4) + step_, above_, nullptr), first);
  EXPECT_EQ(At(Real(.4) + step_, above_, &pixelState), first);
}

TEST_F(PhotonGuideTest, IsFoundAnewWhereASampleSeesAnotherPlaceOrTheOtherSide) {
  PixelState pixelState;
  At(Real(.4), above_, &pixelState);
  const Real place = Real(.4) + far_;
  EXPECT_EQ(At(place, above_, &pixelState), At(place, above_, nullptr));
  EXPECT_EQ(At(place, below_, &pixelState), At(place, below_, nullptr));
  // The next sample must reuse the new directions.
  EXPECT_EQ(At(place + step_, below_, &pixelState), At(place, below_, nullptr));
}

TEST_F(PhotonGuideTest, OfAPassIsTheSameWhateverWasLookedAtBefore) {
  ThreadState pass, fresh;
  for (int i = 0; i < 40; ++i) {
    const Real x = Real(.1) + far_ * Real(i % 3) + Real(.0011) * Real(i);
    const Vector3& wo = i % 2 ? above_ : below_;
    threadState_ = &pass;
    const Directions found = At(x, wo, nullptr);
    threadState_ = &fresh;
    fresh.Reset();
    ASSERT_EQ(At(x, wo, nullptr), found);
    ASSERT_FALSE(found.empty());
  }
}

TEST_F(PhotonGuideTest, IsForgottenWithThePixel) {
  PixelState pixelState;
  const Real next = Real(.4) + step_;
  ASSERT_NE(At(next, above_, nullptr), At(Real(.4), above_, nullptr));
  At(Real(.4), above_, &pixelState);
  pixelState.Reset();
  EXPECT_EQ(At(next, above_, &pixelState), At(next, above_, nullptr));
}

}  // namespace
}  // namespace exphoton
