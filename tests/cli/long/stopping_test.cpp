// SPDX-License-Identifier: BSD-2-Clause
// These tests use stopping rules, renders in two halves, and AOVs from the command
// line, as users do.
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

// Returns a scene with a lamp that casts soft shadows, so that the picture has noise.
std::string NoisyScene(const std::string& integrator = "\"path\"") {
  return "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16 \"string filename\" "
         "\"out.exr\"\nCamera \"perspective\"\nPixelFilter \"box\"\nSurfaceIntegrator " +
         integrator +
         "\nWorldBegin\nAttributeBegin AreaLightSource \"area\" \"color L\" [5 5 5] Translate 0 3 "
         "4 "
         "Shape \"sphere\" \"float radius\" 1 AttributeEnd\nTranslate 0 0 4 Shape \"sphere\"\n"
         "WorldEnd\n";
}

class StoppingTest : public ProgramTest {
 protected:
  ProgramResult RunScene(Names arguments, const std::string& integrator = "\"path\"") {
    Write("scene.pbrt", NoisyScene(integrator));
    arguments.push_back("scene.pbrt");
    return Run(arguments);
  }
  // Waits until the program writes a picture under a temporary name. Returns false if the program
  // ends first.
  bool WaitForPartialFile(pid_t process) const {
    for (siginfo_t ended{}; ended.si_pid == 0;) {
      for (const std::string& name : Files())
        if (name.find(".partial") != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (waitid(P_PID, id_t(process), &ended, WEXITED | WNOHANG | WNOWAIT) != 0) return false;
    }
    return false;
  }
};

TEST_F(StoppingTest, SaysWhatATargetReached) {
  const ProgramResult result =
      RunScene({"--target-error", "0.01", "--stats-json", "s.json", "--stats"});
  EXPECT_EQ(result.status, 0) << result.err;
  ExpectIn("reached the target error 0.01: ", result.err);
  ExpectIn("(bias not included)", result.err);
  ExpectIn("noise ", result.out);
  const std::string json = Read("s.json");
  ExpectIn("\"stoppedBy\":\"target-error\",\"noise\":0.00", json);
  ExpectIn("\"targetError\":0.01", json);
  ExpectIn("\"timeLimit\":null", json);
  ExpectIn("\"aovs\":\"\"", json);
  const auto attributes = ReadExr(Path("out.exr")).attributes;
  EXPECT_EQ(std::get<std::string>(attributes.at("stoppedBy")), "target-error");
  EXPECT_LE(std::get<float>(attributes.at("noise")), .01f);
  EXPECT_GE(std::get<int>(attributes.at("passes")), 2);
}

// Passes of a sampler that cannot go on share the photons too, where these cause little noise.
TEST_F(StoppingTest, ShootsPhotonsOnceWithEverySampler) {
  const std::string photons = "\"photons/shot\":";
  const auto shot = [&](const Names& more) {
    Names words{"--sampler", "stratified", "--stats-json", "s.json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result =
        RunScene(words, "\"exphotonmap\" \"integer indirectphotons\" 20000");
    EXPECT_EQ(result.status, 0) << result.err;
    const std::string text = Read("s.json");
    return std::stod(text.substr(text.find(photons) + photons.size()));
  };
  const double once = shot({"--spp", "4"});
  EXPECT_LT(shot({"--target-error", ".002"}), 1.5 * once);  // another seed needs other paths
  EXPECT_EQ(Read("s.json").find("\"passes\":1,"), std::string::npos);
}

// A picture is multiplied by alpha, so its variance is multiplied by the square of alpha.
TEST_F(StoppingTest, StatesTheVarianceOfThePictureThatItWrites) {
  Write("ball.pbrt", SmallScene("Sampler \"random\" \"integer pixelsamples\" 16"));
  const auto render = [&](const std::string& isPremultiplied) {
    const ProgramResult result = Run({"ball.pbrt", "--two-halves", "--float", "--aov", "Variance",
                                      "--set", "Film.premultiplyalpha=" + isPremultiplied});
    EXPECT_EQ(result.status, 0) << result.err;
    return ReadExr(Path("out.exr"));
  };
  const Image plain = render("false"), multiplied = render("true");
  const int v = plain.FindChannel("variance.G"), a = plain.FindChannel("A");
  int partial = 0;
  for (int y = 0; y < plain.Height(); ++y) {
    for (int x = 0; x < plain.Width(); ++x) {
      const double alpha = plain.At(x, y, a), variance = plain.At(x, y, v);
      partial += alpha > .1 && alpha < .9 && variance > 0;
      EXPECT_NEAR(multiplied.At(x, y, v), variance * alpha * alpha, 1e-5 * variance);
    }
  }
  EXPECT_GE(partial, 3);
}

TEST_F(StoppingTest, GivesEqualFilesForEqualTargets) {
  for (const char* integrator :
       {"\"path\"",
        "\"exphotonmap\" \"integer indirectphotons\" 500 \"integer causticphotons\" 0"}) {
    RunScene({"--target-error", ".01", "--reproducible", "--nthreads", "1"}, integrator);
    const std::string one = Read("out.exr");
    RunScene({"--target-error", ".01", "--reproducible", "--nthreads", "3"}, integrator);
    EXPECT_EQ(one, Read("out.exr"));
  }
}

TEST_F(StoppingTest, StopsInTime) {
  const ProgramResult result =
      RunScene({"--time-limit", "0.3s", "--stats-json", "s.json", "--nthreads", "1"});
  EXPECT_EQ(result.status, 0) << result.err;
  ExpectIn("stopped at the last whole pass within 0.3 s", result.err);
  ExpectIn("\"stoppedBy\":\"time-limit\"", Read("s.json"));
  ExpectIn("\"timeLimit\":0.29999", Read("s.json"));
}

TEST_F(StoppingTest, StopsAtWhicheverComesFirst) {
  RunScene({"--time-limit", "1h", "--target-error", ".05", "--stats-json", "s.json"});
  ExpectIn("\"stoppedBy\":\"target-error\"", Read("s.json"));
  RunScene(
      {"--time-limit", "1h", "--target-error", "1e-9", "--spp", "6", "--stats-json", "s.json"});
  ExpectIn("\"stoppedBy\":\"samples\"", Read("s.json"));
  ExpectIn("\"samplesPerPixel\":6", Read("s.json"));
}

TEST_F(StoppingTest, KeepsThePassesThatAreDoneWhenInterrupted) {
  Write("scene.pbrt", NoisyScene());
  const pid_t process = Start({"scene.pbrt", "--time-limit", "1h", "--nthreads", "1"});
  ASSERT_TRUE(WaitForMessage("effects"));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  ASSERT_EQ(kill(process, SIGINT), 0);
  const ProgramResult result = Wait(process);
  EXPECT_EQ(result.status, 130) << result.err;
  ExpectIn("stopped by a signal", result.err);
  EXPECT_EQ(Files(), (Names{"out.exr.state", "out.partial.exr", "scene.pbrt"}));
}

// The pass that the signal cut off is not in the picture.
TEST_F(StoppingTest, WritesThePictureOfTheWholePassesWhenInterrupted) {
  Write("scene.pbrt", NoisyScene());
  const Names options{"--resolution", "96x64", "--spp", "16", "--target-error", "1e-12", "--float"};
  Names first{"scene.pbrt", "--max-passes", "100000", "--stats-json", "s.json"};
  first.insert(first.end(), options.begin(), options.end());
  const pid_t process = Start(first);
  ASSERT_TRUE(WaitForMessage("effects"));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  ASSERT_EQ(kill(process, SIGINT), 0);
  EXPECT_EQ(Wait(process).status, 130);
  const std::string json = Read("s.json"), key = "\"passes\":";
  const std::size_t place = json.find(key);
  ASSERT_NE(place, std::string::npos) << json;
  const std::string passes = std::to_string(std::atoi(json.c_str() + place + key.size()));
  Names second{"--max-passes", passes, "-o", "whole.exr"};
  second.insert(second.end(), options.begin(), options.end());
  const ProgramResult whole = RunScene(second);
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_EQ(ReadExr(Path("out.partial.exr")).pixels, ReadExr(Path("whole.exr")).pixels) << passes;
}

TEST_F(StoppingTest, WritesTwoHalves) {
  const ProgramResult result = RunScene({"--two-halves", "--float", "--spp", "8"});
  EXPECT_EQ(result.status, 0) << result.err;
  ExpectIn("two independent halves: 8 samples a pixel in 2 passes; noise \u00b1", result.err);
  ExpectIn("(bias not included)", result.err);
  const Image image = ReadExr(Path("out.exr"));
  const int whole = image.FindChannel("R"), one = image.FindChannel("half1.R"),
            two = image.FindChannel("half2.R");
  ASSERT_GE(one, 0);
  ASSERT_GE(two, 0);
  double difference = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 24; ++x) {
      const float a = image.At(x, y, one), b = image.At(x, y, two);
      difference += std::abs(double(a - b));
      if (image.At(x, y, image.FindChannel("A")) < 1) continue;
      EXPECT_NEAR(image.At(x, y, whole), (a + b) / 2, 1e-4 * double(1 + a));
    }
  }
  EXPECT_GT(difference, .1);
}

