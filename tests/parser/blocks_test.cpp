// SPDX-License-Identifier: BSD-2-Clause
// These tests check which parts of the graphics state a block restores at its end, one part at a
// time. They also check matrices that are given as sixteen numbers.
#include <gtest/gtest.h>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

// Returns the surface that a ray from (x, 0, -50) along +z hits first.
std::optional<SurfaceInteraction> SeenAt(const BuiltScene& built, Real x) {
  if (!built.error.empty()) {
    ADD_FAILURE() << built.error;
    return std::nullopt;
  }
  RayDifferential ray;
  ray.o = {x, 0, -50};
  ray.d = {0, 0, 1};
  auto surface = built.setups[0]->scene->Intersect(ray);
  if (!surface) ADD_FAILURE() << "nothing at x = " << x;
  return surface;
}

void ExpectBounds(const BuiltScene& built, const Point3& min, const Point3& max) {
  ASSERT_EQ(built.error, "");
  const Bounds3 bounds = built.setups[0]->scene->WorldBounds();
  EXPECT_LT(Distance(bounds.min, min), 1e-3) << bounds.min.x << " " << bounds.min.y;
  EXPECT_LT(Distance(bounds.max, max), 1e-3) << bounds.max.x << " " << bounds.max.y;
}

// The scene has one disk before a block, one disk within a block that changes every attribute, and
// one disk after the block.
const std::string kDisks =
    "Texture \"paint\" \"color\" \"constant\" \"color value\" [.5 .5 .5]\n"
    "MakeNamedMaterial \"coat\" \"string type\" \"matte\"\n"
    "Material \"matte\" Translate -10 0 0 Shape \"disk\"\nTranslate 10 0 0\nAttributeBegin\n"
    "ReverseOrientation Material \"mirror\" AreaLightSource \"area\" \"color L\" [1 1 1]\n"
    "Texture \"paint\" \"color\" \"constant\" \"color value\" [0 0 0]\n"
    "MakeNamedMaterial \"coat\" \"string type\" \"mirror\"\n"
    "ActiveTransform EndTime Translate 0 0 0 ActiveTransform All\n"
    "Shape \"disk\"\nAttributeEnd\nTranslate 10 0 0 Shape \"disk\"\n";

TEST(AttributeEnd, BringsBackOrientationMaterialLightAndPlace) {
  const BuiltScene built = BuildText(InWorld(kDisks));
  const auto before = SeenAt(built, -10), within = SeenAt(built, 0), after = SeenAt(built, 10);
  ASSERT_TRUE(before && within && after);
  EXPECT_EQ(within->ng, -before->ng);
  EXPECT_EQ(after->ng, before->ng);
  EXPECT_NE(within->material, before->material);
  EXPECT_EQ(after->material, before->material);
  EXPECT_EQ(before->areaLight, nullptr);
  EXPECT_NE(within->areaLight, nullptr);
  EXPECT_EQ(after->areaLight, nullptr);
}

TEST(AttributeEnd, BringsBackTexturesAndNamedMaterials) {
  const BuiltScene built =
      BuildText(InWorld(
          kDisks + "Translate 10 0 0 Material \"matte\" \"texture Kd\" \"paint\" Shape \"disk\"\n"
                   "Translate 10 0 0 NamedMaterial \"coat\" Shape \"disk\"\n"));
  const auto painted = SeenAt(built, 20), coated = SeenAt(built, 30);
  ASSERT_TRUE(painted && coated);
  EXPECT_EQ(painted->material->PossibleLobes(), LobeSet::DiffuseReflection);
  EXPECT_EQ(coated->material->PossibleLobes(), LobeSet::DiffuseReflection);
}

