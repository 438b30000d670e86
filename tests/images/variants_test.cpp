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

// emitters.pbrt equals path.pbrt, except for its first line and the patch in place of the sun.
TEST(SceneVariants, EmittersReplaceTheSunAlone) {
  const std::vector<std::string> path = ReadLines(kScenes / "skylight-room/path.pbrt");
  const std::vector<std::string> emitters = ReadLines(kScenes / "skylight-room/emitters.pbrt");
  ASSERT_EQ(path.size(), emitters.size());
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i] == "Include \"sun.pbrt\"")
      EXPECT_EQ(emitters[i], "Include \"patch.pbrt\"");
    else
      EXPECT_EQ(emitters[i], path[i]);
  }
}

}  // namespace
}  // namespace exphoton