TEST_F(StoppingTest, WritesLayersInHalfAndFloat) {
  for (const char* format : {"--half", "--float"}) {
    EXPECT_EQ(RunScene({"--aov", "albedo,N,P,variance,light,time,samples", format}).status, 0);
    const Image image = ReadExr(Path("out.exr"));
    for (const char* channel :
         {"R", "A", "albedo.G", "N.Z", "P.X", "variance.B", "emission.R", "direct.G", "caustic.B",
          "indirect.R", "specular.R", "time.ms", "samples.count"})
      EXPECT_GE(image.FindChannel(channel), 0) << channel;
  }
}

// Rows 6 and 7 show the sphere. The last two rows of the window show nothing.
TEST_F(StoppingTest, ScalesTheVarianceBetweenPassesByThePixelsOwnAlpha) {
  EXPECT_EQ(RunScene({"--aov", "variance", "--target-error", "0.01", "--pixelbounds", "0,24,6,16",
                      "--float"})
                .status,
            0);
  const Image image = ReadExr(Path("out.exr"));
  EXPECT_EQ(image.At(12, 1, image.FindChannel("A")), 1);
  EXPECT_EQ(image.At(12, 8, image.FindChannel("A")), 0);
  double sum = 0;
  for (int x = 0; x < 24; ++x)
    for (int y = 0; y < 2; ++y) sum += double(image.At(x, y, image.FindChannel("variance.R")));
  EXPECT_GT(sum, 1e-5);
}

