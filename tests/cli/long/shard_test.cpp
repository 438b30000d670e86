// SPDX-License-Identifier: BSD-2-Clause
// These tests render pictures in shards, by processes as a cluster would start them, and compare
// the merged picture with the picture of one process.
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "core/files/state_file.h"
#include "tests/cli/long/names.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class Shards : public ProgramTest {
 protected:
  Shards() { Write("scene.pbrt", Scene()); }

  // A lit sphere over a plane, 60 x 40 pixels.
  static std::string Scene(const std::string& options = "", const std::string& world = "") {
    return SmallScene(
        "Film \"image\" \"integer xresolution\" 60 \"integer yresolution\" 40 " + options, world);
  }
  static Names Command(const Names& more = {}) {
    return Names{"scene.pbrt", "--reproducible", "--nthreads", "2", "--spp", "2"} + more;
  }
  static std::string PartName(int index, int count) {
    return "parts/part-" + std::to_string(index) + "-of-" + std::to_string(count) + ".state";
  }
  ProgramResult RenderPart(int index, int count, const Names& more = {}) const {
    return Run(
        Command({"--shard", std::to_string(index) + "/" + std::to_string(count), "-o", "parts/"}) +
        more);
  }
  void RenderParts(int count, const Names& more = {}) const {
    for (int index = count; index >= 1; --index) {
      const ProgramResult result = RenderPart(index, count, more);
      EXPECT_EQ(result.status, 0) << result.err;
    }
  }
  ProgramResult Merge(const Names& more = {}) const {
    return Run(Names{"merge", "parts/", "-o", "merged.exr"} + more);
  }
  std::string OneMachine(const Names& more = {}) const {
    const ProgramResult result = Run(Command({"-o", "one.exr"}) + more);
    EXPECT_EQ(result.status, 0) << result.err;
    return Read("one.exr");
  }
  std::string Missing() const {
    const ProgramResult result = Run({"merge", "--missing", "parts/"});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }
  void ExpectRefused(int status, const std::string& reason) const {
    const ProgramResult result = Merge();
    EXPECT_EQ(result.status, status) << result.err;
    ExpectIn(reason, result.err);
    EXPECT_FALSE(Exists("merged.exr"));
  }
};

// Parameters of a quick render with photon maps and shared gathers.
const Names kPhotons{"--integrator", "exphotonmap",
                     "--set",        "SurfaceIntegrator.indirectphotons=300",
                     "--set",        "SurfaceIntegrator.causticphotons=0",
                     "--set",        "SurfaceIntegrator.finalgathersamples=4"};

TEST_F(Shards, AnyNumberOfPartsGivesTheBytesOfOneMachine) {
  const std::string one = OneMachine();
  // 12 tiles of 16 x 16 pixels: some of 40 parts are empty.
  for (const int count : {1, 2, 5, 40}) {
    RenderParts(count);
    Names parts{"merge", "-o", "merged.exr"};
    for (int index = 1; index <= count; ++index) parts.push_back(PartName(index, count));
    std::reverse(parts.begin() + 3, parts.begin() + 3 + count / 2);
    const ProgramResult result = Run(parts);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(Read("merged.exr"), one) << count << " parts";
  }
}

