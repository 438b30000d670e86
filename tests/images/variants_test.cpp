// SPDX-License-Identifier: BSD-2-Clause
// These tests check that the variants of a scene differ only in the line of the surface integrator,
// so that their pictures differ only by integrator.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace exphoton {
namespace {

const std::filesystem::path kScenes = std::string(EXPHOTON_SOURCE_DIR) + "/scenes";

std::vector<std::string> ReadLines(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

// Returns the scene folders, which are the folders with geometry.
std::vector<std::filesystem::path> SceneFolders() {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes))
    if (std::filesystem::exists(entry.path() / "geometry.pbrt")) folders.push_back(entry.path());
  return folders;
}

TEST(SceneVariants, DifferInTheIntegratorsLineAlone) {
  const std::vector<std::filesystem::path> folders = SceneFolders();
  EXPECT_GE(folders.size(), 5u);
  for (const std::filesystem::path& folder : folders) {
    const std::vector<std::string> path = ReadLines(folder / "path.pbrt");
    for (const std::string variant : {"exphotonmap", "photonmap", "directlighting", "whitted"}) {
      SCOPED_TRACE((folder / variant).string());
      const std::vector<std::string> lines = ReadLines(folder / (variant + ".pbrt"));
      ASSERT_EQ(lines.size(), path.size());
      int differing = 0;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i] == path[i]) continue;
        ++differing;
        EXPECT_EQ(lines[i].rfind("SurfaceIntegrator \"" + variant + "\"", 0), 0u) << lines[i];
        EXPECT_EQ(path[i].rfind("SurfaceIntegrator \"path\"", 0), 0u) << path[i];
      }
      EXPECT_EQ(differing, 1);
    }
  }
}

// Expects that two variants of the skylight room differ in the first line and in the file that is
// included in place of the sun.
void ExpectOtherSun(const std::string& variant, const std::string& other, const std::string& sun) {
  const std::vector<std::string> lines = ReadLines(kScenes / "skylight-room" / variant);
  const std::vector<std::string> changed = ReadLines(kScenes / "skylight-room" / other);
  ASSERT_EQ(lines.size(), changed.size());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i] == "Include \"sun.pbrt\"")
      EXPECT_EQ(changed[i], "Include \"" + sun + "\"");
    else
      EXPECT_EQ(changed[i], lines[i]);
  }
}

TEST(SceneVariants, EmittersReplaceTheSunAlone) {
  ExpectOtherSun("path.pbrt", "emitters.pbrt", "patch.pbrt");
}

TEST(SceneVariants, ASpotReplacesTheSunAlone) {
  ExpectOtherSun("exphotonmap.pbrt", "spot.pbrt", "spot_sun.pbrt");
}

}  // namespace
}  // namespace exphoton