TEST_F(StoppingTest, NamesTheAvailableAovs) {
  ProgramResult result = RunScene({"--aov", "dirct"});
  EXPECT_EQ(result.status, 1);
  ExpectIn("unknown AOV \"dirct\"", result.err);
  ExpectIn("radianceDistance", result.err);
  ExpectIn("direct", result.err);
  result = RunScene({"--aov", "photonDensity,N"});
  EXPECT_EQ(result.status, 1);
  ExpectIn("integrator \"path\" with these parameters has no AOV photonDensity", result.err);
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

TEST_F(StoppingTest, NoticesASampleCountThatIsRounded) {
  ExpectIn("sampler \"lowdiscrepancy\" takes 8 samples a pixel instead of 5",
           RunScene({"--spp", "5"}).err);
}

TEST_F(StoppingTest, CallsAFolderThatIsGoneStatus3) {
  mkdir(Path("gone").c_str(), 0700);
  Write("scene.pbrt", NoisyScene());
  const std::string command =
      "cd '" + Path("gone") + "' && rmdir ../gone && '" + EXPHOTON_BINARY_DIR + "/bin/exphoton' ";
  for (const char* arguments : {"../scene.pbrt", "/nonexistent/x.pbrt", "- </dev/null"}) {
    mkdir(Path("gone").c_str(), 0700);
    const int status = std::system((command + arguments + " 2>'" + Path("message") + "'").c_str());
    EXPECT_GE(WEXITSTATUS(status), 2) << arguments;
    EXPECT_LE(WEXITSTATUS(status), 3) << arguments << Read("message");
  }
}

TEST_F(StoppingTest, LeavesNoPartialFileWhenInterruptedTwice) {
  // The picture is large, so that writing it takes a while.
  Write("scene.pbrt", NoisyScene("\"whitted\""));
  const Names arguments{"scene.pbrt",
                        "--nthreads",
                        "1",
                        "--spp",
                        "1",
                        "--float",
                        "--quiet",
                        "--set",
                        "Film.xresolution=1500",
                        "--set",
                        "Film.yresolution=1500"};
  for (const int delay : {0, 30, 90}) {
    // On a busy machine the program may write the whole picture between two looks at the folder.
    bool wasWriting = false;
    for (int attempt = 0; attempt < 10 && !wasWriting; ++attempt) {
      const pid_t process = Start(arguments);
      wasWriting = WaitForPartialFile(process);
      std::this_thread::sleep_for(std::chrono::milliseconds(delay));
      kill(process, SIGINT);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      kill(process, SIGINT);
      Wait(process);
      for (const std::string& name : Files())
        EXPECT_EQ(name.find(std::to_string(process)), std::string::npos) << name;
    }
    EXPECT_TRUE(wasWriting);
  }
}

}  // namespace
}  // namespace exphoton
