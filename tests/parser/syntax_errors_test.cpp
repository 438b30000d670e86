// SPDX-License-Identifier: BSD-2-Clause
// These tests check that reading goes on after an error of the syntax, and that errors which follow
// from an earlier one are not reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

// Returns the errors, one a line, as "line:column: text" without lists of what is available.
std::string ErrorsOf(const std::string& text) {
  const std::string place = "scene.pbrt:", mark = ": error: ";
  std::istringstream errors(BuildText(text).error);
  std::string lines;
  for (std::string line; std::getline(errors, line);) {
    const std::size_t at = line.find(mark);
    if (at == std::string::npos) continue;
    line.replace(at, mark.size(), ": ");
    line.resize(std::min(line.find("; available"), line.size()));
    lines += (line.starts_with(place) ? line.substr(place.size()) : line) + "\n";
  }
  return lines;
}

// InWorld has three lines before the text.
std::string ErrorsInWorld(const std::string& text) { return ErrorsOf(InWorld(text)); }

TEST(SyntaxErrors, LeaveTheRestOfTheFileToBeChecked) {
  const std::string errors = ErrorsOf(
      "Camra \"perspective\" \"float fov\" 45\n"
      "Film \"image\" \"integer xresolution\" \"4\"\n"
      "WorldBegin\n"
      "Materal \"matte\" \"color Kd\" [.5 .5 .5]\n"
      "Shape \"sphere\" \"float radius\" [1 true]\n"
      "Translate 1 2\n"
      "Scale 1 2 3 4\n"
      "Shape \"sphere\" \"flot radius\" 1\n"
      "Shape 5\n"
      "Rotate 1.2.3 0 0 1\n"
      "Shape \"none\"\n"
      "AttributeBegin 5\n"
      "AttributeEnd\n"
      "Shap \"sphere\" Materal \"matte\"\n"
      "WorldEnd\n");
  EXPECT_EQ(
      errors,
      "1:1: unknown directive Camra\n"
      "2:36: parameter \"xresolution\" of type integer takes numbers, found the string \"4\"\n"
      "4:1: unknown directive Materal\n"
      "5:34: parameter \"radius\" has true for a value\n"
      "7:1: Translate takes 3 numbers, found Scale after 2\n"
      "7:13: Scale takes 3 numbers, found one more\n"
      "8:16: unknown parameter type \"flot\"\n"
      "9:7: Shape takes a name in quotes, found a number\n"
      "10:8: \"1.2.3\" is not a number\n"
      "11:1: there is no shape \"none\"\n"
      "12:16: expected a directive, found a number\n"
      "14:1: unknown directive Shap\n"
      "14:15: unknown directive Materal\n");
}

TEST(SyntaxErrors, KeepTheirHintsAndTheStatusAndRenderNothing) {
  const BuiltScene built = BuildText(InWorld("Shape \"sphere\"\nMateral \"matte\"\nSphere"));
  EXPECT_EQ(built.status, 2);
  EXPECT_TRUE(built.setups.empty());
  EXPECT_NE(built.error.find("    hint: did you mean \"Material\"?\n"), std::string::npos);
}

TEST(SyntaxErrors, AreTwentyAtMost) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += "Materal \"matte\"\n";
  const std::string errors = ErrorsInWorld(text);
  EXPECT_NE(errors.find("23:1: unknown directive Materal\n"), std::string::npos);
  EXPECT_EQ(errors.find("24:1:"), std::string::npos);
  EXPECT_NE(errors.find("too many errors"), std::string::npos);
}

