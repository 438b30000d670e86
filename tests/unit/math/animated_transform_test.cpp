// SPDX-License-Identifier: BSD-2-Clause
// These tests check AnimatedTransform: its ends, the interpolation between them, boxes that contain
// all positions, and pairs of ends that cannot be interpolated.
#include <gtest/gtest.h>

#include "core/math/motion.h"
#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

Real Signed(RandomStream& random) { return 2 * random.Uniform() - 1; }
Vector3 AnyVector(RandomStream& random) {
  const Real x = Signed(random), y = Signed(random);
  return {x, y, Signed(random)};
}

AnimatedTransform Between(const Transform& start, const Transform& end, Real from = 0,
                          Real to = 1) {
  const char* problem = "";
  const auto animated = AnimatedTransform::Between(start, end, {from, to}, &problem);
  EXPECT_TRUE(animated) << problem;
  return animated.value_or(AnimatedTransform());
}
std::string ProblemOf(const Transform& start, const Transform& end, Interval times = {0, 1}) {
  const char* problem = "";
  return AnimatedTransform::Between(start, end, times, &problem) ? "" : problem;
}

double DistanceFromIdentity(const Matrix4& a) {
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      largest = std::max(largest, std::abs(a.m[i][j] - (i == j ? 1. : 0.)));
  return largest;
}

// Returns a random translation, a rotation by up to half a turn, and stretches and shears
// between 1/8 and 8.
Transform RandomTransform(RandomStream& random) {
  const auto factor = [&] { return std::exp2(3 * double(Signed(random))); };
  const Transform rotation = *Transform::Rotate(180 * double(Signed(random)), AnyVector(random));
  const double x = factor(), y = factor(), z = factor();
  const Transform turned = *Transform::Rotate(90 * double(random.Uniform()), AnyVector(random));
  return Transform::Translate(AnyVector(random) * 4) * rotation * *Transform::Scale(x, y, z) *
         turned;
}

TEST(Polar, PartsMultiplyToTheMatrix) {
  RandomStream random(1);
  for (int i = 0; i < 2000; ++i) {
    Matrix3 a;
    for (auto& row : a)
      for (double& v : row) v = double(Signed(random)) * std::exp2(20 * double(Signed(random)));
    const auto parts = PolarDecomposition(a);
    if (!parts) continue;
    const Matrix3 product = parts->rotation * parts->stretch;
    double size = 0, error = 0, skew = 0;
    for (std::size_t j = 0; j < 9; ++j) {
      size = std::max(size, std::abs(a[j / 3][j % 3]));
      error = std::max(error, std::abs(product[j / 3][j % 3] - a[j / 3][j % 3]));
      const Matrix3 square = parts->rotation * Transpose(parts->rotation);
      skew = std::max(skew, std::abs(square[j / 3][j % 3] - (j % 4 == 0 ? 1 : 0)));
    }
    EXPECT_LT(error, 1e-8 * size);
    EXPECT_LT(skew, 1e-12);
    EXPECT_NEAR(Determinant(parts->rotation), 1, 1e-12);
  }
}

TEST(Polar, TurnsComeBackFromTheirMatrices) {
  RandomStream random(2);
  for (int i = 0; i < 2000; ++i) {
    const double degrees = i % 4 == 0 ? 180 : i % 4 == 1 ? 1e-6 : 180 * double(random.Uniform());
    const Transform rotation = *Transform::Rotate(degrees, AnyVector(random));
    Matrix3 matrix;
    for (std::size_t j = 0; j < 9; ++j) matrix[j / 3][j % 3] = rotation.Matrix().m[j / 3][j % 3];
    const AxisAngle axisAngle = AxisAngleOf(matrix);
    EXPECT_NEAR(axisAngle.angle, degrees * (3.14159265358979323846 / 180), 1e-9);
    const Matrix3 again = RotationOf(axisAngle);
    for (std::size_t j = 0; j < 9; ++j)
      EXPECT_NEAR(again[j / 3][j % 3], matrix[j / 3][j % 3], 1e-9);
  }
}

TEST(AnimatedTransform, IsExactAtItsEndsAndStaysThere) {
  RandomStream random(3);
  for (int i = 0; i < 100; ++i) {
    const Transform start = RandomTransform(random), end = RandomTransform(random);
    const AnimatedTransform animated = Between(start, end, 2, 3);
    for (const Real time : {Real(-5), Real(1), Real(2)}) EXPECT_EQ(animated.At(time), start);
    for (const Real time : {Real(3), Real(4), Real(1e30)}) EXPECT_EQ(animated.At(time), end);
  }
}

