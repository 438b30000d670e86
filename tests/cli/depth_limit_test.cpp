// SPDX-License-Identifier: BSD-2-Clause
// These tests check the warning about light that a depth limit cuts, and the parameters that
// --integrator keeps.
#include <cmath>

#include "core/imaging/files/exr.h"
#include "core/imaging/metrics/metrics.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

// A closed room of albedo .7 with a lamp.
std::string Room(const std::string& integrator) {
  return "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 18\n"
         "Camera \"perspective\" \"float fov\" 70\nPixelFilter \"box\"\n"
         "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 256\nSurfaceIntegrator " +
         integrator +
         "\nWorldBegin\nMaterial \"matte\" \"color Kd\" [.7 .7 .7]\n"
         "Shape \"sphere\" \"float radius\" 4\n"
         "AttributeBegin AreaLightSource \"area\" \"color L\" [5 5 5] Translate 0 1 2\n"
         "Shape \"sphere\" \"float radius\" .5 AttributeEnd\nWorldEnd\n";
}

// A ball and a floor, both mirrors, and a lamp. The camera sees the lamp in them, and its image
// after several reflections.
std::string Mirrors(const std::string& integrator) {
  return "Film \"image\" \"integer xresolution\" 64 \"integer yresolution\" 48\n"
         "LookAt 0 2 6 0 1 0 0 1 0 Camera \"perspective\" \"float fov\" 45\n"
         "PixelFilter \"box\" Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 16\n"
         "SurfaceIntegrator " +
         integrator +
         "\nWorldBegin\n"
         "AttributeBegin AreaLightSource \"area\" \"color L\" [40 40 40] Translate 2 4 2\n"
         "Shape \"sphere\" \"float radius\" .3 AttributeEnd\n"
         "Material \"mirror\" \"color Kr\" [.9 .9 .9]\n"
         "AttributeBegin Translate 0 1 0 Shape \"sphere\" AttributeEnd\n"
         "Shape \"trianglemesh\" \"point P\" [-5 0 -5 5 0 -5 5 0 5 -5 0 5]\n"
         "\"integer indices\" [0 1 2 0 2 3]\nWorldEnd\n";
}

// A matte ball with a lamp, and a mirror that shows only black.
std::string DarkMirror(const std::string& integrator) {
  return "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 18\n"
         "LookAt 0 0 6 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 45\n"
         "PixelFilter \"box\" Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 16\n"
         "SurfaceIntegrator " +
         integrator +
         "\nWorldBegin\nLightSource \"point\" \"point from\" [0 0 4]\n"
         "AttributeBegin Translate -1 0 0 Shape \"sphere\" \"float radius\" .9 AttributeEnd\n"
         "AttributeBegin Material \"mirror\" Translate 1 0 0 Rotate 40 0 1 0\n"
         "Shape \"disk\" AttributeEnd\nWorldEnd\n";
}

constexpr const char* kAllIntegrators[] = {"path",        "guidedpath",    "bidirectional",
                                           "exphotonmap", "photonmap",     "igi",
                                           "whitted",     "directlighting"};

std::string WithDepth(const std::string& integrator, int depth) {
  const std::string text = '"' + integrator + "\" \"integer maxdepth\" " + std::to_string(depth);
  if (!integrator.ends_with("photonmap")) return text;
  return text +
         " \"integer indirectphotons\" 500 \"integer causticphotons\" 500"
         " \"integer maxphotonpaths\" 5000 \"integer finalgathersamples\" 2";
}

class DepthLimitTest : public ProgramTest {
 protected:
  struct Outcome {
    std::string messages;
    double mean;
  };
  Outcome Render(const std::string& integrator, Names arguments = {}) {
    return RenderText(Room(integrator), std::move(arguments));
  }
  Outcome RenderText(const std::string& text, Names arguments = {}) {
    Write("scene.pbrt", text);
    for (const char* word : {"scene.pbrt", "-o", "out.exr", "--float", "--no-progress"})
      arguments.push_back(word);
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    const Image image = ReadExr(Path("out.exr"));
    double mean = 0;
    for (int y = 0; y < image.Height(); ++y)
      for (int x = 0; x < image.Width(); ++x)
        mean += double(image.At(x, y, 1)) / (image.Width() * image.Height());
    return {result.err, mean};
  }
  // Returns the percentage of a warning, or 0 without one.
  static double WarnedShare(const std::string& messages, const std::string& parameter) {
    const std::string text = "the depth limit \"" + parameter + "\" cut about ";
    const std::size_t at = messages.find(text);
    return at == std::string::npos ? 0 : std::stod(messages.substr(at + text.size()));
  }
};

