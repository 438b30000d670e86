// SPDX-License-Identifier: BSD-2-Clause
// These tests check ConeDirections: every SIMD target must count and choose the same directions as
// a test of each direction by itself.
#include "integrators/photon/gather/cone_directions.h"

#include <gtest/gtest.h>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

Vector3 AnyDirection(RandomStream* random) {
  return SampleUniformSphere({random->Uniform(), random->Uniform()});
}

TEST(ConeDirections, AreInTheOrderInWhichTheyWereAdded) {
  Arena arena;
  ConeDirections axes(3, &arena);
  axes.Add({0, 0, 1});
  axes.Add({0, -1, 0});
  axes.Finish();
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[0], Vector3(0, 0, 1));
  EXPECT_EQ(axes[1], Vector3(0, -1, 0));
}

TEST(ConeDirections, NoneAreWithinAnythingWhereThereAreNone) {
  const ConeDirections none;
  EXPECT_EQ(none.size(), 0u);
  EXPECT_EQ(none.CountWithin({0, 0, 1}, 4), 0);
}

TEST(ConeDirections, AreCountedAsOneByOneUpToTheWholeSphere) {
  RandomStream random(1);
  Arena arena;
  for (std::size_t count = 1; count <= 70; ++count) {
    ConeDirections axes(count, &arena);
    for (std::size_t i = 0; i < count; ++i) axes.Add(AnyDirection(&random));
    axes.Finish();
    for (const Real chord2 : {Real(1e-12), Real(.1), Real(2), Real(4.001)}) {
      const Vector3 w = AnyDirection(&random);
      int within = 0;
      for (std::size_t i = 0; i < count; ++i) within += axes.IsWithin(i, w, chord2);
      EXPECT_EQ(axes.CountWithin(w, chord2), within) << count << " axes, " << chord2;
      EXPECT_EQ(axes.CountWithin(axes[count / 2], chord2) > 0, true);
    }
  }
}

TEST(ConeDirections, AreAsManyForEveryWidthOfVectors) {
  RandomStream random(2);
  std::vector<Real> x, y, z;
  for (int i = 0; i < 64; ++i) {
    const Vector3 w = AnyDirection(&random);
    x.push_back(w.x), y.push_back(w.y), z.push_back(w.z);
  }
  for (int i = 0; i < 1000; ++i) {
    const Vector3 w = AnyDirection(&random);
    // The limit is exactly the distance of one axis, so a different rounding would
    // change the count.
    const Real chord2 = Square(x[0] - w.x) + Square(y[0] - w.y) + Square(z[0] - w.z);
    const auto count = [&](const ConeLoops* loops) {
      return loops->count(x.data(), y.data(), z.data(), x.size(), w, chord2);
    };
    for (const ConeLoops* loops : ConeDirections::Loops())
      ASSERT_EQ(count(loops), count(ConeDirections::Loops().front()));
  }
}

TEST(ConeDirections, ChooseTheSameForEveryWidthOfVectors) {
  RandomStream random(3);
  constexpr std::size_t kCount = 70, kRoom = 80;
  std::vector<Real> rows(5 * kRoom, 0);
  Real* const x = rows.data();
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t row = 0; row < 5; ++row) x[row * kRoom + i] = random.Uniform();
  const DirectionRows from{x, x + kRoom, x + 2 * kRoom, x + 3 * kRoom, x + 4 * kRoom, kCount};
  for (const Real scale : {Real(0), Real(.5), Real(1), Real(3)}) {
    std::vector<Real> expected;  // x, y and z of each chosen direction in turn
    for (std::size_t i = 0; i < kCount; ++i)
      if (from.value[i] * scale < from.limit[i])
        expected.insert(expected.end(), {from.x[i], from.y[i], from.z[i]});
    for (const ConeLoops* loops : ConeDirections::Loops()) {
      std::vector<Real> to(3 * (kRoom + ConeDirections::kRun));
      Real *const tx = to.data(), *const ty = tx + kRoom + ConeDirections::kRun,
                  *const tz = ty + kRoom + ConeDirections::kRun;
      const std::size_t count = loops->choose(from, scale, tx, ty, tz);
      std::vector<Real> chosen;
      for (std::size_t i = 0; i < count; ++i) chosen.insert(chosen.end(), {tx[i], ty[i], tz[i]});
      EXPECT_EQ(chosen, expected) << scale;
    }
  }
}

}  // namespace
}  // namespace exphoton
