// SPDX-License-Identifier: BSD-2-Clause
// These tests compare transformations with independent computations in double precision.
#include "core/math/transform.h"

#include <gtest/gtest.h>

#include "core/geometry/vec3d.h"
#include "tests/support/geometry_scenes.h"

namespace exphoton {
namespace {

// A regular matrix with no entry that is 0, equal to another, or of a symmetric place.
Matrix4 RandomMatrix(RandomStream& random) {
  Matrix4 matrix;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      matrix.m[i][j] = double(Between(random, -2, 2)) + (i == j ? 3 : 0);
  return matrix;
}

void ExpectNear(const Vec3& a, const Vec3d& b, const char* what) {
  EXPECT_LT(Length(Vec3d(a) - b), 2e-6 * (1 + Length(b))) << what;
}

TEST(Transform, AppliesPointsVectorsAndNormals) {
  RandomStream random(1);
  for (int k = 0; k < 200; ++k) {
    const Matrix4 matrix = RandomMatrix(random);
    const auto transform = Transform::FromMatrix(matrix);
    ASSERT_TRUE(transform);
    const Vector3 v = RandomVector(random);
    const Vec3d d(v);
    const auto linear = [&](std::size_t i) {
      return matrix.m[i][0] * d.x + matrix.m[i][1] * d.y + matrix.m[i][2] * d.z;
    };
    const Vec3d image(linear(0), linear(1), linear(2));
    const Vec3d shift(matrix.m[0][3], matrix.m[1][3], matrix.m[2][3]);
    ExpectNear(transform->ApplyVector(v), image, "vector");
    ExpectNear(transform->ApplyPoint(v), image + shift, "point");
    // A normal stays perpendicular, with n' . (M w) = n . w for every w.
    const Normal3 n = RandomVector(random), normal = transform->ApplyNormal(n);
    for (int axis = 0; axis < 3; ++axis) {
      Vector3 w;
      w[axis] = 1;
      EXPECT_NEAR(double(Dot(normal, transform->ApplyVector(w))), double(n[axis]), 1e-4);
    }
    const Point3 back = transform->Inverted().ApplyPoint(transform->ApplyPoint(v));
    EXPECT_LT(Distance(back, v), Real(1e-4));
    const auto column = [&](std::size_t j) {
      return Vec3d(matrix.m[0][j], matrix.m[1][j], matrix.m[2][j]);
    };
    const double determinant = Dot(Cross(column(0), column(1)), column(2));
    EXPECT_NEAR(transform->VolumeScale() / std::abs(determinant), 1, 1e-9);
    EXPECT_EQ(transform->SwapsHandedness(), determinant < 0);
  }
}

TEST(Transform, OfAProductAppliesTheRightFactorFirst) {
  RandomStream random(2);
  const auto a = *Transform::FromMatrix(RandomMatrix(random));
  const auto b = *Transform::FromMatrix(RandomMatrix(random));
  const Point3 p(1, 2, 3);
  EXPECT_LT(Distance((a * b).ApplyPoint(p), a.ApplyPoint(b.ApplyPoint(p))), Real(1e-4));
  EXPECT_LT(Distance((a * b).Inverted().ApplyPoint(p),
                     b.Inverted().ApplyPoint(a.Inverted().ApplyPoint(p))),
            Real(1e-4));
}

// The images of all corners of a point's error box, with the rounding of the result.
TEST(Transform, BoundsTheErrorOfAPointTightly) {
  RandomStream random(3);
  for (int k = 0; k < 200; ++k) {
    const auto transform = *Transform::FromMatrix(RandomMatrix(random));
    const Point3 p = RandomVector(random) * 3;
    const Vector3 error = Abs(RandomVector(random)) * Real(k % 2 ? 1e-3 : 0);
    Vector3 bound;
    EXPECT_EQ(transform.ApplyPoint(p, error, &bound), transform.ApplyPoint(p));
    const auto& m = transform.Matrix().m;
    for (int i = 0; i < 3; ++i) {
      const auto& row = m[std::size_t(i)];
      const double spread = std::abs(row[0]) * double(error.x) +
                            std::abs(row[1]) * double(error.y) + std::abs(row[2]) * double(error.z);
      const double exact =
          row[0] * double(p.x) + row[1] * double(p.y) + row[2] * double(p.z) + row[3];
      const double off = std::abs(exact - double(transform.ApplyPoint(p)[i]));
      EXPECT_GE(double(bound[i]), spread + off);
      EXPECT_LE(double(bound[i]),
                1.0001 * (spread + double(kMachineEpsilon) * std::abs(exact)) + 1e-13);
    }
  }
}

TEST(Transform, RotatesRightHandedlyAboutAnyAxis) {
  RandomStream random(4);
  for (int k = 0; k < 100; ++k) {
    const Vector3 axis = RandomVector(random) * 5, v = RandomVector(random);
    const double degrees = double(Between(random, -400, 400)), angle = degrees * M_PI / 180;
    const Vec3d a = NormalizeOrZero(Vec3d(axis)), d(v);
    // Rodrigues' formula.
    const Vec3d expected = d * std::cos(angle) + Cross(a, d) * std::sin(angle) +
                           a * (Dot(a, d) * (1 - std::cos(angle)));
    const auto rotation = *Transform::Rotate(degrees, axis);
    ExpectNear(rotation.ApplyVector(v), expected, "rotated");
    ExpectNear(rotation.Inverted().ApplyVector(expected.ToReal()), d, "turned back");
  }
  EXPECT_FALSE(Transform::Rotate(10, {}));
  EXPECT_FALSE(Transform::Rotate(NAN, {1, 0, 0}));
  EXPECT_FALSE(Transform::Rotate(1, {kInfinity, 0, 0}));
}

TEST(Transform, ScalesAndTranslatesByAxis) {
  const auto scale = *Transform::Scale(2, -3, 4);
  EXPECT_EQ(scale.ApplyPoint({1, 1, 1}), Point3(2, -3, 4));
  EXPECT_EQ(scale.Inverted().ApplyPoint({2, -3, 4}), Point3(1, 1, 1));
  EXPECT_FALSE(Transform::Scale(0, 1, 1));
  EXPECT_FALSE(Transform::Scale(1, 1, double(kInfinity)));
  EXPECT_FALSE(Transform::Scale(1, 1e-310, 1));
  const Transform shift = Transform::Translate({1, -2, 3});
  EXPECT_EQ(shift.ApplyPoint({1, 1, 1}), Point3(2, -1, 4));
  EXPECT_EQ(shift.ApplyVector({1, 1, 1}), Vector3(1, 1, 1));
  EXPECT_EQ(shift.Inverted().ApplyPoint({2, -1, 4}), Point3(1, 1, 1));
}

TEST(Transform, LooksAlongZWithUpOnTheSideOfY) {
  RandomStream random(5);
  for (int k = 0; k < 50; ++k) {
    const Point3 eye = RandomVector(random) * 3, look = eye + RandomVector(random);
    const Vector3 up = RandomVector(random);
    const auto toCamera = Transform::LookAt(eye, look, up);
    ASSERT_TRUE(toCamera);
    EXPECT_LT(Length(toCamera->ApplyPoint(eye)), Real(1e-5));
    const Point3 seen = toCamera->ApplyPoint(look);
    EXPECT_LT(std::hypot(seen.x, seen.y), Real(1e-5));
    EXPECT_NEAR(double(seen.z), double(Distance(eye, look)), 1e-5);
    const Vector3 above = toCamera->ApplyVector(up);
    EXPECT_NEAR(double(above.x), 0, 1e-5);
    EXPECT_GT(above.y, 0);
    // x is to the right of the direction as in version 1: direction x up.
    const Vec3d right = NormalizeOrZero(Cross(Vec3d(look) - Vec3d(eye), Vec3d(up)));
    ExpectNear(toCamera->Inverted().ApplyVector({1, 0, 0}), right, "right");
  }
  EXPECT_FALSE(Transform::LookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}));
  EXPECT_FALSE(Transform::LookAt({}, {0, 1, 0}, {0, -2, 0}));
  EXPECT_FALSE(Transform::LookAt({}, {0, 1, 0}, {}));
}