TEST(AnimatedTransform, RunsWithoutJumpsAndInvertsItself) {
  RandomStream random(4);
  for (int i = 0; i < 200; ++i) {
    const AnimatedTransform animated =
        Between(RandomTransform(random), RandomTransform(random), 2, 3);
    const Point3 p = AnyVector(random);
    EXPECT_LT(Distance(animated.At(NextUp(Real(2))).ApplyPoint(p), animated.At(2).ApplyPoint(p)),
              1e-4);
    EXPECT_LT(Distance(animated.At(NextDown(Real(3))).ApplyPoint(p), animated.At(3).ApplyPoint(p)),
              1e-4);
    for (int k = 0; k <= 16; ++k) {
      const Transform at = animated.At(2 + Real(k) / 16);
      EXPECT_LT(DistanceFromIdentity(at.Matrix() * at.InverseMatrix()), 1e-11);
    }
  }
}

TEST(AnimatedTransform, TranslationsRunStraightWithTheSameLinearPart) {
  const Transform shape = *Transform::Rotate(33, {1, 2, 3}) * *Transform::Scale(-1, 2, 5);
  const AnimatedTransform animated =
      Between(Transform::Translate({1, 2, 3}) * shape, Transform::Translate({3, 2, -1}) * shape);
  const Matrix4 quarter = animated.At(Real(.25)).Matrix();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(quarter.m[i][j], shape.Matrix().m[i][j]);
  EXPECT_EQ(quarter.m[0][3], 1.5);
  EXPECT_EQ(quarter.m[1][3], 2);
  EXPECT_EQ(quarter.m[2][3], 2);
}

TEST(AnimatedTransform, RotationsTurnEvenlyAndTheShortestWay) {
  const AnimatedTransform turns = Between(Transform(), *Transform::Rotate(120, {0, 0, 1}));
  const Point3 p = turns.At(Real(.25)).ApplyPoint({1, 0, 0});
  EXPECT_NEAR(double(p.x), std::cos(3.14159265358979 / 6), 1e-6);
  EXPECT_NEAR(double(p.y), std::sin(3.14159265358979 / 6), 1e-6);
  const AnimatedTransform back = Between(Transform(), *Transform::Rotate(270, {0, 0, 1}));
  const Point3 q = back.At(Real(.5)).ApplyPoint({1, 0, 0});
  EXPECT_NEAR(double(q.y), -std::sqrt(.5), 1e-6);  // half of a quarter turn backwards
  EXPECT_FALSE(back.IsHalfTurn());
  EXPECT_TRUE(Between(Transform(), *Transform::Rotate(180, {1, 2, 3})).IsHalfTurn());
}

TEST(AnimatedTransform, AThousandTurnsAreNone) {
  const AnimatedTransform animated = Between(Transform(), *Transform::Rotate(360e3, {1, 2, 3}));
  for (int k = 0; k <= 8; ++k)
    EXPECT_LT(DistanceFromIdentity(animated.At(Real(k) / 8).Matrix()), 1e-9);
}

TEST(AnimatedTransform, AtRestIsTheSameAtAllTimes) {
  const Transform at = *Transform::Scale(1, 2, 3);
  for (const AnimatedTransform& animated : {AnimatedTransform(at), Between(at, at)}) {
    EXPECT_FALSE(animated.Moves());
    EXPECT_FALSE(animated.MovesWithin({-kInfinity, kInfinity}));
    EXPECT_EQ(animated.At(Real(.5)), at);
  }
}

TEST(AnimatedTransform, MovesOnlyBetweenItsTimes) {
  const AnimatedTransform animated = Between(Transform(), Transform::Translate({1, 0, 0}), 2, 3);
  EXPECT_TRUE(animated.MovesWithin({0, 10}));
  EXPECT_TRUE(animated.MovesWithin({Real(2.5), Real(2.6)}));
  EXPECT_FALSE(animated.MovesWithin({0, 2}));
  EXPECT_FALSE(animated.MovesWithin({3, 4}));
  EXPECT_FALSE(animated.MovesWithin({Real(2.5), Real(2.5)}));  // the shutter does not open
}

TEST(AnimatedTransform, RefusesWhatWouldBeFlatInBetween) {
  EXPECT_NE(ProblemOf(Transform(), *Transform::Scale(1, 1, -1)).find("mirrored"),
            std::string::npos);
  EXPECT_NE(ProblemOf(Transform(), *Transform::Scale(-1, -1, -1)).find("mirrored"),
            std::string::npos);
  // Scaling through zero on two axes is half a turn.
  EXPECT_EQ(ProblemOf(Transform(), *Transform::Scale(-1, -1, 1)), "");
  EXPECT_TRUE(Between(Transform(), *Transform::Scale(-1, -1, 1)).IsHalfTurn());
}

TEST(AnimatedTransform, RefusesWhatIsNoNumber) {
  Matrix4 matrix;
  for (std::size_t i = 0; i < 3; ++i) {
    matrix.m[i][i] = i == 1 ? 1 : std::nan("");
    matrix.m[0][3] = std::nan("");
    EXPECT_NE(ProblemOf(Transform(), Transform(matrix, matrix)).find("not finite"),
              std::string::npos);
    EXPECT_FALSE(Transform::FromMatrix(matrix));
  }
}

