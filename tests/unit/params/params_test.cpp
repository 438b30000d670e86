// SPDX-License-Identifier: BSD-2-Clause
// These tests check the binding of parameters: the values, and the exact wording of every message.
#include <gtest/gtest.h>

#include "core/base/log.h"
#include "core/params/param_table.h"
#include "core/parser/syntax/parser.h"

namespace exphoton {
namespace {

enum class Fruit { Apple, Pear };

struct Settings {
  int count = 5;
  std::int64_t many = 7;
  Real size = Real(.1);
  bool isOn = true;
  std::string text = "a";
  std::string file;
  Fruit fruit = Fruit::Pear;
  Spectrum light{1, 1, 1};
  Spectrum tint;
  Point3 place;
  Vector3 way{0, 0, 1};
  Normal3 normal;
  std::optional<Real> angle;
  std::vector<int> indices;
  std::vector<Real> numbers;
  std::vector<Point3> points;
  std::vector<Point2> uvs;
  TexturePtr<Real> bump = std::make_shared<UniformTexture<Real>>(Real(.5));
  TexturePtr<Spectrum> paint = std::make_shared<UniformTexture<Spectrum>>(Spectrum(1));

  void Validate() const {
    if (count > 900) throw ParamError{"count", "must not exceed 900", "choose 900"};
  }
};

const ParamTable<Settings>& Table() {
  using S = Settings;
  static const ParamTable<S> table{
      Param("count", &S::count, "a number").Range(0, 1000),
      Param("many", &S::many, "a large number"),
      Param("size", &S::size, "a size").Above(0).Unit("m"),
      Param("on", &S::isOn, "a switch"),
      Param("text", &S::text, "a text"),
      Param("file", &S::file, "a file").As(ParamType::File),
      Param("fruit", &S::fruit, "a choice").OneOf({{"apple", Fruit::Apple}, {"pear", Fruit::Pear}}),
      Param("light", &S::light, "a color").AtLeast(0),
      Param("tint", &S::tint, "another color"),
      Param("place", &S::place, "a point"),
      Param("way", &S::way, "a vector").As(ParamType::Vector),
      Param("normal", &S::normal, "a normal").As(ParamType::Normal),
      Param("angle", &S::angle, "an angle").Above(0).AtMost(90),
      Param("indices", &S::indices, "integers").AtLeast(0),
      Param("numbers", &S::numbers, "floats"),
      Param("points", &S::points, "points"),
      Param("uv", &S::uvs, "coordinates"),
      Param("bump", &S::bump, "a float texture"),
      Param("paint", &S::paint, "a color texture"),
  };
  return table;
}

class OneDirective final : public DirectiveHandler {
 public:
  void Handle(Directive directive) override { params = std::move(directive.params); }
  void Finish(const SourceLocation&) override {}
  ParamSet params;
};

class Textures final : public TextureLookup {
 public:
  TexturePtr<Real> Float(const std::string& name) const override {
    return name == "grain" ? std::make_shared<UniformTexture<Real>>(Real(.25)) : nullptr;
  }
  TexturePtr<Spectrum> Color(const std::string& name) const override {
    return name == "wood" ? std::make_shared<UniformTexture<Spectrum>>(Spectrum(.25)) : nullptr;
  }
  std::vector<std::string> Names() const override { return {"grain", "wood"}; }
};

class Params : public ::testing::Test {
 protected:
  ParamSet Parse(const std::string& text) {
    MemorySource source({{"dir/a.pbrt", "Shape \"x\" " + text + '\n'}});
    OneDirective handler;
    ParseScene(source, "dir/a.pbrt", handler, log_);
    return handler.params;
  }
  BindContext Context() {
    BindContext context;
    context.what = "shape \"x\"";
    context.log = &log_;
    context.textures = &textures_;
    return context;
  }
  Settings Bind(const std::string& text) { return Table().Bind(Parse(text), Context()); }
  // Returns the message of the error that binding throws, as a user reads it.
  std::string Fails(const std::string& text, bool isStrict = false) {
    try {
      BindContext context = Context();
      context.isStrict = isStrict;
      Table().Bind(Parse(text), context);
    } catch (const Error& error) {
      EXPECT_EQ(error.Status(), ExitStatus::Scene);
      return FormatDiagnostic("error", error.what(), error.Where(), error.Hint());
    }
    return "no error";
  }
  // Returns only the first line of the message, without the location.
  std::string Complaint(const std::string& text) {
    const std::string all = Fails(text);
    const std::string mark = ": error: parameter ";
    const std::size_t at = all.find(mark);
    if (at == std::string::npos) return all;
    return all.substr(at + mark.size(), all.find('\n') - at - mark.size());
  }
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  Textures textures_;
};

TEST_F(Params, AbsentOnesKeepTheirDefaults) {
  const Settings settings = Bind("");
  EXPECT_EQ(settings.count, 5);
  EXPECT_EQ(settings.fruit, Fruit::Pear);
  EXPECT_FALSE(settings.angle);
  EXPECT_TRUE(log_.Messages().empty());
}

TEST_F(Params, EveryTypeIsRead) {
  const Settings s = Bind(
      "\"integer count\" 3 \"integer many\" [5000000000] \"float size\" 2.5 \"bool on\" \"false\" "
      "\"string text\" \"hello\" \"string file\" \"b.exr\" \"string fruit\" \"apple\" "
      "\"color light\" [1 2 3] \"point place\" [1 2 3] \"vector way\" [4 5 6] "
      "\"normal normal\" [7 8 9] \"float angle\" 90 \"integer indices\" [0 1 2] "
      "\"float numbers\" [1 2] \"point points\" [0 0 0 1 1 1] \"float uv\" [0 1 1 0]");
  EXPECT_EQ(s.count, 3);
  EXPECT_EQ(s.many, 5000000000);
  EXPECT_EQ(s.size, Real(2.5));
  EXPECT_FALSE(s.isOn);
  EXPECT_EQ(s.text, "hello");
  EXPECT_EQ(s.file, "dir/b.exr");
  EXPECT_EQ(s.fruit, Fruit::Apple);
  EXPECT_EQ(s.light, Spectrum(1, 2, 3));
  EXPECT_EQ(s.place, Vec3(1, 2, 3));
  EXPECT_EQ(s.way, Vec3(4, 5, 6));
  EXPECT_EQ(s.normal, Vec3(7, 8, 9));
  EXPECT_EQ(s.angle, Real(90));
  EXPECT_EQ(s.indices, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(s.numbers, (std::vector<Real>{1, 2}));
  EXPECT_EQ(s.points, (std::vector<Point3>{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(s.uvs, (std::vector<Point2>{{0, 1}, {1, 0}}));
}

TEST_F(Params, SpellingsOfVersion2AreRead) {
  const Settings s = Bind(
      "\"float count\" 3.0 \"integer size\" 2 \"rgb light\" [1 2 3] \"point3 place\" [1 2 3] "
      "\"vector3 way\" [4 5 6] \"normal3 normal\" [7 8 9] \"point2 uv\" [0 1]");
  EXPECT_EQ(s.count, 3);
  EXPECT_EQ(s.size, 2);
  EXPECT_EQ(s.light, Spectrum(1, 2, 3));
  EXPECT_EQ(s.way, Vec3(4, 5, 6));
  EXPECT_EQ(s.uvs, (std::vector<Point2>{{0, 1}}));
}

TEST_F(Params, AbsolutePathsStay) {
  EXPECT_EQ(Bind("\"string file\" \"/b.exr\"").file, "/b.exr");
  EXPECT_EQ(Bind("\"string file\" \"\"").file, "");
}

TEST_F(Params, TexturesAreValuesOrNames) {
  const SurfaceInteraction si;
  EXPECT_EQ(Bind("\"float bump\" 2").bump->Evaluate(si), 2);
  EXPECT_EQ(Bind("\"texture bump\" \"grain\"").bump->Evaluate(si), Real(.25));
  EXPECT_EQ(Bind("\"color paint\" [1 2 3]").paint->Evaluate(si), Spectrum(1, 2, 3));
  EXPECT_EQ(Bind("\"texture paint\" \"wood\"").paint->Evaluate(si), Spectrum(.25));
}

TEST_F(Params, AnErrorShowsTheLineTheValueAndAHint) {
  EXPECT_EQ(Fails("\"string fruit\" \"aple\""),
            "dir/a.pbrt:1:26: error: parameter \"fruit\" of shape \"x\" must be \"apple\" or "
            "\"pear\", not \"aple\"\n"
            "    Shape \"x\" \"string fruit\" \"aple\"\n"
            "                             ^\n"
            "    hint: did you mean \"apple\"?\n");
  EXPECT_EQ(Fails("\"color light\" [1 -2 3]"),
            "dir/a.pbrt:1:28: error: parameter \"light\" of shape \"x\" must be at least 0, not "
            "-2\n"
            "    Shape \"x\" \"color light\" [1 -2 3]\n"
            "                               ^\n");
  EXPECT_EQ(Fails("\"string size\" \"big\"", true),
            "dir/a.pbrt:1:11: error: parameter \"size\" of shape \"x\" must be of type \"float\" "
            "or \"integer\", not \"string\"\n"
            "    Shape \"x\" \"string size\" \"big\"\n"
            "              ^\n"
            "    hint: write \"float size\"\n");
}

TEST_F(Params, WrongCountsTypesAndRangesAreErrors) {
  EXPECT_EQ(Complaint("\"float size\" [1 2 3]"),
            "\"size\" of shape \"x\" needs exactly one value, not 3");
  EXPECT_EQ(Complaint("\"float size\" []"),
            "\"size\" of shape \"x\" needs exactly one value, not 0");
  EXPECT_EQ(Complaint("\"color light\" 1"), "\"light\" of shape \"x\" needs 3 values, not 1");
  EXPECT_EQ(Complaint("\"point points\" [1 2 3 4]"),
            "\"points\" of shape \"x\" needs a multiple of 3 numbers, not 4");
  EXPECT_EQ(Complaint("\"float count\" 2.5"),
            "\"count\" of shape \"x\" must be an integer, not 2.5");
  EXPECT_EQ(Complaint("\"integer count\" -1"),
            "\"count\" of shape \"x\" must be between 0 and 1000, not -1");
  EXPECT_EQ(Complaint("\"float size\" 0"), "\"size\" of shape \"x\" must be above 0, not 0");
  EXPECT_EQ(Complaint("\"float angle\" 91"),
            "\"angle\" of shape \"x\" must be above 0 and at most 90, not 91");
  EXPECT_EQ(Complaint("\"integer indices\" [0 3000000000]"),
            "\"indices\" of shape \"x\" must be between -2147483648 and 2147483647, not "
            "3000000000");
  EXPECT_EQ(Complaint("\"integer indices\" [0 -3]"),
            "\"indices\" of shape \"x\" must be at least 0, not -3");
  EXPECT_EQ(Complaint("\"bool on\" \"maybe\""),
            "\"on\" of shape \"x\" must be \"true\" or \"false\", not \"maybe\"");
}

TEST_F(Params, NumbersThatAreNotFiniteAreErrors) {
  const auto numbers = [&](const std::string& name, const std::string& type, double value) {
    ParsedParam param;
    param.name = name;
    param.type = type;
    param.numbers = {value};
    ParamSet params;
    params.Add(param);
    try {
      Table().Bind(params, Context());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(numbers("size", "float", INFINITY),
            "parameter \"size\" of shape \"x\" must be a finite number, not infinity");
  EXPECT_EQ(numbers("numbers", "float", NAN),
            "parameter \"numbers\" of shape \"x\" must be a finite number, not nan");
  EXPECT_EQ(numbers("count", "integer", NAN),
            "parameter \"count\" of shape \"x\" must be an integer, not nan");
  EXPECT_EQ(numbers("many", "integer", 1e300),
            "parameter \"many\" of shape \"x\" must be between -9007199254740992 and "
            "9007199254740992, not 1e+300");
#ifndef EXPHOTON_DOUBLE
  EXPECT_NE(numbers("size", "float", 1e300), "");  // overflows float
  EXPECT_NE(numbers("size", "float", 1e-60), "");  // underflows to 0 as a float
#endif
}

TEST_F(Params, TexturesThatCannotBeUsedAreErrors) {
  EXPECT_EQ(Fails("\"texture paint\" \"wod\""),
            "dir/a.pbrt:1:27: error: parameter \"paint\" of shape \"x\" names a texture that is "
            "not defined: \"wod\"\n"
            "    Shape \"x\" \"texture paint\" \"wod\"\n"
            "                              ^\n"
            "    hint: did you mean \"wood\"?\n");
  EXPECT_EQ(Complaint("\"texture paint\" \"grain\""),
            "\"paint\" of shape \"x\" needs a color texture, and \"grain\" is a float texture");
  EXPECT_EQ(Complaint("\"texture bump\" \"wood\""),
            "\"bump\" of shape \"x\" needs a float texture, and \"wood\" is a color texture");
}

TEST_F(Params, RulesOfThePluginGetThePlaceOfTheirParameter) {
  EXPECT_EQ(Fails("\"integer count\" 950"),
            "dir/a.pbrt:1:11: error: parameter \"count\" of shape \"x\" must not exceed 900\n"
            "    Shape \"x\" \"integer count\" 950\n"
            "              ^\n"
            "    hint: choose 900\n");
}

TEST_F(Params, AnUnknownNameIsAWarningAndAnErrorUnderStrict) {
  Bind("\"integer cuont\" 3");
  ASSERT_EQ(log_.Messages().size(), 1u);
  EXPECT_EQ(log_.Messages()[0],
            "dir/a.pbrt:1:11: warning: unknown parameter \"cuont\" of shape \"x\"\n"
            "    Shape \"x\" \"integer cuont\" 3\n"
            "              ^\n"
            "    hint: did you mean \"count\"?\n");
  EXPECT_EQ(Fails("\"integer cuont\" 3", true),
            "dir/a.pbrt:1:11: error: unknown parameter \"cuont\" of shape \"x\"\n"
            "    Shape \"x\" \"integer cuont\" 3\n"
            "              ^\n"
            "    hint: did you mean \"count\"?\n");
}

TEST_F(Params, ANameOfASiblingIsANoticeEvenUnderStrict) {
  BindContext context = Context();
  context.isStrict = true;
  context.siblingNames = [] { return std::vector<std::string>{"photons"}; };
  Table().Bind(Parse("\"integer photons\" 3"), context);
  ASSERT_EQ(log_.Messages().size(), 1u);
  EXPECT_EQ(log_.WarningCount(), 0);
  EXPECT_NE(log_.Messages()[0].find("note: parameter \"photons\" does not apply to shape \"x\"; "
                                    "another plugin of this kind has it\n"),
            std::string::npos);
}

TEST_F(Params, SiblingsAreAskedOnlyForUnknownNames) {
  BindContext context = Context();
  bool isAsked = false;
  context.siblingNames = [&] { return isAsked = true, std::vector<std::string>(); };
  Table().Bind(Parse("\"integer count\" 3"), context);
  EXPECT_FALSE(isAsked);
}

TEST_F(Params, UnknownOnesOfADirectiveDoNotFloodTheLog) {
  std::string text;
  for (int i = 0; i < 500; ++i) text += "\"float unknown" + std::to_string(i) + "\" 1 ";
  Bind(text);
  ASSERT_EQ(log_.Messages().size(), 11u);
  EXPECT_NE(log_.Messages()[10].find("490 more unknown parameters of shape \"x\""),
            std::string::npos);
  for (int i = 0; i < 1000; ++i) text += "\"float other" + std::to_string(i) + "\" 1 ";
  EXPECT_NE(Fails(text).find("more than 1000 parameters of one directive"), std::string::npos);
}

TEST_F(Params, OfTwoWithOneNameTheLastCountsWithoutAWarning) {
  EXPECT_EQ(Bind("\"integer count\" 3 \"integer count\" 4").count, 4);
  EXPECT_EQ(log_.WarningCount(), 0);
}

TEST_F(Params, OverridesWinAndMayHoldOtherNames) {
  const ParamSet overrides = Parse("\"integer count\" 9 \"float radius\" 3");
  BindContext context = Context();
  context.overrides = &overrides;
  EXPECT_EQ(Table().Bind(Parse("\"integer count\" 3 \"float size\" 4"), context).count, 9);
  EXPECT_EQ(log_.WarningCount(), 0);
}

TEST_F(Params, ARequiredOneMustBeThere) {
  struct Need {
    std::string file;
  };
  const ParamTable<Need> table{Param("filename", &Need::file, "the file").Required()};
  try {
    table.Bind(Parse(""), Context());
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "shape \"x\" needs the parameter \"string filename\"");
    ASSERT_TRUE(error.Where());
    EXPECT_EQ(error.Where()->line, 1);
  }
}

TEST_F(Params, ARemovedOneIsAnErrorThatNamesItsReplacement) {
  struct Base {
    int count = 1;
  };
  struct Derived : Base {};
  const std::vector<RemovedParam> removed{{"shape", "the shape is always round", "delete it"}};
  const ParamTable<Base> base{removed, Param("count", &Base::count, "a number")};
  const ParamTable<Derived> table{base};
  EXPECT_EQ(table.Bind(Parse("\"integer count\" 3"), Context()).count, 3);
  try {
    table.Bind(Parse("\"string shape\" \"square\""), Context());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(FormatDiagnostic("error", error.what(), error.Where(), error.Hint()),
              "dir/a.pbrt:1:11: error: parameter \"shape\" of shape \"x\" no longer exists: the "
              "shape is always round\n    Shape \"x\" \"string shape\" \"square\"\n"
              "              ^\n    hint: delete it\n");
  }
}

TEST_F(Params, DefaultsAreShownAsSceneFilesWriteThem) {
  const std::vector<ParamDecl>& decls = Table().Declarations();
  const auto text = [&](const std::string& name) {
    for (const ParamDecl& decl : decls) {
      if (decl.name == name) return decl.defaultText;
    }
    return std::string("?");
  };
  EXPECT_EQ(text("count"), "5");
  EXPECT_EQ(text("size"), "0.1");
  EXPECT_EQ(text("on"), "\"true\"");
  EXPECT_EQ(text("fruit"), "\"pear\"");
  EXPECT_EQ(text("light"), "[1 1 1]");
  EXPECT_EQ(text("way"), "[0 0 1]");
  EXPECT_EQ(text("angle"), "");
  EXPECT_EQ(text("bump"), "0.5");
  EXPECT_EQ(text("paint"), "[1 1 1]");
}

}  // namespace
}  // namespace exphoton
