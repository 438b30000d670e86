// SPDX-License-Identifier: BSD-2-Clause
// These tests give a parameter with --set to commands that compare integrators. It applies to
// those that have it.
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class ComparedSets : public ProgramTest {
 protected:
  ComparedSets() { Write("room.pbrt", SmallRoom()); }
};

TEST_F(ComparedSets, LeaveAnAccuracyTheChoiceAmongAllIntegrators) {
  const Names words{"room.pbrt", "--accuracy", "40%", "-o", "room.exr", "--no-progress"};
  Names withSet = words;
  withSet.insert(withSet.end(), {"--set", "SurfaceIntegrator.nused=40"});
  const ProgramResult result = Run(withSet);
  ASSERT_EQ(result.status, 0) << result.err;
  ExpectIn("path: ", result.err);
  ExpectNotIn("unknown parameter", result.err);
  withSet.back() = "SurfaceIntegrator.nuzed=40";
  const ProgramResult wrong = Run(withSet);
  EXPECT_NE(wrong.status, 0);
  ExpectIn("unknown parameter \"nuzed\"", wrong.err);
  ExpectIn("did you mean \"nused\"?", wrong.err);
}

// An integrator that is named alone has no one to share its parameters with.
TEST_F(ComparedSets, AreErrorsForOneIntegrator) {
  const ProgramResult result = Run({"room.pbrt", "--accuracy", "40%", "--integrator", "path",
                                    "--set", "SurfaceIntegrator.nused=40", "-o", "room.exr"});
  EXPECT_NE(result.status, 0);
  ExpectIn("unknown parameter \"nused\" of integrator \"path\"", result.err);
  EXPECT_FALSE(Exists("room.exr"));
}

TEST_F(ComparedSets, AreInQuotedCommandsOfIntegratorsThatHaveThem) {
  const ProgramResult quote =
      Run({"quote", "room.pbrt", "--accuracies", "40%", "--pilot-time", "1s", "--integrators",
           "exphotonmap,path", "--quiet", "--set", "SurfaceIntegrator.nused=40"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  ExpectIn("--integrator exphotonmap --set SurfaceIntegrator.nused=40 --spp", quote.out);
  ExpectIn("--integrator path --spp", quote.out);
}

TEST_F(ComparedSets, AreInRendersOfAStudyWhoseIntegratorsHaveThem) {
  const auto plan = [&](const std::string& set) {
    return Run({"study", "--scene", "room.pbrt", "--integrators", "path,exphotonmap", "--set",
                "SurfaceIntegrator." + set, "--set", "Camera.fov=50", "--plan"});
  };
  const ProgramResult result = plan("nused=40");
  ASSERT_EQ(result.status, 0) << result.err;
  ExpectIn("--integrator exphotonmap --set SurfaceIntegrator.nused=40 --set Camera.fov=50",
           result.out);
  ExpectIn("--integrator path --set Camera.fov=50", result.out);
  const ProgramResult wrong = plan("nuzed=40");
  EXPECT_NE(wrong.status, 0);
  ExpectIn("no integrator of the comparison has a parameter \"nuzed\"", wrong.err);
  ExpectIn("did you mean \"nused\"?", wrong.err);
}

}  // namespace
}  // namespace exphoton