TEST(NamedMaterial, HasTheTexturesOfThePlaceWhereItWasMade) {
  const BuiltScene built = BuildText(
      InWorld("Texture \"paint\" \"color\" \"constant\" \"color value\" [.5 .5 .5]\n"
              "MakeNamedMaterial \"coat\" \"string type\" \"matte\" \"texture Kd\" \"paint\"\n"
              "Texture \"paint\" \"color\" \"constant\" \"color value\" [0 0 0]\n"
              "NamedMaterial \"coat\" Shape \"disk\""));
  const auto coated = SeenAt(built, 0);
  ASSERT_TRUE(coated);
  EXPECT_EQ(coated->material->PossibleLobes(), LobeSet::DiffuseReflection);
}

TEST(NamedMaterial, OfAMixHasTheTexturesOfThePlaceWhereItWasMade) {
  const BuiltScene built = BuildText(
      InWorld("Texture \"paint\" \"color\" \"constant\" \"color value\" [.5 .5 .5]\n"
              "MakeNamedMaterial \"coat\" \"string type\" \"matte\" \"texture Kd\" \"paint\"\n"
              "MakeNamedMaterial \"mirror\" \"string type\" \"mirror\"\n"
              "Texture \"paint\" \"color\" \"constant\" \"color value\" [0 0 0]\n"
              "MakeNamedMaterial \"blend\" \"string type\" \"mix\" \"texture amount\" \"paint\" "
              "\"string namedmaterial1\" \"mirror\" \"string namedmaterial2\" \"coat\"\n"
              "Texture \"paint\" \"color\" \"constant\" \"color value\" [1 1 1]\n"
              "NamedMaterial \"blend\" Shape \"disk\""));
  const auto coated = SeenAt(built, 0);
  ASSERT_TRUE(coated);
  EXPECT_EQ(coated->material->PossibleLobes(), LobeSet::DiffuseReflection);
}

// A shape can give parameters to its material. They name textures that are known at the shape.
TEST(NamedMaterial, TakesTexturesOfAShape) {
  const BuiltScene built = BuildText(
      InWorld("Texture \"paint\" \"color\" \"constant\" \"color value\" [0 0 0]\n"
              "MakeNamedMaterial \"coat\" \"string type\" \"matte\" \"texture Kd\" \"paint\"\n"
              "Texture \"paint\" \"color\" \"constant\" \"color value\" [.5 .5 .5]\n"
              "Texture \"later\" \"color\" \"constant\" \"color value\" [.5 .5 .5]\n"
              "NamedMaterial \"coat\" Shape \"disk\" \"texture Kd\" \"later\"\n"
              "Translate 10 0 0 Shape \"disk\" \"texture Kd\" \"paint\"\n"
              "Translate 10 0 0 Shape \"disk\"\n"));
  const auto later = SeenAt(built, 0), again = SeenAt(built, 10), plain = SeenAt(built, 20);
  ASSERT_TRUE(later && again && plain);
  EXPECT_EQ(later->material->PossibleLobes(), LobeSet::DiffuseReflection);
  EXPECT_EQ(again->material->PossibleLobes(), LobeSet::DiffuseReflection);
  EXPECT_FALSE(Any(plain->material->PossibleLobes()));
}

TEST(NamedMaterial, NamesTheNearestTextureForOneThatIsUnknown) {
  const std::string textures =
      "Texture \"a\" \"color\" \"constant\"\nTexture \"bricks\" \"color\" \"constant\"\n";
  const auto errorOf = [&](const std::string& parameters) {
    return BuildText(InWorld(textures + "MakeNamedMaterial \"m\" \"string type\" \"matte\" " +
                             parameters + "\nTexture \"brick\" \"color\" \"constant\"\n" +
                             "NamedMaterial \"m\" Shape \"disk\""))
        .error;
  };
  const std::string unknown = errorOf("\"texture Kd\" \"brick\"");
  EXPECT_NE(unknown.find("names a texture that is not defined: \"brick\""), std::string::npos)
      << unknown;
  EXPECT_NE(unknown.find("did you mean \"bricks\"?"), std::string::npos) << unknown;
  const std::string wrongKind = errorOf("\"texture sigma\" \"a\"");
  EXPECT_NE(wrongKind.find("\"a\" is a color texture"), std::string::npos) << wrongKind;
}