// A misspelt directive without parameters is handled as the one that was meant.
TEST(SyntaxErrors, OfBlocksAreReportedOnce) {
  EXPECT_EQ(ErrorsOf("WorlBegin\nShape \"sphere\"\nWorldEnd\n"),
            "1:1: unknown directive WorlBegin\n");
  EXPECT_EQ(ErrorsOf("WorldBegin\nShape \"sphere\"\nWorldEn\nWorldBegin\nWorldEnd\n"),
            "3:1: unknown directive WorldEn\n");
  EXPECT_EQ(ErrorsInWorld("AtributeBegin\nAttributeEnd"), "4:1: unknown directive AtributeBegin\n");
  EXPECT_EQ(ErrorsInWorld("ObjectBegin \"o\"\nObjectEn\nObjectInstance \"o\""),
            "5:1: unknown directive ObjectEn\n");
  EXPECT_EQ(ErrorsInWorld("ObjctBegin \"o\"\nObjectEnd\nObjectInstance \"o\""),
            "4:1: unknown directive ObjctBegin\n");
  EXPECT_EQ(ErrorsInWorld("ObjectBegin 5\nObjectEnd\nObjectInstance \"o\""),
            "4:13: ObjectBegin takes a name in quotes, found a number\n");
  EXPECT_EQ(ErrorsInWorld("ObjectBegin \"a\"\nObjectBegin \"b\"\nObjectEnd\nObjectEnd"),
            "5:1: ObjectBegin inside the object that begins at scene.pbrt:4\n");
  // An end closes the blocks in its own block.
  EXPECT_EQ(ErrorsInWorld("AttributeBegin\nTransformBegin\nObjectBegin \"o\"\nTransformEnd\n"
                          "ObjectInstance \"o\"\nAttributeEnd"),
            "7:1: TransformEnd does not match the ObjectBegin at scene.pbrt:6\n");
  EXPECT_EQ(ErrorsInWorld("AttributeBegin\nTransformEnd"),
            "5:1: TransformEnd does not match the AttributeBegin at scene.pbrt:4\n");
}

TEST(SyntaxErrors, OfDefinitionsLeaveTheirNamesDefined) {
  const std::string use = "Material \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"\n";
  EXPECT_EQ(ErrorsInWorld("Textur \"t\" \"color\" \"constant\"\n" + use),
            "4:1: unknown directive Textur\n");
  EXPECT_EQ(ErrorsInWorld("Texture \"t\" \"color\" 5\n" + use),
            "4:21: Texture takes a name, a type and a class in quotes, found a number\n");
  EXPECT_EQ(ErrorsInWorld("Texture \"t\"\n" + use),
            "5:1: Texture takes a name, a type and a class in quotes, found Material\n");
  EXPECT_EQ(ErrorsInWorld("Texture \"t\" \"color\" \"constant\" \"color value\" \"x\"\n" + use),
            "4:46: parameter \"value\" of type color takes numbers, found the string \"x\"\n");
  EXPECT_EQ(ErrorsInWorld("MakeNamedMaterial \"m\" \"strin type\" \"matte\"\nNamedMaterial \"m\""),
            "4:23: unknown parameter type \"strin\"\n");
  EXPECT_EQ(ErrorsInWorld("CoordinateSystm \"c\"\nCoordSysTransform \"c\""),
            "4:1: unknown directive CoordinateSystm\n");
}

// Text that cannot be read may define any name, so their absence is no error.
TEST(SyntaxErrors, OfUnreadableTextLeaveAllNamesDefined) {
  const std::string uses =
      "NamedMaterial \"m\"\nCoordSysTransform \"c\"\nObjectInstance \"o\"\nAttributeEnd\n"
      "Material \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"\n"
      "Shape \"sphere\" \"float radius\" -1";
  const std::string radius =
      "11:31: parameter \"radius\" of shape \"sphere\" must be above 0, not -1\n";
  EXPECT_EQ(ErrorsInWorld("frobnicate \"m\"\n" + uses),
            "4:1: unknown directive frobnicate\n" + radius);
  EXPECT_EQ(ErrorsInWorld("Include \"none.pbrt\"\n" + uses),
            "4:1: cannot read the included file \"none.pbrt\": no such file\n" + radius);
}

TEST(SyntaxErrors, InListsGoOnAfterThem) {
  EXPECT_EQ(ErrorsInWorld("Shape \"sphere\" \"float radius\" [Shape \"none\"] Shap \"sphere\""),
            "4:32: parameter \"radius\" has Shape for a value\n4:46: unknown directive Shap\n");
  // The next list ends the one without an end.
  EXPECT_EQ(
      ErrorsInWorld("Shape \"sphere\" \"float radius\" [1 Shape \"disk\" \"float radius\" [1]\n"
                    "Shap \"sphere\""),
      "4:34: parameter \"radius\" has Shape for a value\n5:1: unknown directive Shap\n");
  EXPECT_EQ(ErrorsInWorld("Shape \"sphere\" \"float radius\" [1 Shape \"disk\""),
            "4:34: parameter \"radius\" has Shape for a value\n");
}

TEST(SyntaxErrors, OfTokensEndTheReading) {
  EXPECT_EQ(ErrorsInWorld("Materal \"matte\"\nShape \"sphere\nShape \"none\""),
            "4:1: unknown directive Materal\n"
            "5:7: the string that begins here has no closing quote on its line\n");
}

}  // namespace
}  // namespace exphoton