TEST(Transform, DividesByW) {
  Matrix4 matrix;
  matrix.m[3][0] = .5, matrix.m[3][1] = .25, matrix.m[3][2] = -.125, matrix.m[3][3] = 2;
  const auto transform = *Transform::FromMatrix(matrix);
  EXPECT_EQ(transform.ApplyPoint({4, 8, 16}), Point3(1, 2, 4));
  EXPECT_EQ(transform.ApplyPoint({-4, 0, 0}), Point3(-4, 0, 0));  // w = 0: at infinity
}

TEST(Transform, InvertsAnyRegularMatrix) {
  RandomStream random(6);
  for (int k = 0; k < 100; ++k) {
    Matrix4 matrix;
    for (auto& row : matrix.m)
      for (double& value : row) value = double(Between(random, -1, 1));
    for (std::size_t j = 0; j < 4; ++j) matrix.m[std::size_t(k) % 4][j] *= 1e8;
    const auto inverse = Inverse(matrix);
    ASSERT_TRUE(inverse);
    const Matrix4 product = matrix * *inverse;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(product.m[i][j], i == j, 1e-4);
    EXPECT_EQ(Transpose(matrix).m[1][2], matrix.m[2][1]);
    for (std::size_t j = 0; j < 4; ++j) matrix.m[3][j] = matrix.m[0][j] + 2 * matrix.m[1][j];
    EXPECT_FALSE(Inverse(matrix));
  }
  Matrix4 zeroRow;
  zeroRow.m[2] = {0, 0, 0, 0};
  EXPECT_FALSE(Inverse(zeroRow));
  Matrix4 noNumber;
  noNumber.m[1][2] = NAN;
  EXPECT_FALSE(Inverse(noNumber));
}

