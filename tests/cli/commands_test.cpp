// SPDX-License-Identifier: BSD-2-Clause
// These tests run the commands that do not render: help, version, plugins, info,
// convert and compare.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "core/base/terminal.h"
#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class CommandTest : public ProgramTest {
 protected:
  void WriteGrey(const std::string& name, float value) const {
    Image image(3, 2, {"R", "G", "B"});
    for (float& pixel : image.pixels) pixel = value;
    image.attributes["software"] = std::string("test");
    WriteExr(Path(name), image, false);
  }
};

TEST_F(CommandTest, PrintHelpAndVersionToStandardOutput) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"-h"},
                                             {"render", "--help"},
                                             {"plugins", "--help"},
                                             {"info", "--help"},
                                             {"convert", "--help"},
                                             {"compare", "--help"},
                                             {"merge", "--help"},
                                             {"cluster", "--help"},
                                             {"photons", "--help"},
                                             {"check-plugin", "--help"},
                                             {"quote", "--help"},
                                             {"budget", "--help"},
                                             {"study", "--help"},
                                             {"report", "--help"},
                                             {"explain", "--help"}}) {
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_NE(result.out.find("Usage: exphoton"), std::string::npos) << result.out;
  }
  EXPECT_EQ(Run({"--version"}).out.substr(0, 9), "exphoton ");
}

TEST_F(CommandTest, HelpFitsItsColumns) {
  for (const char* columns : {"70", "60"}) {
    setenv("COLUMNS", columns, 1);
    const std::string help = Run({"--help"}).out;
    unsetenv("COLUMNS");
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(Characters(line), std::atoi(columns)) << line;
    EXPECT_NE(help.find("\n  exphoton denoise PICTURE           filter noise of a"),
              std::string::npos)
        << help;
    EXPECT_NE(help.find(" --integrator path --set \\\n      SurfaceIntegrator.maxdepth=20\n"),
              std::string::npos)
        << help;
  }
}

TEST_F(CommandTest, ListPluginsAndTheirParameters) {
  const ProgramResult all = Run({"plugins"});
  EXPECT_EQ(all.status, 0);
  for (const char* name : {"matte", "sphere", "directlighting", "perspective"})
    EXPECT_NE(all.out.find(name), std::string::npos) << name;
  EXPECT_NE(Run({"plugins", "sphere"}).out.find("radius"), std::string::npos);
  EXPECT_EQ(Run({"plugins", "nosuch"}).status, 1);
}

