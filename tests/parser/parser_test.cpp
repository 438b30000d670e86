// SPDX-License-Identifier: BSD-2-Clause
// These tests check the syntax of directives and parameters, and the exact wording of the
// error messages.
#include "core/parser/syntax/parser.h"

#include <gtest/gtest.h>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

TEST(Parser, ReadsNumbersWithAndWithoutBrackets) {
  const auto directives = ParseText("Translate 1 2 3 Translate [1 2 3]\nIdentity");
  ASSERT_EQ(directives.size(), 3u);
  EXPECT_EQ(directives[0].numbers, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(directives[1].numbers, directives[0].numbers);
  EXPECT_EQ(directives[2].spec->id, DirectiveId::Identity);
}

TEST(Parser, ReadsParametersWithTheirPlaces) {
  const auto directives = ParseText(
      "Shape \"sphere\" \"float radius\" 2\n"
      "  \"  color   Kd\t\" [ .1 .2 .3 ] \"texture Ks\" [\"t\"] \"bool b\" \"true\" \"point P\" "
      "[]");
  ASSERT_EQ(directives.size(), 1u);
  const ParamSet& params = directives[0].params;
  EXPECT_EQ(params.where.line, 1);
  ASSERT_EQ(params.All().size(), 5u);
  const ParsedParam* kd = params.Find("Kd");
  ASSERT_NE(kd, nullptr);
  EXPECT_EQ(kd->type, "color");
  EXPECT_EQ(kd->numbers, (std::vector<double>{.1, .2, .3}));
  EXPECT_EQ(kd->where.line, 2);
  EXPECT_EQ(kd->where.column, 3);
  ASSERT_EQ(kd->valueWhere.size(), 3u);
  EXPECT_EQ(kd->valueWhere[1].column, 24);
  EXPECT_EQ(params.Find("Ks")->strings, (std::vector<std::string>{"t"}));
  EXPECT_TRUE(params.Find("P")->numbers.empty());
}

TEST(Parser, KeepsNoPlacesOfLongLists) {
  std::string text = "Shape \"s\" \"float x\" [";
  for (int i = 0; i < 1000; ++i) text += " 1";
  const auto directives = ParseText(text + "]");
  EXPECT_EQ(directives[0].params.Find("x")->numbers.size(), 1000u);
  EXPECT_TRUE(directives[0].params.Find("x")->valueWhere.empty());
}

TEST(Parser, LetsTheLaterOfTwoParametersCountAndSaysSoIfVerbose) {
  Log normal(Log::Level::Normal, Log::Sink::Memory);
  ParseFiles({{"scene.pbrt", "Film \"image\" \"integer x\" 1 \"integer x\" 2"}}, &normal);
  EXPECT_TRUE(normal.Messages().empty());
  Log log(Log::Level::Verbose, Log::Sink::Memory);
  const auto directives =
      ParseFiles({{"scene.pbrt", "Film \"image\" \"integer x\" 1 \"integer x\" 2"}}, &log);
  EXPECT_EQ(directives[0].params.Find("x")->numbers[0], 2);
  ASSERT_EQ(log.Messages().size(), 1u);
  EXPECT_EQ(log.Messages()[0],
            "scene.pbrt:1:28: note: parameter \"x\" is given twice: the last one counts\n"
            "    Film \"image\" \"integer x\" 1 \"integer x\" 2\n"
            "                               ^\n");
}

TEST(Parser, LetsTheLaterOfTwoParametersCountIfTheirTypesDiffer) {
  const auto directives =
      ParseText("Material \"matte\" \"float sigma\" 3 \"texture sigma\" \"map\"");
  ASSERT_EQ(directives[0].params.All().size(), 1u);
  EXPECT_EQ(directives[0].params.Find("sigma")->type, "texture");
}

struct ParserCase {
  const char* text;
  const char* message;
};

// The messages are compared without the source line and the caret. Other tests compare
// full messages.
void PrintTo(const ParserCase& c, std::ostream* out) { *out << c.text; }
class ParserError : public testing::TestWithParam<ParserCase> {};

TEST_P(ParserError, IsSaidInTheseWords) {
  try {
    ParseText(GetParam().text);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Scene);
    ASSERT_TRUE(error.Where());
    std::string said = std::to_string(error.Where()->line) + ":" +
                       std::to_string(error.Where()->column) + ": " + error.what();
    if (!error.Hint().empty()) said += " | " + error.Hint();
    EXPECT_EQ(said, GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, ParserError,
    testing::Values(
        ParserCase{"Translte 1 2 3",
                   "1:1: unknown directive Translte | did you mean \"Translate\"?"},
        ParserCase{"qqqq", "1:1: unknown directive qqqq"},
        ParserCase{"shape \"sphere\"", "1:1: unknown directive shape | did you mean \"Shape\"?"},
        ParserCase{
            "MakeNamedMedium \"m\"",
            "1:1: this is a scene of pbrt version 3 or 4, recognised by MakeNamedMedium: versions "
            "1 "
            "and 2 are read | exphoton import scene.pbrt -o NEW.pbrt converts it"},
        ParserCase{
            "\nIntegrator \"path\"",
            "2:1: this is a scene of pbrt version 3 or 4, recognised by Integrator: versions 1 "
            "and 2 "
            "are read | exphoton import scene.pbrt -o NEW.pbrt converts it"},
        ParserCase{"12", "1:1: expected a directive, found a number"},
        ParserCase{"\"x\"", "1:1: expected a directive, found the string \"x\""},
        ParserCase{"]", "1:1: expected a directive, found ']'"},
        ParserCase{"[[[[", "1:1: expected a directive, found '['"},
        ParserCase{"Translate 1 2",
                   "1:14: Translate takes 3 numbers, found the end of the file after 2"},
        ParserCase{"Translate 1 2 Scale 1 1 1",
                   "1:15: Translate takes 3 numbers, found Scale after 2"},
        ParserCase{"Translate 1 2 3 4", "1:17: Translate takes 3 numbers, found one more"},
        ParserCase{"Transform [1 2]", "1:15: Transform takes 16 numbers, found ']' after 2"},
        ParserCase{"Scale [1 1 1 Identity", "1:14: expected ']', found Identity"},
        ParserCase{"Camera 3", "1:8: Camera takes a name in quotes, found a number"},
        ParserCase{"Texture \"a\" \"float\" Shape",
                   "1:21: Texture takes a name, a type and a class in quotes, found Shape"},
        ParserCase{"ActiveTransform 1", "1:17: ActiveTransform takes a word, found a number"},
        ParserCase{"Include 5", "1:9: Include takes the name of a file in quotes, found a number"},
        ParserCase{"Include \"\"", "1:9: Include names no file"},
        ParserCase{"Camera \"p\" 5", "1:12: expected a parameter or a directive, found a number"},
        ParserCase{"Camera \"p\" \"fov\" 5",
                   "1:12: expected a parameter \"type name\", found \"fov\""},
        ParserCase{"Camera \"p\" \"float a b\" 5",
                   "1:12: expected a parameter \"type name\", found \"float a b\""},
        ParserCase{"Camera \"p\" \"flaot fov\" 5",
                   "1:12: unknown parameter type \"flaot\" | did you mean \"float\"?"},
        ParserCase{"Camera \"p\" \"float fov\"",
                   "1:23: parameter \"fov\" has the end of the file for a value"},
        ParserCase{"Camera \"p\" \"float fov\" \"x\"",
                   "1:24: parameter \"fov\" of type float takes numbers, found the string \"x\""},
        ParserCase{"Camera \"p\" \"string s\" 5",
                   "1:23: parameter \"s\" of type string takes strings in quotes, found a number"},
        ParserCase{"Camera \"p\" \"bool b\" true",
                   "1:21: parameter \"b\" has true for a value | write \"true\" in quotes"},
        ParserCase{"Camera \"p\" \"spectrum s\" [1 \"x\"]",
                   "1:28: parameter \"s\" mixes numbers and strings"},
        ParserCase{"Camera \"p\" \"float x\" [1 [2]]", "1:25: parameter \"x\" has '[' for a value"},
        ParserCase{"Camera \"p\" \"float x\" [1 nan]", "1:25: parameter \"x\" has nan for a value"},
        ParserCase{"Camera \"p\"\n\"float x\" [1 2",
                   "2:11: the list that begins here has no ']'"}));

TEST(Parser, ShowsTheLineAndACaret) {
  EXPECT_EQ(ParseErrorOf("Identity\n\tTranslte 1 2 3  # comment\n"),
            "scene.pbrt:2:2: error: unknown directive Translte\n"
            "    \tTranslte 1 2 3  # comment\n"
            "    \t^\n"
            "    hint: did you mean \"Translate\"?\n");
}

TEST(Parser, SurvivesAMillionBrackets) {
  EXPECT_NE(ParseErrorOf("Camera \"p\" \"float x\" " + std::string(1'000'000, '[')), "");
}

TEST(Include, GoesOnBehindTheIncludedFile) {
  const auto directives = ParseFiles({{"scene.pbrt", "Include \"sub/a.pbrt\" Translate 3 0 0"},
                                      {"sub/a.pbrt", "Translate 1 0 0 Include \"b.pbrt\""},
                                      {"sub/b.pbrt", "# nothing else\nTranslate 2 0 0"}});
  ASSERT_EQ(directives.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(directives[i].numbers[0], double(i + 1));
  EXPECT_EQ(directives[1].Where().file, "sub/b.pbrt");
  EXPECT_EQ(directives[2].Where().file, "scene.pbrt");
}

TEST(Include, NamesTheFilesThatLedToAnError) {
  EXPECT_EQ(ParseErrorOf({{"scene.pbrt", "Identity\nInclude \"a.pbrt\""},
                          {"a.pbrt", "  Include \"b.pbrt\""},
                          {"b.pbrt", "Sale 1 1 1"}}),
            "b.pbrt:1:1: error: unknown directive Sale\n"
            "    Sale 1 1 1\n"
            "    ^\n"
            "    included from a.pbrt:1:3\n"
            "    included from scene.pbrt:2:1\n"
            "    hint: did you mean \"Scale\"?\n");
}

TEST(Include, SaysWhichFileIsMissing) {
  EXPECT_EQ(ParseErrorOf({{"scene.pbrt", "Include \"sub/a.pbrt\""},
                          {"sub/a.pbrt", "Include \"none.pbrt\""}}),
            "sub/a.pbrt:1:1: error: cannot read the included file \"sub/none.pbrt\": no such file\n"
            "    Include \"none.pbrt\"\n"
            "    ^\n"
            "    included from scene.pbrt:1:1\n"
            "    hint: tried \"sub/none.pbrt\" and \"none.pbrt\"\n");
}

TEST(Include, IsLookedUpInThreeFolders) {
  // The folder of the file that names it, the folder of the main file, and the working folder.
  const std::string include = "Include \"b.pbrt\"";
  for (const char* place : {"main/sub/b.pbrt", "main/b.pbrt", "b.pbrt"}) {
    std::map<std::string, std::string> files{{"main/scene.pbrt", "Include \"sub/a.pbrt\""},
                                             {"main/sub/a.pbrt", include}};
    files[place] = "Identity";
    MemorySource source(files);
    Log log(Log::Level::Normal, Log::Sink::Memory);
    DirectiveList list;
    ParseScene(source, "main/scene.pbrt", list, log);
    EXPECT_EQ(list.directives.size(), 1u) << place;
    EXPECT_EQ(list.directives[0].Where().file, place);
  }
}

TEST(Include, NamesTheCycleOfFilesThatIncludeEachOther) {
  EXPECT_EQ(ParseErrorOf(std::string("Include \"scene.pbrt\"")),
            "scene.pbrt:1:1: error: the file includes itself: scene.pbrt -> scene.pbrt\n"
            "    Include \"scene.pbrt\"\n"
            "    ^\n");
  EXPECT_EQ(ParseErrorOf({{"scene.pbrt", "Include \"a.pbrt\""},
                          {"a.pbrt", "Include \"b.pbrt\""},
                          {"b.pbrt", "Include \"a.pbrt\""}}),
            "b.pbrt:1:1: error: the file includes itself: a.pbrt -> b.pbrt -> a.pbrt\n"
            "    Include \"a.pbrt\"\n"
            "    ^\n"
            "    included from a.pbrt:1:1\n"
            "    included from scene.pbrt:1:1\n");
}

TEST(Include, MayNestThirtyTwoDeepAndNoDeeper) {
  const auto chain = [](int depth) {
    Files files{{"scene.pbrt", "Include \"1.pbrt\""}};
    for (int i = 1; i < depth; ++i)
      files[std::to_string(i) + ".pbrt"] = "Include \"" + std::to_string(i + 1) + ".pbrt\"";
    files[std::to_string(depth) + ".pbrt"] = "Identity";
    return files;
  };
  EXPECT_EQ(ParseErrorOf(chain(32)), "");
  EXPECT_EQ(ParseErrorOf(chain(33)).substr(0, 57),
            "32.pbrt:1:1: error: files are included more than 32 deep\n");
}

TEST(Include, MayComeTwiceOneAfterTheOther) {
  const auto directives = ParseFiles(
      {{"scene.pbrt", "Include \"a.pbrt\"\nInclude \"a.pbrt\""}, {"a.pbrt", "Identity"}});
  EXPECT_EQ(directives.size(), 2u);
}

}  // namespace
}  // namespace exphoton