// The error of an inverse translation grows with the translation.
TEST(Transform, InvertsTranslationsOfAnyLength) {
  for (const double scale : {1e-12, 1e-6, 1., 1e6, 1e12, 1e15}) {
    const auto length = Real(scale);
    const Point3 eye = Point3(3, 2, 1) * length, beside = Point3(3, 2, 2) * length;
    const auto toCamera = Transform::LookAt(eye, {}, {0, 0, 1});
    ASSERT_TRUE(toCamera) << scale;
    EXPECT_LT(double(Length(toCamera->ApplyPoint(eye))), 1e-5 * scale);
    EXPECT_NEAR(double(Length(toCamera->ApplyPoint(beside))), scale, 1e-5 * scale);
    EXPECT_NEAR(double(toCamera->ApplyPoint({}).z), std::sqrt(14.) * scale, 1e-5 * scale);

    Matrix4 matrix = toCamera->InverseMatrix();
    for (std::size_t j = 0; j < 3; ++j) matrix.m[0][j] *= 3;
    const auto transform = Transform::FromMatrix(matrix);
    ASSERT_TRUE(transform) << scale;
    EXPECT_LT(double(Length(transform->Inverted().ApplyPoint(eye))), 1e-5 * scale);
    for (std::size_t j = 0; j < 3; ++j) matrix.m[2][j] = matrix.m[0][j] - matrix.m[1][j];
    EXPECT_FALSE(Transform::FromMatrix(matrix)) << scale;
  }
}

TEST(Transform, KnowsSimilarities) {
  const auto turn = *Transform::Rotate(40, {1, 2, 3});
  EXPECT_NEAR(double(*(turn * *Transform::Scale(3, -3, 3)).SimilarityScale()), 3, 1e-5);
  EXPECT_TRUE((turn * *Transform::Scale(1, 1, 1.00005)).SimilarityScale());
  for (const auto& uneven : {*Transform::Scale(1, 1, 1.001), *Transform::Scale(1, 1.001, 1),
                             *Transform::Scale(1.001, 1, 1)})
    EXPECT_FALSE((turn * uneven).SimilarityScale());
  for (std::size_t i = 0; i < 3; ++i) {  // sheared, with columns of equal length
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) continue;
      Matrix4 matrix;
      matrix.m[i][j] = .01, matrix.m[j][j] = std::sqrt(1 - 1e-4);
      EXPECT_FALSE(Transform::FromMatrix(matrix)->SimilarityScale());
    }
  }
}

TEST(Transform, BoundsTheImageOfABox) {
  RandomStream random(7);
  for (int k = 0; k < 50; ++k) {
    const auto transform = *Transform::FromMatrix(RandomMatrix(random));
    const Bounds3 box(RandomVector(random), RandomVector(random));
    const Bounds3 image = transform.ApplyBounds(box);
    // The centre's image, plus and minus the absolute values of the rows times the half-diagonal.
    const Vec3d half = (Vec3d(box.max) - Vec3d(box.min)) * .5;
    const Vec3d center = (Vec3d(box.max) + Vec3d(box.min)) * .5;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& row = transform.Matrix().m[i];
      const double middle = row[0] * center.x + row[1] * center.y + row[2] * center.z + row[3];
      const double reach =
          std::abs(row[0]) * half.x + std::abs(row[1]) * half.y + std::abs(row[2]) * half.z;
      EXPECT_NEAR(double(image.min[int(i)]), middle - reach, 1e-5);
      EXPECT_NEAR(double(image.max[int(i)]), middle + reach, 1e-5);
      EXPECT_LE(double(image.min[int(i)]), middle - reach);
      EXPECT_GE(double(image.max[int(i)]), middle + reach);
    }
  }
  EXPECT_TRUE(Transform::Translate({1, 2, 3}).ApplyBounds({}).IsEmpty());
}

}  // namespace
}  // namespace exphoton