TEST_F(CommandTest, ShowTheMeanOfTheFiniteValues) {
  Image image(2, 2, {"R"});
  image.pixels = {1, 3, std::numeric_limits<float>::quiet_NaN(), 5};
  WriteExr(Path("a.exr"), image, false);
  const ProgramResult result = Run({"info", "a.exr"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("mean 3            max 5            (1 not finite)"), std::string::npos)
      << result.out;
}

TEST_F(CommandTest, ShowWhatAPictureHolds) {
  WriteGrey("a.exr", .5f);
  const ProgramResult result = Run({"info", "a.exr"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* part : {"3 x 2 at (0, 0)", "G ", "mean 0.5", "software", "test"})
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  EXPECT_EQ(Run({"info", "none.exr"}).status, 3);
  EXPECT_EQ(Run({"info"}).status, 1);
}

TEST_F(CommandTest, ShowThePhotonsAroundWhatAPixelShows) {
  Write("room.pbrt",
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6\nCamera "
        "\"perspective\"\nSurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 500\n"
        "WorldBegin\nLightSource \"point\"\nMaterial \"matte\"\nReverseOrientation\n"
        "Shape \"sphere\" \"float radius\" 3\nWorldEnd\n");
  const ProgramResult result =
      Run({"info", "--photons-at", "4,3", "room.pbrt", "--count", "20", "--plot", "plot.svg"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 22) << result.out;
  EXPECT_EQ(result.out.substr(0, 8), "# point ");
  const std::string plot = Read("plot.svg");
  std::size_t dots = 0;
  for (std::size_t at = 0; (at = plot.find("class=\"dot\"", at)) != std::string::npos; ++at) ++dots;
  EXPECT_EQ(dots, 20u);
  const ProgramResult none = Run({"info", "--photons-at=4,3", "room.pbrt", "--integrator", "path"});
  EXPECT_EQ(none.status, 0);
  EXPECT_NE(none.err.find("integrator \"path\" has no photon maps"), std::string::npos) << none.err;
  const auto photonsOf = [&](const std::string& map) {
    return Run({"info", "--photons-at=4,3", "room.pbrt", "--count", "20", "--map", map});
  };
  EXPECT_EQ(photonsOf("indirect").out, result.out) << "the default is another map";
  EXPECT_NE(photonsOf("direct").out, result.out);
  EXPECT_NE(photonsOf("caustic").err.find("has no caustic photons in this scene"),
            std::string::npos);
  const ProgramResult unknown = photonsOf("indirct");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find("there is no photon map \"indirct\"; available: indirect, direct, "
                             "caustic"),
            std::string::npos)
      << unknown.err;
  EXPECT_EQ(Run({"info", "--photons-at", "8,3", "room.pbrt"}).status, 1);
  EXPECT_EQ(Run({"info", "--photons-at", "4", "room.pbrt"}).status, 1);
}

// Two places in a room of radius 3 are at most 6 apart, and some photon is nearly that far away.
TEST_F(CommandTest, ShowHowFarAwayPhotonsAre) {
  Write("room.pbrt",
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6\nCamera "
        "\"perspective\"\nSurfaceIntegrator \"photonmap\" \"integer indirectphotons\" 500\n"
        "WorldBegin\nLightSource \"point\"\nMaterial \"matte\" \"color Kd\" [.3 .3 .3]\n"
        "ReverseOrientation\nShape \"sphere\" \"float radius\" 3\nWorldEnd\n");
  const ProgramResult all = Run({"info", "--photons-at", "4,3", "room.pbrt", "--count", "50000"});
  ASSERT_EQ(all.status, 0) << all.err;
  std::istringstream lines(all.out);
  double farthest = 0;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#') farthest = std::max(farthest, std::stod(line));
  EXPECT_GT(farthest, 5);
  EXPECT_LT(farthest, 6.001);
}

// At the opening of the shutter the disk is half-way. The maps hold its photons where it starts.
TEST_F(CommandTest, ShowThePhotonsOfAMovingSurfaceWhereItIsSeen) {
  Write(
      "moving.pbrt",
      "Film \"image\" \"integer xresolution\" 9 \"integer yresolution\" 9\nTransformTimes 0 1\n"
      "LookAt 5 0 -10  5 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 5 \"float shutteropen\" "
      ".5 \"float shutterclose\" .501\nSurfaceIntegrator \"photonmap\" \"integer directphotons\" "
      "3000\nWorldBegin\nLightSource \"distant\" \"point from\" [0 3 -4] \"point to\" [0 0 0]\n"
      "ActiveTransform EndTime\nTranslate 10 0 0 Rotate 80 0 0 1\nActiveTransform All\n"
      "Shape \"disk\" \"float radius\" 1\nWorldEnd\n");
  const ProgramResult result =
      Run({"info", "--photons-at", "4,4", "moving.pbrt", "--count", "20", "--map", "direct"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::istringstream lines(result.out);
  int photons = 0;
  for (std::string line; std::getline(lines, line);) {
    double distance, x, y, z;
    if (std::sscanf(line.c_str(), "%lf %lf %lf %lf", &distance, &x, &y, &z) != 4) continue;
    ++photons;
    EXPECT_LT(distance, .3);
    EXPECT_NEAR(x, 0, .01);
    EXPECT_NEAR(y, .6, .01);
    EXPECT_NEAR(z, -.8, .01);
  }
  EXPECT_EQ(photons, 20) << result.out;
}

TEST_F(CommandTest, ConvertToPngAndBack) {
  WriteGrey("a.exr", .25f);
  EXPECT_EQ(Run({"convert", "a.exr", "a.png", "--exposure", "1"}).status, 0);
  EXPECT_EQ(Run({"convert", "a.png", "b.exr", "--float"}).status, 0);
  EXPECT_NEAR(double(ReadExr(Path("b.exr")).At(1, 1, 0)), .5, .004);
  EXPECT_EQ(Run({"convert", "a.exr", "a.gif"}).status, 1);
  EXPECT_EQ(Run({"convert", "none.exr", "a.png"}).status, 3);
  EXPECT_EQ(Run({"convert", "a.exr", "nowhere/a.png"}).status, 3);
}

TEST_F(CommandTest, CompareWithStatusesOfDiff) {
  WriteGrey("a.exr", .5f);
  WriteGrey("b.exr", .5f);
  WriteGrey("c.exr", .51f);
  EXPECT_EQ(Run({"compare", "a.exr", "b.exr"}).status, 0);
  const ProgramResult different = Run({"compare", "a.exr", "c.exr"});
  EXPECT_EQ(different.status, 1);
  EXPECT_NE(different.out.find("identical           no"), std::string::npos);
  EXPECT_NE(different.out.find("relative mean error +2 %"), std::string::npos) << different.out;
  EXPECT_EQ(Run({"compare", "a.exr", "c.exr", "--max-relmse", "0.01"}).status, 0);
  EXPECT_EQ(Run({"compare", "a.exr", "c.exr", "--max-mean", "0.01"}).status, 1);
  EXPECT_EQ(Run({"compare", "a.exr", "c.exr", "--max-mean", "0.03"}).status, 0);
  EXPECT_EQ(Run({"compare", "c.exr", "a.exr", "--max-mean", "0.01"}).status, 1);  // too dark
  EXPECT_EQ(Run({"compare", "a.exr", "none.exr"}).status, 2);
  EXPECT_EQ(Run({"compare", "a.exr"}).status, 2);
}

TEST_F(CommandTest, CompareCallsEqualPixelsAtAnotherPlaceNotIdentical) {
  const PixelBounds display{0, 0, 5, 4};
  for (const int x : {0, 2}) {
    Image image(PixelBounds{x, 1, x + 3, 3}, display, {"R", "G", "B"});
    for (float& pixel : image.pixels) pixel = .5f;
    WriteExr(Path(x == 0 ? "left.exr" : "right.exr"), image, false);
  }
  EXPECT_EQ(Run({"compare", "left.exr", "left.exr"}).status, 0);
  const ProgramResult moved = Run({"compare", "left.exr", "right.exr"});
  EXPECT_EQ(moved.status, 1);
  EXPECT_NE(moved.out.find("identical           no"), std::string::npos) << moved.out;
}

TEST_F(CommandTest, CompareSeveralPicturesAndWriteDifferenceImages) {
  WriteGrey("a.exr", .5f);
  WriteGrey("b.exr", .5f);
  WriteGrey("c.exr", .51f);
  const ProgramResult result =
      Run({"compare", "a.exr", "b.exr", "c.exr", "--difference", "diff/here"});
  EXPECT_EQ(result.status, 1) << result.err;
  for (const char* part : {"b.exr", "c.exr", "trimmed relMSE", "p99 error", "FLIP"})
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  const Image difference = ReadExr(Path("diff/here/c-difference.exr"));
  EXPECT_NEAR(double(difference.At(1, 1, difference.FindChannel("G"))), .01, 1e-6);
  EXPECT_TRUE(Exists("diff/here/b-difference.png"));
}

TEST_F(CommandTest, CompareSaysWhichPictureCannotBeCompared) {
  WriteGrey("a.exr", .5f);
  WriteExr(Path("small.exr"), Image(2, 2, {"R", "G", "B"}), false);
  WriteExr(Path("depth.exr"), Image(3, 2, {"Z"}), false);
  const ProgramResult size = Run({"compare", "a.exr", "a.exr", "small.exr"});
  EXPECT_EQ(size.status, 2);
  EXPECT_NE(size.err.find("small.exr: the pictures differ in size: 3 x 2 and 2 x 2"),
            std::string::npos)
      << size.err;
  const ProgramResult channel = Run({"compare", "a.exr", "depth.exr"});
  EXPECT_EQ(channel.status, 2);
  EXPECT_NE(channel.err.find("depth.exr lacks channel R, G, B (it has Z)"), std::string::npos)
      << channel.err;
}

TEST_F(CommandTest, CompareCountsPixelsThatAreNotFinite) {
  WriteGrey("a.exr", .5f);
  Image image(3, 2, {"R", "G", "B"});
  for (float& pixel : image.pixels) pixel = .5f;
  image.At(0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  image.At(2, 1, 0) = std::numeric_limits<float>::infinity();
  WriteExr(Path("b.exr"), image, false);
  const ProgramResult result = Run({"compare", "a.exr", "b.exr", "--max-relmse", "1"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("not finite          2 pixels"), std::string::npos) << result.out;
  EXPECT_EQ(Run({"compare", "b.exr", "b.exr"}).status, 1);
}

}  // namespace
}  // namespace exphoton
