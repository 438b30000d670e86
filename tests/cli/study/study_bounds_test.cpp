// SPDX-License-Identifier: BSD-2-Clause
// These tests run studies of photon integrators. Lower bounds of their times come from renders with
// one camera sample and one gather ray a pixel. Certificates state their errors.
#include <filesystem>

#include "core/app/analysis/results.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class StudyBoundsTest : public ProgramTest {
 protected:
  StudyBoundsTest() { Write("room.pbrt", SmallRoom()); }
  ProgramResult Study(const std::string& integrators, const Words& more = {}) const {
    Words words{"study",   "room.pbrt", "--integrators", integrators, "--vary",    "spp=2,4",
                "--seeds", "2",         "--nthreads",    "1",         "--no-maps", "--out",
                "out"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
  static double GatherRays(const study::RunRow& row) {
    for (const auto& [kind, count] : row.rays)
      if (kind == "gather") return count;
    return 0;
  }
  void MakeReference() const {
    for (const std::string half : {"a", "b"})
      ASSERT_EQ(Run({"room.pbrt", "--integrator", "guidedpath", "--spp", "64", "--footprint-spp",
                     "16", "--seed", half == "a" ? "1001" : "1002", "--float", "-o", half + ".exr"})
                    .status,
                0);
  }
  study::Results ReadResults() const { return study::FromJson(Read("out/results.json")); }
};

TEST_F(StudyBoundsTest, StateTheDistanceOfEachPhotonIntegrator) {
  const ProgramResult result = Study("path,photonmap,exphotonmap");
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* part :
       {"exphotonmap takes ", " times the lower bound of ", ", photonmap ", " times its own of ",
        " The lower bound is the time of the photon maps, one camera sample and one gather ray a "
        "pixel.\n"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  EXPECT_NE(Read("out/report.html").find(" times the lower bound of "), std::string::npos);
  const study::Results results = ReadResults();
  EXPECT_EQ(results.runs.size(), 12u);
  ASSERT_EQ(results.lowerBounds.size(), 2u);
  for (const study::LowerBound& bound : results.lowerBounds) {
    EXPECT_GT(bound.cpuSeconds, 0);
    for (const study::RunRow& row : results.runs)
      if (row.setting == bound.setting) EXPECT_LT(bound.cpuSeconds, 3 * row.cpuSeconds);
    const std::string name = results.settings[bound.setting].integrator +
                             "_spp=1_finalgathersamples=1_sharedgather=false_edgesamples=1_seed=";
    for (const char* seed : {"1", "2"}) {
      const study::RunRow row = study::RowFromJson(Read("out/bounds/" + name + seed + ".json"));
      EXPECT_EQ(row.samplesPerPixel, 1);
      EXPECT_EQ(row.Counter("render/camera samples"), 24 * 16);
      EXPECT_GT(GatherRays(row), 0);
      EXPECT_LE(GatherRays(row), 24 * 16);
    }
  }
}

TEST_F(StudyBoundsTest, AreFoundAgainAndAreInReports) {
  const ProgramResult first = Study("exphotonmap");
  ASSERT_EQ(first.status, 0) << first.err;
  const std::string results = Read("out/results.json"), page = Read("out/report.html");
  const ProgramResult again = Study("exphotonmap");
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(Read("out/results.json"), results);
  EXPECT_EQ(Run({"report", "out"}).out, first.out);
  EXPECT_EQ(Read("out/report.html"), page);
}

TEST_F(StudyBoundsTest, AreMeasuredWhereThereAreGatherRays) {
  ASSERT_EQ(Study("path,directlighting").status, 0);
  EXPECT_TRUE(ReadResults().lowerBounds.empty());
  EXPECT_EQ(Read("out/report.html").find("lower bound"), std::string::npos);
  const ProgramResult maps = Study("photonmap", {"--set", "SurfaceIntegrator.finalgather=false"});
  ASSERT_EQ(maps.status, 0) << maps.err;
  EXPECT_EQ(maps.out.find("lower bound"), std::string::npos) << maps.out;
  EXPECT_FALSE(Exists("out/bounds"));
}

TEST_F(StudyBoundsTest, CountInPlans) {
  const std::string with = Study("exphotonmap,path", {"--plan"}).out;
  EXPECT_NE(with.find("8 renders of 24 x 16 pixels"), std::string::npos) << with;
  EXPECT_NE(with.find("\nat most 2 more renders for lower bounds of the time, about "),
            std::string::npos)
      << with;
  EXPECT_TRUE(with.ends_with(" in all\n")) << with;
  EXPECT_EQ(Study("path", {"--plan"}).out.find("lower bounds"), std::string::npos);
}

class StudyCertificatesTest : public StudyBoundsTest {};

TEST_F(StudyCertificatesTest, AreBesideTheMeasuredErrors) {
  MakeReference();
  const Words reference{"--reference", "a.exr", "--reference", "b.exr"};
  Words certified = reference;
  certified.push_back("--certify");
  const ProgramResult result = Study("exphotonmap,path", certified);
  ASSERT_EQ(result.status, 0) << result.err;
  const study::Results results = ReadResults();
  ASSERT_EQ(results.runs.size(), 8u);
  for (const study::RunRow& row : results.runs) {
    const bool isCertified = results.settings[row.setting].integrator == "exphotonmap";
    EXPECT_EQ(row.command.find(" --certify") != std::string::npos, isCertified) << row.command;
    EXPECT_EQ(row.certificate.empty(), !isCertified);
    if (isCertified) EXPECT_GT(study::ValueOf(row.certificate, "noise"), 0);
    if (isCertified) EXPECT_GT(study::ValueOf(row.certificate, "blockWidth"), 0);
  }
  ASSERT_EQ(results.lowerBounds.size(), 1u);
  EXPECT_EQ(results.lowerBounds[0].command.find("--certify"), std::string::npos);
  EXPECT_NE(Read("out/results.csv").find(",certificate: error,"), std::string::npos);
  const std::string page = Read("out/report.html");
  for (const char* text : {"<h2>Certificates</h2>", " of 4 intervals contain the measured bias",
                           "<b>with certificates</b><span>are 4 of the renders"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(Run({"report", "out"}).status, 0);
  EXPECT_EQ(Read("out/report.html"), page);
  // Renders with and without a certificate are different renders.
  EXPECT_NE(Study("exphotonmap,path", certified).err.find("8 renders existed already"),
            std::string::npos);
  const ProgramResult plain = Study("exphotonmap,path", reference);
  EXPECT_NE(plain.err.find("4 renders existed already"), std::string::npos) << plain.err;
  EXPECT_EQ(Read("out/report.html").find("ertificate"), std::string::npos);
}

TEST_F(StudyCertificatesTest, CountInPlans) {
  const std::string plan = Study("exphotonmap,path", {"--certify", "--plan"}).out;
  EXPECT_NE(plan.find("(4 settings, 2 seeds each, 4 with certificates)"), std::string::npos)
      << plan;
  EXPECT_NE(plan.find("--reproducible --certify\n"), std::string::npos) << plan;
  EXPECT_NE(plan.find("--reproducible\n"), std::string::npos) << plan;
}

TEST_F(StudyCertificatesTest, NeedFinalGather) {
  const auto isRefused = [&] {
    const ProgramResult result = Study("exphotonmap,path", {"--certify"});
    return result.status == 1 &&
           result.err.find("no setting of the study has a certificate") != std::string::npos;
  };
  std::string scene = Read("room.pbrt");
  scene.replace(scene.find("WorldBegin"), 0, "\"bool finalgather\" \"false\"\n");
  Write("room.pbrt", scene);
  EXPECT_TRUE(isRefused());
  const ProgramResult other =
      Study("exphotonmap", {"--certify", "--plan", "--set", "SurfaceIntegrator.finalgather=true"});
  EXPECT_NE(other.out.find(", 4 with certificates)"), std::string::npos) << other.err;
}

// A render and a reference with the same seed have noise in common.
TEST_F(StudyBoundsTest, AReferenceWithASeedOfTheStudyGivesAWarning) {
  for (const std::string seed : {"2", "3"}) {
    ASSERT_EQ(Run({"room.pbrt", "--integrator", "guidedpath", "--spp", "4", "--seed", seed,
                   "--float", "-o", "half.exr"})
                  .status,
              0);
    const ProgramResult result = Study("guidedpath", {"--reference", "half.exr"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("half.exr\" was rendered with seed 2") != std::string::npos,
              seed == "2")
        << result.err;
    fs::remove_all(Path("out"));
  }
}

}  // namespace
}  // namespace exphoton
