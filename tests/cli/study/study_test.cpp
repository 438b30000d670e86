// SPDX-License-Identifier: BSD-2-Clause
// These tests run studies as a user does. They check the folder of results, continuation after an
// interruption, identical pictures in a second study, and a page that loads nothing from outside.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <thread>

#include "core/app/analysis/results.h"
#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

class StudyTest : public ProgramTest {
 protected:
  StudyTest() {
    Write("box.pbrt", SmallScene("Sampler \"random\" \"integer pixelsamples\" 4",
                                 "Translate 0 -1 4 Shape \"disk\" \"float radius\" 9 "
                                 "Translate 0 1 -4"));
  }
  // The options give two integrators with two settings each and three seeds: 12 renders
  // of about 20 ms.
  std::vector<std::string> Options(const std::string& folder) const {
    return {"study",       "box.pbrt",   "--integrators", "directlighting,path",
            "--vary",      "spp=1,4",    "--seeds",       "3",
            "--nthreads",  "1",          "--reference",   "half-a.exr",
            "--reference", "half-b.exr", "--title",       "box",
            "--out",       folder};
  }
  // The options give a similar study that is slow enough to be interrupted.
  std::vector<std::string> SlowOptions(const std::string& folder) const {
    std::vector<std::string> options{"study",      "box.pbrt",    "--integrators", "path",
                                     "--vary",     "spp=128,192", "--seeds",       "6",
                                     "--nthreads", "1",           "--resolution",  "48x36",
                                     "--no-maps",  "--out",       folder};
    return options;
  }
  void MakeReference() const {
    for (const char* half : {"a", "b"})
      ASSERT_EQ(Run({"box.pbrt", "--integrator", "path", "--spp", "256", "--seed",
                     half[0] == 'a' ? "100" : "101", "--float", "-o",
                     std::string("half-") + half + ".exr"})
                    .status,
                0);
  }
  study::Results ReadResults(const std::string& folder) const {
    return study::FromJson(Read(folder + "/results.json"));
  }
  // Renders the rounds of a reference's first half again, and expects their mean.
  void ExpectMeanOfRounds(const std::string& folder, const std::vector<double>& counts) const {
    const Image half = ReadExr(Path(folder + "/" + ReadResults(folder).reference.a));
    std::vector<double> sums(half.pixels.size());
    double total = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      ASSERT_EQ(Run({"low.pbrt", "--integrator", "path", "--spp", std::to_string(int(counts[i])),
                     "--footprint-spp", "16", "--seed",
                     std::to_string(study::ReferenceSeed(int(i), 0)), "--float", "-o", "round.exr"})
                    .status,
                0);
      const Image round = ReadExr(Path("round.exr"));
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += counts[i] * double(round.pixels[k]);
      total += counts[i];
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
      EXPECT_NEAR(double(half.pixels[k]), sums[k] / total, 1e-5);
  }
  // Returns the bytes of every picture of a study, in the order of its rows.
  std::vector<std::string> Pictures(const std::string& folder) const {
    std::vector<std::string> bytes;
    for (const study::RunRow& row : ReadResults(folder).runs)
      bytes.push_back(Read(folder + "/" + row.image));
    return bytes;
  }
  std::size_t CountFiles(const std::string& folder, const std::string& end) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(Path(folder)))
      count += entry.path().string().ends_with(end);
    return count;
  }
};

