// SPDX-License-Identifier: BSD-2-Clause
// These tests check where a file that a scene names is looked for.
#include "core/params/scene_path.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/process.h"

namespace exphoton {
namespace {

// Returns a place in the last of these files. Each file includes the next one.
SourceLocation PlaceIn(const std::vector<std::string>& files) {
  SourceLocation where;
  for (const std::string& file : files) {
    if (!where.file.empty()) where.includedFrom = std::make_shared<const SourceLocation>(where);
    where.file = file;
  }
  return where;
}

TEST(ScenePath, TheMainFileIncludesAllOthers) {
  EXPECT_EQ(MainFileOf(PlaceIn({"a"})), "a");
  EXPECT_EQ(MainFileOf(PlaceIn({"a", "b"})), "a");
  EXPECT_EQ(MainFileOf(PlaceIn({"a", "b", "c", "d"})), "a");
}

TEST(ScenePath, FoldersAreTriedFromTheNearestFileOutwards) {
  using Paths = std::vector<std::string>;
  EXPECT_EQ(ScenePathCandidates("x.png", "main/parts/b.pbrt", "main/a.pbrt"),
            (Paths{"main/parts/x.png", "main/x.png", "x.png"}));
  EXPECT_EQ(ScenePathCandidates("x.png", "main/a.pbrt", "main/a.pbrt"),
            (Paths{"main/x.png", "x.png"}));
  EXPECT_EQ(ScenePathCandidates("/x.png", "main/a.pbrt", "main/a.pbrt"), Paths{"/x.png"});
}

TEST(ScenePath, AFileBesideTheMainFileIsFoundFromAnyDepth) {
  const TestFolder folder;
  WriteFile(folder.File("x.png"), "x");
  const SourceLocation where =
      PlaceIn({folder.File("a.pbrt"), folder.File("b/b.pbrt"), folder.File("b/c/c.pbrt")});
  EXPECT_EQ(ResolveScenePath("x.png", where), folder.File("x.png"));
  EXPECT_EQ(ResolveScenePath("none.png", where), folder.File("b/c/none.png"));
}

TEST(ScenePath, AFileThatCannotBeReadIsNamedInASentence) {
  const std::string fault = "names \"a/x.png\", which cannot be read: no such file";
  EXPECT_EQ(UnreadableFileText("a/x.png", "a/x.png: no such file"), fault);
  EXPECT_EQ(UnreadableFileText("a/x.png", "no such file"), fault);
  EXPECT_EQ(UnreadableFileText("x.brdf", "x.brdf:3: a word"),
            "names a file that cannot be read: x.brdf:3: a word");
}

}  // namespace
}  // namespace exphoton
