// SPDX-License-Identifier: BSD-2-Clause
// These tests shoot photons in shares, by processes as a cluster would start them. The merged file
// has the bytes of the file that one process writes.
#include <filesystem>

#include "tests/cli/long/names.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

// A ball and a lamp within a grey sphere.
std::string Room(const std::string& photons) {
  return SmallScene("SurfaceIntegrator \"exphotonmap\" " + photons,
                    "Material \"matte\" \"color Kd\" [.4 .5 .6]\n"
                    "ReverseOrientation Shape \"sphere\" \"float radius\" 4\n");
}

class PhotonShares : public ProgramTest {
 protected:
  PhotonShares() {
    Write("room.pbrt", Room("\"integer indirectphotons\" 200000 \"integer causticphotons\" 0"));
  }
  ProgramResult Photons(const Names& more) const {
    return Run(Names{"photons", "room.pbrt"} + more);
  }
  ProgramResult Share(int index, int count, const Names& more = {}) const {
    return Photons(
        Names{"--shard", std::to_string(index) + "/" + std::to_string(count), "-o", "parts"} +
        more);
  }
  void ExpectMergedIsThatOfOneProcess(int count) const {
    const ProgramResult merged = Photons({"--merge", "parts", "-o", "merged.expm"});
    EXPECT_EQ(merged.status, 0) << merged.err;
    EXPECT_TRUE(Read("merged.expm") == Read("one.expm")) << count << " shares";
  }
  // Returns the share of the paths that the merge took from the parts.
  static double Taken(const std::string& messages) {
    const std::size_t at = messages.find("took ");
    double taken = 0, all = 1;
    if (at != std::string::npos)
      std::sscanf(messages.c_str() + at, "took %lf of %lf paths", &taken, &all);
    return taken / all;
  }
};

TEST_F(PhotonShares, OfAnyNumberGiveTheBytesOfOneProcess) {
  ASSERT_EQ(Photons({"-o", "one.expm"}).status, 0);
  for (const int count : {1, 2, 7}) {
    for (int index = count; index >= 1; --index)
      EXPECT_EQ(Share(index, count, {"--nthreads", index % 2 ? "1" : "2"}).status, 0);
    const ProgramResult merged = Photons({"--merge", "parts", "-o", "merged.expm"});
    EXPECT_EQ(merged.status, 0) << merged.err;
    EXPECT_TRUE(Read("merged.expm") == Read("one.expm")) << count << " shares";
    EXPECT_GT(Taken(merged.err), .5) << merged.err;
    std::filesystem::remove_all(Path("parts"));
  }
}

TEST_F(PhotonShares, OfGuidedAndCausticPhotonsGiveTheBytesOfOneProcess) {
  Write("room.pbrt", SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" "
                                "9000 \"integer causticphotons\" 3000",
                                "ReverseOrientation Shape \"sphere\" \"float radius\" 4\n"
                                "ReverseOrientation Material \"glass\" Translate 1 1 0 Shape "
                                "\"sphere\" \"float radius\" .3\n"));
  ASSERT_EQ(Photons({"-o", "one.expm"}).status, 0);
  for (const int index : {1, 2, 3}) EXPECT_EQ(Share(index, 3).status, 0);
  ExpectMergedIsThatOfOneProcess(3);
}

TEST_F(PhotonShares, ThatAreMissingAreNamedOrShotAgain) {
  ASSERT_EQ(Photons({"-o", "one.expm"}).status, 0);
  for (const int index : {1, 4}) EXPECT_EQ(Share(index, 5).status, 0);
  EXPECT_EQ(Photons({"--merge", "parts", "--missing"}).out, "2-3,5\n");
  const ProgramResult refused = Photons({"--merge", "parts", "-o", "merged.expm"});
  EXPECT_EQ(refused.status, 3) << refused.err;
  EXPECT_NE(refused.err.find("shares 2-3,5 of the 5 shares are missing"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(Exists("merged.expm"));
  EXPECT_EQ(Photons({"--merge", "parts", "-o", "merged.expm", "--incomplete"}).status, 0);
  EXPECT_TRUE(Read("merged.expm") == Read("one.expm"));
}

TEST_F(PhotonShares, ThatExistAreNotShotAgain) {
  ASSERT_EQ(Share(1, 2).status, 0);
  const std::string part = Read("parts/photons-1-of-2.state");
  EXPECT_NE(Share(1, 2).err.find("exists already"), std::string::npos);
  Write("parts/photons-1-of-2.state", part.substr(0, part.size() / 2));
  const ProgramResult again = Share(1, 2);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("it is replaced"), std::string::npos) << again.err;
  EXPECT_TRUE(Read("parts/photons-1-of-2.state") == part);
}

TEST_F(PhotonShares, ThatAreDamagedOrForeignAreRefused) {
  ASSERT_EQ(Share(1, 1).status, 0);
  const std::string name = "parts/photons-1-of-1.state", part = Read(name);
  for (std::size_t tenth = 0; tenth < 10; ++tenth) {
    Write(name, part.substr(0, part.size() * tenth / 10));
    EXPECT_EQ(Photons({"--merge", "parts", "-o", "merged.expm"}).status, 3) << tenth;
    std::string flipped = part;
    flipped[(flipped.size() - 1) * tenth / 9] ^= 8;
    Write(name, flipped);
    EXPECT_EQ(Photons({"--merge", "parts", "--missing"}).out, "1\n") << tenth;
  }
  Write(name, part);
  const ProgramResult seed = Photons({"--merge", "parts", "-o", "merged.expm", "--seed", "7"});
  EXPECT_EQ(seed.status, 1) << seed.err;
  EXPECT_NE(seed.err.find("--seed is 0 there, 7 here"), std::string::npos) << seed.err;
  Write("room.pbrt",
        Room("\"integer indirectphotons\" 200000 \"integer causticphotons\" 0 ") + "# the same\n");
  EXPECT_EQ(Photons({"--merge", "parts", "-o", "merged.expm"}).status, 0);
  Write("room.pbrt", Room("\"integer indirectphotons\" 190000 \"integer causticphotons\" 0"));
  const ProgramResult other = Photons({"--merge", "parts", "-o", "merged.expm"});
  EXPECT_EQ(other.status, 1) << other.err;
}

TEST_F(PhotonShares, WrongUseIsAnError) {
  for (const Names& wrong :
       {Names{"--shard", "3/2", "-o", "parts"}, Names{"--shard", "1/2"},
        Names{"--shard", "1/2", "--merge", "parts", "-o", "a"}, Names{"--missing", "-o", "a"},
        Names{"--incomplete", "-o", "a"}, Names{"--merge", "parts", "--missing", "-o", "a"}})
    EXPECT_EQ(Photons(wrong).status, 1) << testing::PrintToString(wrong);
  std::filesystem::create_directory(Path("parts"));
  EXPECT_EQ(Photons({"--merge", "parts", "-o", "a"}).status, 3);
  EXPECT_EQ(Photons({"--merge", "none", "-o", "a"}).status, 3);
}

}  // namespace
}  // namespace exphoton