TEST_F(Shards, EveryKindOfPictureHasTheBytesOfOneMachine) {
  const Names kinds[] = {
      kPhotons,
      kPhotons +
          Names{"--filter", "mitchell", "--aov", "light,albedo,variance,objectId", "--float"},
      Names{"--filter", "sinc", "--cropwindow", ".2,.7,.3,.9", "--aov", "samples,N"},
      kPhotons + Names{"--two-halves", "--aov", "variance"},
      kPhotons + Names{"--target-error", ".002", "--max-passes", "5", "--aov", "variance,indirect"},
      Names{"--integrator", "bidirectional", "--sampler", "random", "--seed", "7"},
  };
  for (const Names& kind : kinds) {
    const std::string one = OneMachine(kind + Names{"--stats-json", "one.json"});
    for (int index = 1; index <= 3; ++index) RenderPart(index, 3, kind);
    const ProgramResult result = Merge({"--stats-json", "merged.json"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(Read("merged.exr"), one) << testing::PrintToString(kind);
    // Rays and counters are those of one machine, too.
    const auto counts = [this](const std::string& name) {
      const std::string json = Read(name);
      const std::size_t begin = json.find("\"rays\""), end = json.find("\"memory/peak\"");
      EXPECT_LT(begin, end) << json;
      return json.substr(begin, end - begin);
    };
    EXPECT_EQ(counts("merged.json"), counts("one.json"));
    const auto noiseError = [this](const std::string& name) {
      const std::string json = Read(name), key = "\"noiseError\":";
      const std::size_t at = json.find(key);
      return at == json.npos ? 0 : std::stof(json.substr(at + key.size()));
    };
    EXPECT_FLOAT_EQ(noiseError("merged.json"), noiseError("one.json"));
    if (std::ranges::count(kind, "--target-error") > 0) EXPECT_GT(noiseError("merged.json"), 0);
    for (int index = 1; index <= 3; ++index) remove(Path(PartName(index, 3)).c_str());
  }
}

TEST_F(Shards, StopAfterThePassesThatOneMachineNeeds) {
  const Names rule{"--target-error", ".02", "--max-passes", "12"};
  const std::string one = OneMachine(rule);
  RenderParts(2, rule);
  const ProgramResult result = Merge();
  EXPECT_EQ(result.status, 0) << result.err;
  ExpectIn("reached the target error 0.02", result.err);
  EXPECT_EQ(Read("merged.exr"), one);
}

// Passes of 3 shards of a picture for an accuracy, and those of one process. With --keep they share
// their gathers.
TEST_F(Shards, APictureForAnAccuracyHasTheBytesOfOneMachine) {
  const Names scene{"scene.pbrt",   "--reproducible", "--nthreads",   "2", "--accuracy", "10%",
                    "--resolution", "40x30",          "--max-passes", "6"};
  const auto render = [&](const Names& kind, const Names& where) {
    const ProgramResult result = Run(scene + kind + where);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.err;
  };
  const auto error = [](const std::string& messages) {
    const std::size_t at = messages.find("the error lies below");
    return at == messages.npos ? "" : messages.substr(at, messages.find('\n', at) - at);
  };
  const Names kinds[] = {
      {"--integrator", "exphotonmap", "--set", "SurfaceIntegrator.indirectphotons=10000", "--aov",
       "variance,indirect"},
      {"--integrator", "exphotonmap", "--set", "SurfaceIntegrator.indirectphotons=10000", "--keep",
       "--filter", "mitchell", "--cropwindow", ".2,.9,.1,.8"},
      {"--integrator", "path"},
  };
  for (const Names& kind : kinds) {
    const std::string messages = render(kind, {"-o", "one.exr", "--stats-json", "one.json"});
    for (int index = 1; index <= 3; ++index)
      render(kind, {"--shard", std::to_string(index) + "/3", "-o", "parts/"});
    const ProgramResult result = Merge({"--stats-json", "merged.json"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(Read("merged.exr"), Read("one.exr")) << testing::PrintToString(kind);
    EXPECT_NE(error(messages), "") << messages;
    EXPECT_EQ(error(result.err), error(messages));
    // The parts have 6 passes, of which the picture takes fewer.
    ExpectIn("\"stoppedBy\":\"accuracy\"", Read("merged.json"));
    EXPECT_EQ(Read("merged.json").find("\"passes\":6"), std::string::npos);
    const bool hasCertificate = kind[1] != "path";
    EXPECT_EQ(result.err.find("corrected gather rays") != std::string::npos, hasCertificate);
    for (int index = 1; index <= 3; ++index) remove(Path(PartName(index, 3)).c_str());
  }
}

TEST_F(Shards, TooFewPassesForAnAccuracyAreAnnounced) {
  const Names hard{"scene.pbrt", "--nthreads",   "2", "--integrator", "path",   "--accuracy",
                   ".01%",       "--max-passes", "2", "-o",           "one.exr"};
  const ProgramResult result = Run(hard);
  EXPECT_EQ(result.status, 0) << result.err;
  ExpectIn("--max-passes 2 is likely to end the picture before its accuracy of 0.01%", result.err);
  ExpectIn("which is not the accuracy of 0.01 %: the limit of samples or passes came first",
           result.err);
}

TEST_F(Shards, APartThatExistsIsSkipped) {
  RenderParts(2);
  const std::string part = Read(PartName(1, 2));
  const ProgramResult again = RenderPart(1, 2);
  EXPECT_EQ(again.status, 0);
  ExpectIn("exists and is whole: nothing to render", again.err);
  EXPECT_EQ(Read(PartName(1, 2)), part);
  const ProgramResult other = RenderPart(1, 2, {"--seed", "4"});
  EXPECT_EQ(other.status, 1);
  ExpectIn("is a part of another picture: --seed is 0 there, 4 here", other.err);
  EXPECT_EQ(Read(PartName(1, 2)), part);
  Write(PartName(2, 2), "notes that are no state at all");
  const ProgramResult notes = RenderPart(2, 2);
  EXPECT_EQ(notes.status, 3);
  ExpectIn("hint: remove it, or name another folder with -o", notes.err);
  EXPECT_EQ(Read(PartName(2, 2)), "notes that are no state at all");
}

TEST_F(Shards, DamagedPartsAreNamedAndRenderedAgain) {
  const std::string one = OneMachine();
  RenderParts(3);
  const std::string whole = Read(PartName(2, 3));
  for (int i = 0; i < 10; ++i) {
    std::string cut = whole.substr(0, whole.size() * std::size_t(i) / 10);
    Write(PartName(2, 3), cut);
    ExpectRefused(3, "cannot use the part \"" + PartName(2, 3) + "\": it is ");
    EXPECT_EQ(Missing(), "2\n") << i;
    std::string flipped = whole;
    flipped[whole.size() * std::size_t(i) / 10] ^= 8;
    Write(PartName(2, 3), flipped);
    ExpectRefused(3, "cannot use the part \"" + PartName(2, 3) + "\": it ");
    EXPECT_EQ(Missing(), "2\n") << i;
  }
  const ProgramResult again = RenderPart(2, 3);
  EXPECT_EQ(again.status, 0);
  ExpectIn("its checksum does not match; it is rendered again", again.err);
  EXPECT_EQ(Missing(), "");
  const ProgramResult merged = Merge();
  EXPECT_EQ(merged.status, 0);
  ExpectNotIn("it is rendered again", merged.err);
  EXPECT_EQ(Read("merged.exr"), one);
}

TEST_F(Shards, APartWithADamagedBeginningHasToBeRemoved) {
  RenderParts(2);
  Write(PartName(1, 2), std::string(8, '\0') + Read(PartName(1, 2)).substr(8));
  const ProgramResult render = RenderPart(1, 2);
  EXPECT_EQ(render.status, 3);
  ExpectIn("hint: remove it, or name another folder with -o", render.err);
  ExpectNotIn("render this part again", render.err);
  ExpectRefused(3, "part 1 of the 2 parts is missing or unusable");
  ExpectRefused(3, "hint: if it is a part, remove it and render it again");
  EXPECT_EQ(Missing(), "1\n");
  Remove(PartName(1, 2));
  EXPECT_EQ(RenderPart(1, 2).status, 0);
  EXPECT_EQ(Merge().status, 0);
}

TEST_F(Shards, ProblemsThatNoRenderRemovesEndTheListOfMissingParts) {
  const auto expectFailure = [this](int status, const std::string& reason) {
    const ProgramResult result = Run({"merge", "--missing", "parts/"});
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(result.out, "");
    ExpectIn(reason, result.err);
  };
  RenderParts(2);
  RenderPart(2, 3);
  expectFailure(1, "is one of 3 parts, but");
  Remove(PartName(2, 2));
  expectFailure(1, "is one of 3 parts, but");
  Remove(PartName(2, 3));
  RenderPart(2, 2, {"--seed", "5"});
  expectFailure(1, "are parts of different pictures");
  Remove(PartName(2, 2));
  RenderPart(2, 2);
  Write("parts/part-copy.state", Read(PartName(2, 2)).substr(0, 900));
  expectFailure(3, "it is cut off or damaged");
  Remove(PartName(1, 2));
  EXPECT_EQ(Missing(), "1\n");
}

TEST_F(Shards, MissingPartsAreListedForSlurm) {
  for (const int index : {1, 4, 9}) RenderPart(index, 10);
  EXPECT_EQ(Missing(), "2-3,5-8,10\n");
  ExpectRefused(3, "parts 2-3,5-8,10 of the 10 parts are missing or unusable");
  EXPECT_EQ(Run({"merge", "--missing", "--shards", "12", "parts/"}).status, 1);
  const ProgramResult none = Run({"merge", "--missing", "absent/"});
  EXPECT_EQ(none.status, 3);
  mkdir(Path("empty").c_str(), 0700);
  EXPECT_EQ(Run({"merge", "--missing", "empty/"}).status, 3);
  EXPECT_EQ(Run({"merge", "--missing", "--shards", "12", "empty/"}).out, "1-12\n");
}

TEST_F(Shards, PartsOfOtherPicturesAreRefused) {
  RenderParts(2);
  const std::string second = Read(PartName(2, 2));
  remove(Path(PartName(2, 2)).c_str());
  RenderPart(2, 2, {"--seed", "5"});
  ExpectRefused(1, "are parts of different pictures: --seed is 5 there, 0 here");
  remove(Path(PartName(2, 2)).c_str());
  Write("scene.pbrt", Scene("", "LightSource \"point\" \"color I\" [2 2 2]"));
  RenderPart(2, 2);
  ExpectRefused(1, "the scene \"scene.pbrt\" has changed since");
  remove(Path(PartName(2, 2)).c_str());
  Write("scene.pbrt", Scene());
  RenderPart(2, 3);
  ExpectRefused(1, "is one of 3 parts, but \"parts/part-1-of-2.state\" is one of 2");
  remove(Path(PartName(2, 3)).c_str());
  Write(PartName(2, 2), second);
  EXPECT_EQ(Merge().status, 0);
}

// Copies a part with some bytes of its sections replaced.
void Rewrite(const std::string& from, const std::string& to, const std::string& section,
             const std::function<void(std::string*)>& change) {
  const StateFile file(from, StateUse::Part);
  StateWriter writer(to);
  for (const std::string& name : file.Names()) {
    std::string bytes = file.Get(name);
    if (name == section) change(&bytes);
    writer.Add(name, bytes);
  }
  writer.Commit();
}

TEST_F(Shards, DuplicatesMustBeEqual) {
  RenderParts(2);
  Write("parts/part-copy.state", Read(PartName(1, 2)));
  EXPECT_EQ(Run(Command({"--shard", "2/2", "-o", "again/"})).status, 0);
  EXPECT_EQ(Run({"merge", "parts/", "again/", "-o", "merged.exr"}).status, 0);
  EXPECT_EQ(Read("merged.exr"), OneMachine());
  remove(Path("merged.exr").c_str());
  Rewrite(Path(PartName(1, 2)), Path("parts/part-copy.state"), "pass 0 tile 0",
          [](std::string* bytes) { bytes->at(9) ^= 1; });
  ExpectRefused(3, "are the same part with different contents");
}

TEST_F(Shards, AnotherVersionIsRefused) {
  RenderParts(1);
  Rewrite(Path(PartName(1, 1)), Path(PartName(1, 1)), "identity",
          [](std::string* bytes) { bytes->at(bytes->find("exphoton ") + 9) = '9'; });
  ExpectRefused(1, "it is by exphoton 9");
}

TEST_F(Shards, SectionsThatDoNotFitAreErrors) {
  RenderParts(1);
  const std::string whole = Read(PartName(1, 1));
  for (const char* section : {"shard", "part", "identity", "pass 0 tile 3", "pass 0 totals",
                              "pass 0 statistics", "pass 0 non-finite samples"}) {
    Rewrite(Path(PartName(1, 1)), Path(PartName(1, 1)), section,
            [](std::string* bytes) { bytes->resize(bytes->size() / 2); });
    ExpectRefused(3, "its section \"" + std::string(section) + "\" does not fit");
    Write(PartName(1, 1), whole);
  }
}

TEST_F(Shards, AKilledShardLeavesNoPart) {
  RenderPart(1, 2);
  for (const int signal : {SIGKILL, SIGTERM}) {
    const pid_t process =
        Start({"scene.pbrt", "--shard", "2/2", "-o", "parts/", "--spp", "100000"});
    EXPECT_TRUE(WaitForMessage("effects"));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(process, signal);
    EXPECT_NE(Wait(process).status, 0);
    EXPECT_FALSE(Exists(PartName(2, 2)));
    EXPECT_EQ(Missing(), "2\n");
  }
}

TEST_F(Shards, MessagesOfThePartsAppearOnce) {
  Write("scene.pbrt", Scene("Sampler \"random\" \"float wrongname\" [1]"));
  RenderParts(3);
  const ProgramResult result = Merge();
  EXPECT_EQ(result.status, 0) << result.err;
  const std::size_t first = result.err.find("\"wrongname\"");
  EXPECT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("warning: ", result.err.find("warning: ") + 1), std::string::npos)
      << result.err;
}

TEST_F(Shards, UsageErrorsSayWhatToDo) {
  const auto expect = [this](const Names& words, const std::string& text) {
    const ProgramResult result = Run(Names{"scene.pbrt"} + words);
    EXPECT_EQ(result.status, 1) << result.err;
    ExpectIn(text, result.err);
  };
  const Names shard{"--shard", "1/2", "-o", "parts/"};
  for (const char* wrong : {"0/3", "4/3", "1", "a/b", "1/", "/2", "-1/2", "1/200000", "1/2/3"})
    expect({"--shard", wrong, "-o", "parts/"}, "--shard takes I/N");
  expect(shard + Names{"--time-limit", "5s"}, "--shard and --time-limit exclude each other");
  expect(shard + Names{"--target-error", ".1"}, "needs --max-passes N");
  expect(shard + Names{"--accuracy", "5%"}, "--shard with --accuracy needs --max-passes N");
  expect({"--accuracy", "5%", "--max-passes", "1"}, "--accuracy needs --max-passes 2 at least");
  expect(shard + Names{"--max-passes", "3"}, "--max-passes needs --target-error");
  expect({"--target-error", ".1", "--max-passes", "3", "--time-limit", "5s"}, "exclude each other");
  expect(shard + Names{"--resume"}, "--shard excludes --resume");
  expect({"--shard", "1/2"}, "--shard needs -o FOLDER");
  expect({"--shard", "1/2", "-o", "a.exr"}, "-o names the folder of the parts");
  EXPECT_EQ(Run({"merge", "parts/"}).status, 1);
  EXPECT_EQ(Run({"merge", "scene.pbrt", "-o", "a.exr"}).status, 3);
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(Shards, AMergeTakesLessThanTwiceTheMemoryOfThePicture) {
  const Names large{"--resolution", "1600x1200", "--filter", "box"};
  RenderParts(2, large);
  EXPECT_EQ(Merge({"--stats-json", "merged.json"}).status, 0);
  const std::string json = Read("merged.json");
  const std::size_t at = json.find("\"peakMemoryBytes\":");
  ASSERT_NE(at, std::string::npos);
  // A pixel has 72 bytes of sums and 16 of values.
  EXPECT_LT(std::stod(json.substr(at + 18)), 2. * 1600 * 1200 * (72 + 16));
}

}  // namespace
}  // namespace exphoton