TEST(AttributeEnd, BringsBackWhichTimesDirectivesChange) {
  const BuiltScene built =
      BuildText(InWorld("AttributeBegin ActiveTransform EndTime AttributeEnd Translate 3 0 0 "
                        "Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_FALSE(built.setups[0]->scene->Primitives().MovesWithin({-kInfinity, kInfinity}));
  ExpectBounds(built, {2, -1, -1}, {4, 1, 1});
}

// The block begins while directives change the end only, and it ends so.
TEST(TransformEnd, BringsBackWhichTimesDirectivesChange) {
  const BuiltScene built =
      BuildText(InWorld("ActiveTransform EndTime TransformBegin ActiveTransform StartTime "
                        "TransformEnd Translate 3 0 0 Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_TRUE(built.setups[0]->scene->Primitives().MovesWithin({-kInfinity, kInfinity}));
  ExpectBounds(built, {-1, -1, -1}, {4, 1, 1});
}

TEST(TransformEnd, LeavesOrientationAndMaterialAsTheBlockSetThem) {
  const BuiltScene built = BuildText(
      InWorld("Shape \"disk\" Translate 10 0 0 TransformBegin Translate 99 0 0 ReverseOrientation "
              "Material \"mirror\" TransformEnd Shape \"disk\""));
  const auto before = SeenAt(built, 0), after = SeenAt(built, 10);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->ng, -before->ng);
  EXPECT_NE(after->material, before->material);
}

TEST(ReverseOrientation, GivenTwiceChangesNothing) {
  const BuiltScene built =
      BuildText(InWorld("Shape \"disk\" ReverseOrientation ReverseOrientation Translate 10 0 0 "
                        "Shape \"disk\""));
  const auto before = SeenAt(built, 0), after = SeenAt(built, 10);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->ng, before->ng);
}

TEST(ObjectEnd, BringsBackWhatAttributeEndDoes) {
  const BuiltScene built = BuildText(
      InWorld("Shape \"disk\" ObjectBegin \"o\" Translate 0 5 0 ReverseOrientation "
              "Material \"mirror\" Shape \"disk\" ObjectEnd Translate 10 0 0 Shape \"disk\""));
  const auto before = SeenAt(built, 0), after = SeenAt(built, 10);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->ng, before->ng);
  EXPECT_EQ(after->material, before->material);
}

TEST(ConcatTransform, MultipliesTheCurrentMatrixFromTheRight) {
  ExpectBounds(
      BuildText(InWorld("Translate 1 2 3 ConcatTransform [2 0 0 0  0 2 0 0  0 0 2 0  5 0 0 1]\n"
                        "Shape \"sphere\"")),
      {4, 0, 1}, {8, 4, 5});
  // The product is not commutative: the scale acts on the second translation.
  ExpectBounds(
      BuildText(InWorld("ConcatTransform [2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1] "
                        "ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 0  5 0 0 1] Shape \"sphere\"")),
      {8, -2, -2}, {12, 2, 2});
}

TEST(TransformDirective, ReplacesTheMatrixAndReadsItColumnByColumn) {
  ExpectBounds(BuildText(InWorld("Translate 1 2 3 Transform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1] "
                                 "Shape \"sphere\"")),
               {4, 5, 6}, {6, 7, 8});
  // The matrix is the shear x += 2 y. It moves the triangle's corner (0, 1, 0) to (2, 1, 0).
  ExpectBounds(
      BuildText(InWorld("Transform [1 0 0 0  2 1 0 0  0 0 1 0  0 0 0 1] Shape \"trianglemesh\" "
                        "\"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0]")),
      {0, 0, 0}, {2, 1, 0});
}

TEST(CoordSysTransform, GoesBackToTheMatrixOfTheName) {
  ExpectBounds(BuildText(InWorld("Translate 1 2 3 CoordinateSystem \"here\" Scale 7 7 7 "
                                 "CoordSysTransform \"here\" Shape \"sphere\"")),
               {0, 1, 2}, {2, 3, 4});
}

}  // namespace
}  // namespace exphoton