TEST(AnimatedTransform, RefusesProjectionsAndTimesOutOfOrder) {
  Matrix4 projective;
  projective.m[3] = {0, 0, 1, 1};
  EXPECT_NE(ProblemOf(Transform(), *Transform::FromMatrix(projective)).find("projective"),
            std::string::npos);
  const Transform end = Transform::Translate({1, 0, 0});
  for (const Interval times : {Interval{1, 0}, Interval{1, 1}, Interval{0, kInfinity},
                               Interval{0, std::numeric_limits<Real>::quiet_NaN()}})
    EXPECT_NE(ProblemOf(Transform(), end, times).find("times"), std::string::npos);
}

TEST(AnimatedTransform, StaysRegularBetweenExtremeScales) {
  const AnimatedTransform animated =
      Between(*Transform::Scale(1e-6, 1, 1e6) * *Transform::Rotate(50, {1, 1, 0}),
              *Transform::Scale(1e6, 1e-6, 1));
  for (int k = 0; k <= 16; ++k) {
    const Transform at = animated.At(Real(k) / 16);
    EXPECT_TRUE(std::isfinite(at.VolumeScale()));
    EXPECT_GT(at.VolumeScale(), 0);
  }
}

// Checks points of the box at many times. Most of the points lie on the box's faces and edges.
void ExpectHolds(const Bounds3& bounds, const Bounds3& box, const Motion& motion,
                 RandomStream& random) {
  for (int k = 0; k < 400; ++k) {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const Real u = random.Uniform();
      p[axis] = u < Real(.4)   ? box.min[axis]
                : u < Real(.8) ? box.max[axis]
                               : Lerp(random.Uniform(), box.min[axis], box.max[axis]);
    }
    const Point3 q = motion.At(random.Uniform()).ApplyPoint(p);
    ASSERT_TRUE(bounds.Contains(q)) << q.x << " " << q.y << " " << q.z;
  }
}

TEST(AnimatedTransform, BoxesHoldAllThatIsEverInThem) {
  RandomStream random(5);
  for (int i = 0; i < 300; ++i) {
    const AnimatedTransform animated = Between(RandomTransform(random), RandomTransform(random));
    const Bounds3 box(AnyVector(random) * 3, AnyVector(random) * 3);
    ExpectHolds(animated.ApplyBounds(box), box, Motion(animated), random);
    const Motion part =
        Motion(animated).PlacedBy(Between(RandomTransform(random), RandomTransform(random)));
    ExpectHolds(part.ApplyBounds(box), box, part, random);
  }
}

TEST(AnimatedTransform, BoxesOfHalfTurnsAreNotMuchTooLarge) {
  const AnimatedTransform animated = Between(Transform(), *Transform::Rotate(179, {0, 0, 1}));
  const Bounds3 bounds = animated.ApplyBounds({{-1, -1, -1}, {1, 1, 1}});
  EXPECT_NEAR(double(bounds.max.x), std::sqrt(2.), .01);
  EXPECT_NEAR(double(bounds.min.y), -std::sqrt(2.), .01);
  EXPECT_NEAR(double(bounds.max.z), 1, .01);
}

TEST(AnimatedTransform, BoxesScaleExactlyWithPowersOfTwo) {
  const Transform end = Transform::Translate({1, 2, 3}) * *Transform::Rotate(77, {3, 1, 2});
  const auto scaled = [&](double k) {
    const Transform grow = *Transform::Scale(k, k, k);
    const Bounds3 box = Between(Transform(), grow * end * grow.Inverted())
                            .ApplyBounds({Point3(-1, -2, -3) * Real(k), Point3(1, 1, 2) * Real(k)});
    return Bounds3(box.min / Real(k), box.max / Real(k));
  };
  for (const double k : {0x1p-20, 0x1p20}) {
    EXPECT_EQ(scaled(k).min, scaled(1).min);
    EXPECT_EQ(scaled(k).max, scaled(1).max);
  }
}

TEST(Motion, OfAPartIsThatOfTheWholeAfterItsOwn) {
  const AnimatedTransform own = Between(Transform(), Transform::Translate({1, 0, 0}));
  const AnimatedTransform whole = Between(Transform(), *Transform::Rotate(90, {0, 0, 1}));
  const Motion motion = Motion(own).PlacedBy(whole);
  const Point3 p = motion.At(1).ApplyPoint({0, 0, 0});
  EXPECT_NEAR(double(p.x), 0, 1e-6);
  EXPECT_NEAR(double(p.y), 1, 1e-6);
  const Point3 start = motion.ToStart(1).ApplyPoint(p);
  EXPECT_NEAR(double(Length(start)), 0, 1e-6);
}

}  // namespace
}  // namespace exphoton
