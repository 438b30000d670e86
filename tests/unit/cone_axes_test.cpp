// SPDX-License-Identifier: BSD-2-Clause
// Directions near another one: counted by every width of vectors as one by one.
#include "integrators/photon/cone_axes.h"

#include <gtest/gtest.h>

#include "core/math/random.h"
#include "core/math/sampling.h"

namespace exphoton {
namespace {

Vector3 AnyDirection(RandomStream* random) {
  return SampleUniformSphere({random->Uniform(), random->Uniform()});
}

TEST(ConeAxes, AreInTheOrderInWhichTheyWereAdded) {
  Arena arena;
  ConeAxes axes(3, &arena);
  axes.Add({0, 0, 1});
  axes.Add({1, 0, 0}, false);
  axes.Add({0, -1, 0});
  axes.Finish();
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[0], Vector3(0, 0, 1));
  EXPECT_EQ(axes[1], Vector3(0, -1, 0));
}

TEST(ConeAxes, NoneAreWithinAnythingWhereThereAreNone) {
  const ConeAxes none;
  EXPECT_EQ(none.size(), 0u);
  EXPECT_EQ(none.CountWithin({0, 0, 1}, 4), 0);
}

TEST(ConeAxes, AreCountedAsOneByOneUpToTheWholeSphere) {
  RandomStream random(1);
  Arena arena;
  for (std::size_t count = 1; count <= 70; ++count) {
    ConeAxes axes(count, &arena);
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

TEST(ConeAxes, AreAsManyForEveryWidthOfVectors) {
  RandomStream random(2);
  std::vector<Real> x, y, z;
  for (int i = 0; i < 64; ++i) {
    const Vector3 w = AnyDirection(&random);
    x.push_back(w.x), y.push_back(w.y), z.push_back(w.z);
  }
  for (int i = 0; i < 1000; ++i) {
    const Vector3 w = AnyDirection(&random);
    // Right at an axis' own distance, so that one rounding more or less would tell.
    const Real chord2 = Square(x[0] - w.x) + Square(y[0] - w.y) + Square(z[0] - w.z);
    const auto count = [&](ConeAxes::Counter counter) {
      return counter(x.data(), y.data(), z.data(), x.size(), w, chord2);
    };
    for (const ConeAxes::Counter counter : ConeAxes::Counters())
      ASSERT_EQ(count(counter), count(ConeAxes::Counters().front()));
  }
}

}  // namespace
}  // namespace exphoton