TEST_F(DepthLimitTest, CutsTheLightThatTheWarningStates) {
  for (const std::string name : {"path", "bidirectional"}) {
    const double whole = Render('"' + name + "\" \"integer maxdepth\" 200").mean;
    for (const int depth : {0, 2, 5}) {
      const Outcome cut = Render('"' + name + "\" \"integer maxdepth\" " + std::to_string(depth));
      const double share = 100 * (1 - cut.mean / whole);
      EXPECT_NEAR(WarnedShare(cut.messages, "maxdepth"), share, .2 * share) << name << depth;
      EXPECT_NE(cut.messages.find("integrator \"" + name + "\": the depth limit"),
                std::string::npos);
    }
  }
}

TEST_F(DepthLimitTest, IsNotMentionedWhereItCutsLittle) {
  for (const char* integrator :
       {"\"path\" \"integer maxdepth\" 60", "\"bidirectional\" \"integer maxdepth\" 60",
        "\"whitted\"", "\"directlighting\""})
    EXPECT_EQ(Render(integrator, {"--spp", "4"}).messages.find("depth limit"), std::string::npos)
        << integrator;
}

// Few paths find the lamp, so all of them must be measured.
TEST_F(DepthLimitTest, IsMentionedForMirrorsInASmallPicture) {
  for (const std::string name : kAllIntegrators) {
    const double whole = RenderText(Mirrors(WithDepth(name, 30)), {"--spp", "64"}).mean;
    const Outcome cut = RenderText(Mirrors(WithDepth(name, 1)));
    const double share = 100 * (1 - cut.mean / whole);
    EXPECT_GT(share, 30) << name;
    EXPECT_NEAR(WarnedShare(cut.messages, "maxdepth"), share, 20) << name << "\n" << cut.messages;
  }
}

TEST_F(DepthLimitTest, IsMentionedInASmallPictureWithFewSamples) {
  for (const char* name : {"path", "guidedpath", "bidirectional"})
    EXPECT_GT(WarnedShare(Render(WithDepth(name, 2), {"--spp", "4"}).messages, "maxdepth"), 5)
        << name;
}

TEST_F(DepthLimitTest, IsNotMentionedForMirrorsWhoseImagesAreWholeOrBlack) {
  const auto isSilent = [&](const std::string& text) {
    return RenderText(text).messages.find("depth limit") == std::string::npos;
  };
  for (const char* name : kAllIntegrators)
    EXPECT_TRUE(isSilent(Mirrors(WithDepth(name, 30)))) << name;
  for (const char* name : {"whitted", "directlighting"})
    EXPECT_TRUE(isSilent(DarkMirror(WithDepth(name, 0)))) << name;
}

TEST_F(DepthLimitTest, OfIrradianceRecordsIsMentionedToo) {
  const std::string cache = "\"irradiancecache\" \"integer nsamples\" 256 ";
  const Outcome cut = Render(cache + "\"integer maxindirectdepth\" 1", {"--spp", "4"});
  // Each bounce carries .7 of the light of the one before, so 70 % of the gathered light is missing
  // after the first.
  EXPECT_NEAR(WarnedShare(cut.messages, "maxindirectdepth"), 70, 7) << cut.messages;
}

TEST_F(DepthLimitTest, GivesTheSameWarningForAnyNumberOfThreads) {
  const std::string path = "\"path\" \"integer maxdepth\" 3";
  const auto warning = [&](const char* threads) {
    const std::string text = Render(path, {"--nthreads", threads, "--spp", "4"}).messages;
    return text.substr(text.find("warning"), text.find("hint") - text.find("warning"));
  };
  EXPECT_EQ(warning("1"), warning("3"));
}

// The default of "path" in a file is version 1's.
TEST_F(DepthLimitTest, DependsOnWhoNamesTheIntegrator) {
  const std::string messages = Render("\"path\"", {"--spp", "64"}).messages;
  EXPECT_GT(WarnedShare(messages, "maxdepth"), 2);
  for (const char* integrator : {"path", "bidirectional"}) {
    const Outcome named = Render("\"exphotonmap\" \"integer maxdepth\" 2",
                                 {"--integrator", integrator, "--spp", "8"});
    EXPECT_EQ(WarnedShare(named.messages, "maxdepth"), 0) << named.messages;
    EXPECT_NE(named.messages.find("\"maxdepth\" of integrator \"exphotonmap\" does not apply"),
              std::string::npos)
        << named.messages;
  }
}

}  // namespace
}  // namespace exphoton