TEST_F(StudyTest, MakesRowsPicturesAndAPage) {
  MakeReference();
  const ProgramResult result = Run(Options("out"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, 7), "On box,") << result.out;
  EXPECT_NE(result.err.find("[12/12] path, spp=4, seed 3"), std::string::npos) << result.err;
  const study::Results results = ReadResults("out");
  EXPECT_EQ(results.settings.size(), 4u);
  ASSERT_EQ(results.runs.size(), 12u);
  for (const study::RunRow& row : results.runs) {
    EXPECT_GT(row.wallSeconds, 0);
    EXPECT_GT(row.peakMemory, 1e6);
    EXPECT_FALSE(row.phases.empty());
    EXPECT_EQ(ReadExr(Path("out/" + row.image)).Width(), 8);
  }
  const std::string csv = Read("out/results.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  const std::string summary = Read("out/summary.csv");
  EXPECT_EQ(std::count(summary.begin(), summary.end(), '\n'), 5) << summary;
  EXPECT_NE(summary.find("\r\npath,path,spp=4,3,"), std::string::npos) << summary;
  EXPECT_NE(csv.find("relMSE,trimmedRelMSE,MSE"), std::string::npos) << csv.substr(0, 500);
}

TEST_F(StudyTest, ShowsThePhasesInTheOrderOfARender) {
  const auto result = Run({"study", "box.pbrt", "--integrators", "exphotonmap", "--seeds", "2",
                           "--nthreads", "1", "--resolution", "8x6", "--no-maps", "--set",
                           "SurfaceIntegrator.indirectphotons=1000", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string page = Read("out/report.html");
  std::size_t at = 0;
  for (const char* phase : {"accelerator", "shoot", "photon maps", "radiance", "render", "write"}) {
    const std::size_t next = page.find("\"></i>" + std::string(phase) + "</span>", at);
    EXPECT_NE(next, std::string::npos) << phase << " is missing or too early";
    at = next;
  }
}

// The pictures of one sample a pixel are the cheapest, and their times are noise.
TEST_F(StudyTest, ShowsMapsOfASettingThatIsAccurate) {
  MakeReference();
  ASSERT_EQ(Run({"study", "box.pbrt", "--integrators", "path", "--vary", "spp=1,16,64", "--seeds",
                 "2", "--reference", "half-a.exr", "--reference", "half-b.exr", "--out", "out"})
                .status,
            0);
  const study::Results results = ReadResults("out");
  ASSERT_FALSE(results.maps.empty());
  EXPECT_NE(results.maps[0].title.find("(path, spp="), std::string::npos) << results.maps[0].title;
  EXPECT_EQ(results.maps[0].title.find("spp=1)"), std::string::npos) << results.maps[0].title;
  EXPECT_TRUE(results.maps[0].image.ends_with("_maps.exr")) << results.maps[0].image;
}

TEST_F(StudyTest, ThePageHoldsEverythingItShowsAndNoScript) {
  MakeReference();
  ASSERT_EQ(Run(Options("out")).status, 0);
  const std::string page = Read("out/report.html");
  for (const char* part : {"<h1>On box,", "<svg class=\"chart wide\"", "data:image/png;base64,",
                           "What each second bought", "Price list", "prefers-color-scheme:dark",
                           "@media print", "width=device-width"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* part : {"http:", "https:", "<script", "url(", "@import", "javascript:", "NaN<"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  for (std::size_t at = 0; (at = page.find(" src=", at)) != std::string::npos; ++at)
    EXPECT_EQ(page.substr(at, 10), " src=\"data");
}

TEST_F(StudyTest, DoesNotRepeatWhatIsDone) {
  MakeReference();
  ASSERT_EQ(Run(Options("out")).status, 0);
  const std::string rows = Read("out/results.csv"), page = Read("out/report.html");
  const ProgramResult again = Run(Options("out"));
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.err.find("12 renders existed already"), std::string::npos) << again.err;
  EXPECT_EQ(Read("out/results.csv"), rows);
  EXPECT_EQ(Read("out/report.html"), page);
  fs::remove(Path("out/report.html"));
  EXPECT_EQ(Run({"report", "out"}).status, 0);
  EXPECT_EQ(Read("out/report.html"), page);
}

TEST_F(StudyTest, GoesOnAfterAnInterruptionWithTheSamePictures) {
  ASSERT_EQ(Run(SlowOptions("whole")).status, 0);
  const pid_t process = Start(SlowOptions("broken"));
  ASSERT_TRUE(WaitForMessage("[2/12]"));
  kill(process, SIGINT);
  const ProgramResult stopped = Wait(process);
  EXPECT_EQ(stopped.status, 128 + SIGINT);
  EXPECT_NE(stopped.err.find("goes on where this stopped"), std::string::npos) << stopped.err;
  EXPECT_LT(CountFiles("broken/images", ".json"), 12u);
  const ProgramResult again = Run(SlowOptions("broken"));
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("renders existed already"), std::string::npos) << again.err;
  EXPECT_EQ(Pictures("broken"), Pictures("whole"));
}

TEST_F(StudyTest, GoesOnAfterItWasKilled) {
  const pid_t process = Start(SlowOptions("out"));
  ASSERT_TRUE(WaitForMessage("[3/12]"));
  kill(process, SIGKILL);
  EXPECT_EQ(Wait(process).status, 128 + SIGKILL);
  EXPECT_EQ(Run(SlowOptions("out")).status, 0);
  EXPECT_EQ(ReadResults("out").runs.size(), 12u);
  for (const auto& entry : fs::directory_iterator(Path("out")))
    EXPECT_NE(entry.path().filename().string().substr(0, 7), "running");
}

// Returns the number of processes whose working folder is this one.
int CountProcessesIn(const std::string& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code error;  // a process of another user, or one that has ended
    count += fs::read_symlink(entry.path() / "cwd", error) == folder;
  }
  return count;
}

// A render of a hundred thousand samples would go on for minutes.
TEST_F(StudyTest, EndsItsRenderWhereItIsKilled) {
  std::vector<std::string> options = SlowOptions("out");
  *std::ranges::find(options, "spp=128,192") = "spp=100000";
  const std::string folder = fs::canonical(Path("."));
  const pid_t process = Start(options);
  const auto waitUntil = [&](const auto& isTrue) {
    for (int i = 0; i < 600 && !isTrue(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return isTrue();
  };
  EXPECT_TRUE(waitUntil([&] { return CountProcessesIn(folder) == 2; })) << "nothing is rendered";
  kill(process, SIGKILL);
  Wait(process);
  EXPECT_TRUE(waitUntil([&] { return CountProcessesIn(folder) == 0; })) << "the render goes on";
}

TEST_F(StudyTest, RendersADamagedPictureAgain) {
  MakeReference();
  ASSERT_EQ(Run(Options("out")).status, 0);
  const std::vector<std::string> pictures = Pictures("out");
  Write("out/" + ReadResults("out").runs[5].image, "no picture");
  const ProgramResult again = Run(Options("out"));
  EXPECT_NE(again.err.find("11 renders existed already"), std::string::npos) << again.err;
  EXPECT_EQ(Pictures("out"), pictures);
}

TEST_F(StudyTest, ASceneThatChangedIsRenderedAnew) {
  ASSERT_EQ(
      Run({"study", "box.pbrt", "--integrators", "path", "--seeds", "1", "--out", "out"}).status,
      0);
  const std::vector<std::string> before = Pictures("out");
  Write("box.pbrt", SmallScene("", "Scale 2 2 2"));
  const ProgramResult again =
      Run({"study", "box.pbrt", "--integrators", "path", "--seeds", "1", "--out", "out"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.err.find("there already"), std::string::npos) << again.err;
  EXPECT_NE(Pictures("out"), before);
}

TEST_F(StudyTest, WithoutAReferenceSpeaksOfNoiseOnly) {
  const ProgramResult result =
      Run({"study", "box.pbrt", "--integrators", "path", "--vary", "spp=1,4", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(Read("out/report.html").find("bias is not included"), std::string::npos);
}

TEST_F(StudyTest, MakesAReferenceInTwoHalvesAndGoesOnWithIt) {
  const std::vector<std::string> options{"study",
                                         "box.pbrt",
                                         "--integrators",
                                         "path",
                                         "--vary",
                                         "spp=1,4",
                                         "--no-maps",
                                         "--make-reference",
                                         "path",
                                         "--reference-time",
                                         "1s",
                                         "--seeds",
                                         "2",
                                         "--out",
                                         "out"};
  const ProgramResult first = Run(options);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.err.find("reference: "), std::string::npos) << first.err;
  EXPECT_EQ(CountFiles("out/reference", ".exr"), 2u);
  const study::ReferenceRecord record = ReadResults("out").reference;
  EXPECT_GT(record.samplesPerPixel, 0);
  EXPECT_NE(Read("out/" + record.a), Read("out/" + record.b));
  const ProgramResult again = Run(options);
  EXPECT_EQ(again.err.find("reference: "), std::string::npos) << again.err;
}

// The sampler rounds each request to a power of two. The first one is 16. A busy machine needs more
// time for another round.
TEST_F(StudyTest, CountsTheRenderedSamplesOfItsReference) {
  Write("low.pbrt", SmallScene("Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 4"));
  for (const std::string seconds : {"0.5", "2", "8", "32"}) {
    const ProgramResult result =
        Run({"study", "low.pbrt", "--integrators", "path", "--vary", "spp=1", "--seeds", "1",
             "--no-maps", "--make-reference", "path", "--reference-time", seconds, "--out", "out"});
    ASSERT_EQ(result.status, 0) << result.err;
    std::istringstream lines(result.err);
    double last = 0;
    int rounds = 0;
    std::vector<double> counts;
    for (std::string line; std::getline(lines, line);) {
      double samples = 0;  // of both halves
      if (std::sscanf(line.c_str(), "reference: %lf samples", &samples) != 1) continue;
      const double added = (samples - last) / 2;
      EXPECT_EQ(std::exp2(std::round(std::log2(added))), added) << line;
      last = samples;
      ++rounds;
      counts.push_back(added);
    }
    EXPECT_EQ(ReadResults("out").reference.samplesPerPixel, last);
    if (rounds >= 3) return ExpectMeanOfRounds("out", counts);
    fs::remove_all(Path("out"));
  }
  ADD_FAILURE() << "32 seconds are not enough for three rounds";
}

TEST_F(StudyTest, QuotesItsIntegratorsBeforeItRenders) {
  MakeReference();
  std::vector<std::string> options = Options("study");
  options.insert(options.end(), {"--predict", "--no-maps"});
  const ProcessResult run = Run(options);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(run.err.find("pilots of path"), run.err.find("path, spp=1"));
  const study::Results results = ReadResults("study");
  ASSERT_EQ(results.predictions.size(), 2u);
  EXPECT_EQ(results.predictions[1].integrator, "path");
  ASSERT_FALSE(results.predictions[1].points.empty()) << results.predictions[1].failure;
  EXPECT_GT(results.predictions[1].points.back().seconds,
            results.predictions[1].points.front().seconds);
  EXPECT_NE(Read("study/report.html").find("Quotes and measurements"), std::string::npos);
}

TEST_F(StudyTest, StopsRendersByTimeForBudgets) {
  const ProgramResult result = Run({"study", "box.pbrt", "--integrators", "path", "--budgets",
                                    "0.1,0.3s", "--seeds", "2", "--no-maps", "--out", "out"});
  ASSERT_EQ(result.status, 0) << result.err;
  const study::Results results = ReadResults("out");
  ASSERT_EQ(results.settings.size(), 2u);
  EXPECT_EQ(results.settings[1].Text(), "time=0.3");
  EXPECT_GT(results.runs[1].samplesPerPixel, results.runs[0].samplesPerPixel);
}

TEST_F(StudyTest, ReadsStudyFilesWithPathsOfTheirOwnFolder) {
  fs::create_directories(Path("sub"));
  fs::rename(Path("box.pbrt"), Path("sub/box.pbrt"));
  Write("sub/small.study",
        "# a comment\nscene box.pbrt\nseeds 2\nsetting one bounce: path maxdepth=1 spp=2\n"
        "setting five: path maxdepth=5 spp=2\nno-maps\n");
  const ProgramResult result = Run({"study", "sub/small.study", "--seeds", "1", "--out", "out"});
  EXPECT_EQ(result.status, 0) << result.err;
  const study::Results results = ReadResults("out");
  EXPECT_EQ(results.seeds, 1);  // the command line takes precedence
  ASSERT_EQ(results.settings.size(), 2u);
  EXPECT_EQ(results.settings[0].label, "one bounce");
}

TEST_F(StudyTest, ThatComeWithTheScenesAreValid) {
  const std::string folder = std::string(EXPHOTON_SOURCE_DIR) + "/scenes/skylight-room/";
  const ProgramResult accuracy = Run({"study", folder + "accuracy.study", "--plan"});
  ASSERT_EQ(accuracy.status, 0) << accuracy.err;
  for (const char* integrator : {"exphotonmap", "photonmap", "path", "directlighting", "guidedpath",
                                 "bidirectional", "igi", "irradiancecache"}) {
    int settings = 0;
    const std::string start = "\n" + std::string(integrator) + ": exphoton render";
    for (std::size_t at = 0; (at = accuracy.out.find(start, at)) != std::string::npos; ++at)
      ++settings;
    EXPECT_GE(settings, 4) << accuracy.out;
  }
  EXPECT_EQ(Run({"study", folder + "maps.study", "--plan"}).status, 0);
  const ProgramResult ablation = Run({"study", folder + "ablation.study", "--plan"});
  EXPECT_TRUE(ablation.out.starts_with("photonmap: exphoton render ")) << ablation.err;
  EXPECT_NE(
      ablation.out.find("\n68 renders of 128 x 96 pixels (17 settings, 4 seeds each), about "),
      std::string::npos)
      << ablation.out;
  EXPECT_EQ(Files(), (std::vector<std::string>{"box.pbrt"}));
}

TEST_F(StudyTest, SaysWhatIsWrong) {
  EXPECT_EQ(Run({"study"}).status, 1);
  EXPECT_EQ(Run({"study", "box.pbrt"}).status, 1);
  EXPECT_EQ(Run({"study", "none.pbrt", "--out", "out"}).status, 3);
  EXPECT_EQ(Run({"study", "none.study", "--out", "out"}).status, 3);
  EXPECT_EQ(Run({"study", "box.pbrt", "--integrators", "nosuch", "--out", "out"}).status, 2);
  const ProgramResult unknown = Run({"study", "box.pbrt", "--vary", "nosuch=1", "--out", "out"});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find("\"nosuch\""), std::string::npos) << unknown.err;
  EXPECT_EQ(Run({"report", "out"}).status, 3);
  const ProgramResult value =
      Run({"study", "box.pbrt", "--integrators", "path", "--vary", "maxdepth=-3", "--out", "out"});
  EXPECT_EQ(value.status, 1) << value.err;
  EXPECT_NE(value.err.find("between 0 and 10000, not -3"), std::string::npos) << value.err;
}

}  // namespace
}  // namespace exphoton
