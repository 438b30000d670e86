// SPDX-License-Identifier: BSD-2-Clause
// These tests check that scenes of versions 3 and 4 are recognised, with one error that names the
// version, and that scenes of versions 1 and 2 never are.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/parser/later_version.h"
#include "core/parser/syntax/source.h"

namespace exphoton {
namespace {

std::string Said(const std::string& text) {
  MemorySource source({{"a.pbrt", text}});
  try {
    RefuseLaterVersion(source, "a.pbrt", {});
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Scene);
    EXPECT_FALSE(error.Hint().empty());
    EXPECT_TRUE(error.Others().empty());
    const std::string message = error.what();
    const std::string end = ": versions 1 and 2 are read",
                      begin = "this is a scene of pbrt version ";
    EXPECT_TRUE(message.starts_with(begin) && message.ends_with(end)) << message;
    return std::to_string(error.Where()->line) + ":" + std::to_string(error.Where()->column) + " " +
           message.substr(begin.size(), message.size() - begin.size() - end.size());
  }
  return "";
}

TEST(LaterVersion, FourIsRecognisedByItsFilmsAndDirectives) {
  EXPECT_EQ(Said("LookAt 0 0 0 0 0 1 0 1 0\nFilm \"rgb\" \"integer xresolution\" 4\nWorldBegin\n"),
            "2:1 4, recognised by Film \"rgb\"");
  EXPECT_EQ(Said("Film \"gbuffer\""), "1:1 4, recognised by Film \"gbuffer\"");
  EXPECT_EQ(Said("Film \"spectral\""), "1:1 4, recognised by Film \"spectral\"");
  EXPECT_EQ(Said("  Option \"bool disablepixeljitter\" true"), "1:3 4, recognised by Option");
  EXPECT_EQ(Said("ColorSpace \"rec2020\""), "1:1 4, recognised by ColorSpace");
  EXPECT_EQ(Said("WorldBegin Attribute \"shape\" \"float x\" 1"),
            "1:12 4, recognised by Attribute");
  EXPECT_EQ(Said("Import \"part.pbrt\""), "1:1 4, recognised by Import");
  EXPECT_EQ(Said("Integrator \"volpath\"\nSampler \"zsobol\"\nWorldBegin"),
            "1:1 4, recognised by Integrator");
  EXPECT_EQ(Said("Integrator \"volpath\"\nWorldBegin Material \"coateddiffuse\""),
            "1:1 4, recognised by Integrator");
}

TEST(LaterVersion, ThreeIsRecognisedByItsIntegratorAndWhatOnlyEarlierVersionsHave) {
  EXPECT_EQ(Said("Integrator \"path\"\nFilm \"image\"\nWorldBegin WorldEnd"),
            "1:1 3, recognised by Integrator");
  EXPECT_EQ(Said("Sampler \"02sequence\" Integrator \"path\""), "1:22 3, recognised by Integrator");
  EXPECT_EQ(Said("WorldBegin MakeNamedMedium \"fog\" WorldEnd"),
            "1:12 3, recognised by MakeNamedMedium");
}

TEST(LaterVersion, IsThreeOrFourIfNothingDecides) {
  EXPECT_EQ(Said("Integrator \"path\"\nWorldBegin\n"), "1:1 3 or 4, recognised by Integrator");
  EXPECT_EQ(Said("MediumInterface \"fog\" \"\""), "1:1 3 or 4, recognised by MediumInterface");
}

TEST(LaterVersion, IsNotSeenInStringsCommentsParametersOrEarlierScenes) {
  for (const char* text :
       {"", "# Integrator \"path\"\nWorldBegin WorldEnd", "SurfaceIntegrator \"path\"",
        "VolumeIntegrator \"single\" Film \"image\" \"string filename\" \"Integrator\"",
        "Material \"matte\" \"rgb Kd\" [1 1 1] Texture \"rgb\" \"color\" \"constant\"",
        "AttributeBegin AttributeEnd Material \"diffuse\" Sampler \"zsobol\"",
        "Include \"Import\" SurfaceIntegrator \"Option\"", "WorldBegin [ Integrator"})
    EXPECT_EQ(Said(text).find("recognised by Film"), std::string::npos) << text;
  EXPECT_EQ(Said("Material \"matte\" \"rgb Kd\" [1 1 1] Texture \"rgb\" \"color\" \"constant\""),
            "");
  EXPECT_EQ(Said("# Integrator \"path\"\nWorldBegin WorldEnd"), "");
  EXPECT_EQ(Said("Material \"diffuse\" SurfaceIntegrator \"Option\" Include \"Import\""), "");
}

}  // namespace
}  // namespace exphoton
