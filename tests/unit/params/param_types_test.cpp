// SPDX-License-Identifier: BSD-2-Clause
// These tests check which written types each type of parameter accepts. The accepted types are
// listed here, and all other types must be refused.
#include <gtest/gtest.h>

#include <set>

#include "core/params/param_reader.h"

namespace exphoton {
namespace {

using Types = std::set<std::string>;

const std::string kWritten[] = {"integer", "float",  "bool",   "string",   "point",
                                "point2",  "point3", "vector", "vector3",  "normal",
                                "normal3", "color",  "rgb",    "spectrum", "blackbody",
                                "texture", "xyz",    "vector2"};

struct Case {
  ParamType type;
  Types accepted;
};

std::vector<Case> Cases() {
  const Types colors{"color", "rgb", "xyz", "blackbody", "spectrum"};
  Types colorsAndTextures = colors;
  colorsAndTextures.insert("texture");
  return {{ParamType::Integer, {"integer", "float"}},
          {ParamType::IntegerList, {"integer", "float"}},
          {ParamType::Float, {"float", "integer"}},
          {ParamType::FloatList, {"float", "integer"}},
          {ParamType::Bool, {"bool"}},
          {ParamType::String, {"string"}},
          {ParamType::Choice, {"string"}},
          {ParamType::File, {"string"}},
          {ParamType::Color, colors},
          {ParamType::Point, {"point", "point3"}},
          {ParamType::PointList, {"point", "point3"}},
          {ParamType::Vector, {"vector", "vector3"}},
          {ParamType::VectorList, {"vector", "vector3"}},
          {ParamType::Normal, {"normal", "normal3"}},
          {ParamType::NormalList, {"normal", "normal3"}},
          {ParamType::FloatTexture, {"float", "integer", "texture"}},
          {ParamType::ColorTexture, colorsAndTextures},
          {ParamType::Point2List, {"float", "integer", "point2"}}};
}

class ParamTypes : public testing::TestWithParam<Case> {};

TEST_P(ParamTypes, TakeTheirWrittenTypesAndNoOther) {
  const auto [type, accepted] = GetParam();
  for (const std::string& written : kWritten) {
    ParamDecl decl;
    decl.name = "size";
    decl.type = type;
    decl.choices = {"a"};
    ParsedParam param;
    param.type = written;
    param.name = "size";
    std::string complaint;
    try {
      BindContext context;
      context.what = "shape \"x\"";
      ParamReader(decl, param, context).Read();
    } catch (const Error& error) {
      complaint = error.what();
    }
    // Without values a parameter fails in any case. If its type is accepted, it fails for
    // another reason.
    EXPECT_EQ(complaint.find("must be of type") == std::string::npos, accepted.contains(written))
        << written << ": " << complaint;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ParamTypes, testing::ValuesIn(Cases()));

}  // namespace
}  // namespace exphoton
