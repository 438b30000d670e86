// SPDX-License-Identifier: BSD-2-Clause
// resume stops renders at random moments, by signals and by kill -9, and continues them until they
// are complete. The picture must then have the bytes of a render that nothing stopped.
// Usage: resume [--moments N] [--kills N]: the least number of stopped renders of each kind.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/process.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;
constexpr double kPatience = 120;  // seconds

struct Scenario {
  std::string scene;
  Names options;
  std::string Text() const {
    std::string text;
    for (const std::string& word : options) text += word + ' ';
    return text;
  }
};

// Chooses a small scene and how to render it. Renders take about half a second.
class Scenarios {
 public:
  explicit Scenarios(unsigned seed) : engine_(seed) {}

  Scenario Next() {
    const Names integrators{"path", "photonmap", "exphotonmap"};
    const std::string integrator = integrators[std::size_t(count_ % 3)];
    const int mode = count_ / 3 % 4;  // plain, plain, halves, target
    ++count_;
    Scenario scenario;
    scenario.options = {"--reproducible", "--float",    "--quiet",   "--seed",
                        Number(1, 99),    "--nthreads", Number(1, 3)};
    const auto add = [&](const Names& words) {
      scenario.options.insert(scenario.options.end(), words.begin(), words.end());
    };
    if (mode == 2) add({"--two-halves"});
    if (mode == 3) add({"--target-error", integrator == "path" ? ".002" : ".0005"});
    if (engine_() % 2 == 0) add({"--aov", "Albedo,N,light,Variance,samples"});
    if (engine_() % 3 == 0) add({"--cropwindow", ".1,.8,.2,.9"});
    scenario.scene = Scene(integrator, mode == 3 ? 1 : integrator == "path" ? 300 : 12);
    return scenario;
  }

  double Uniform() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  int Signal() {
    const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    return signals[engine_() % 3];
  }

 private:
  std::string Number(int least, int most) {
    return std::to_string(std::uniform_int_distribution<int>(least, most)(engine_));
  }
  std::string Real(double least, double most) {
    return std::to_string(least + (most - least) * Uniform());
  }

  std::string Scene(const std::string& integrator, int samples) {
    const Names filters{"box", "gaussian", "mitchell", "sinc"};
    std::string text =
        "Film \"image\" \"integer xresolution\" " + Number(32, 48) + " \"integer yresolution\" " +
        Number(24, 40) + " \"string filename\" \"out.exr\"\nSampler \"" +
        (engine_() % 3 == 0 ? "random" : "lowdiscrepancy") + "\" \"integer pixelsamples\" " +
        std::to_string(samples) + "\nPixelFilter \"" + filters[engine_() % filters.size()] +
        "\"\nSurfaceIntegrator \"" + integrator + "\"";
    if (integrator != "path")
      text += " \"integer indirectphotons\" 4000 \"integer causticphotons\" 1000";
    if (integrator == "exphotonmap") text += " \"integer finalgathersamples\" 8";
    text +=
        "\nCamera \"perspective\" \"float fov\" 70\nWorldBegin\nAttributeBegin\n"
        "AreaLightSource \"area\" \"color L\" [" +
        Real(5, 20) +
        " 12 9]\nTranslate 0 .9 2 Rotate 90 1 0 0 Shape \"disk\" \"float "
        "radius\" " +
        Real(.2, .5) + "\nAttributeEnd\nMaterial \"matte\" \"color Kd\" [.7 " + Real(.1, .8) +
        " .2]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
        "[-1 -1 0 1 -1 0 1 -1 3 -1 -1 3]\nMaterial \"plastic\"\nShape \"trianglemesh\" "
        "\"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 3 1 -1 3 1 1 3 -1 1 3]\n"
        "Material \"" +
        (engine_() % 2 == 0 ? "glass" : "mirror") + "\" Translate " + Real(-.4, .4) +
        " -.6 2.2 Shape \"sphere\" \"float radius\" .35\nWorldEnd\n";
    return text;
  }

  std::mt19937 engine_;
  int count_ = 0;
};

class Experiment {
 public:
  explicit Experiment(unsigned seed) : scenarios_(seed) {}

  // Renders a new scene with at least one stop by a signal, or by kill -9. Returns a description of
  // the fault, or "".
  std::string Run(bool kills) {
    const TestFolder folder;
    const Scenario scenario = scenarios_.Next();
    WriteFile(folder.File("scene.pbrt"), scenario.scene);
    const ProcessResult whole = Wait(folder, Start(folder, scenario, {}));
    if (whole.status != 0) return "the whole render fails: " + whole.err;
    const std::string expected = ReadFile(folder.File("out.exr"));
    unlink(folder.File("out.exr").c_str());

    Names more;
    if (kills) more = {"--write-every", std::to_string(.02 + .2 * whole.seconds)};
    ProcessResult last;
    for (int stops = 0;; ++stops) {
      // After the first three stops the render may end.
      const double delay = whole.seconds * (stops < 3 ? .2 + .9 * scenarios_.Uniform() : 3);
      const int signal = kills ? SIGKILL : scenarios_.Signal();
      const pid_t process = Start(folder, scenario, more);
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      kill(process, signal);
      last = Wait(folder, process);
      if (last.status == 0) break;
      if (last.status != 128 + signal)
        return "status " + std::to_string(last.status) + ": " + last.err + "\n" + scenario.Text();
      if (stops > 50) return "the render never ends";
      ++stopped_;
      const bool hasState = !ReadFile(folder.File("out.exr.state")).empty();
      continued_ += hasState;
      more.push_back("--resume");
      if (more.size() > 1 && more[more.size() - 2] == "--resume") more.pop_back();
    }
    if (ReadFile(folder.File("out.exr")) != expected)
      return "other bytes than the whole render\n" + scenario.Text() + "\n" + scenario.scene;
    for (const std::string& name : folder.Names())
      if (name.find(".state") != std::string::npos && !kills) return name + " is left";
    return "";
  }

  int Stopped() const { return stopped_; }
  int Continued() const { return continued_; }  // after those that left a state

 private:
  static pid_t Start(const TestFolder& folder, const Scenario& scenario, const Names& more) {
    ProcessCommand command;
    command.words = {std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton", "scene.pbrt"};
    for (const Names* words : {&scenario.options, &more})
      command.words.insert(command.words.end(), words->begin(), words->end());
    command.folder = folder.Path();
    return StartProcess(command);
  }
  static ProcessResult Wait(const TestFolder& folder, pid_t process) {
    return WaitForProcess(process, folder.Path(), kPatience);
  }

  Scenarios scenarios_;
  int stopped_ = 0, continued_ = 0;
};

int Run(int moments, int kills) {
  int faults = 0;
  bool isEnough = true;
  for (const bool byKill : {false, true}) {
    const int wanted = byKill ? kills : moments;
    Experiment experiment(byKill ? 5 : 3);
    int pictures = 0;
    for (; experiment.Stopped() < wanted && pictures < wanted + 20; ++pictures) {
      const std::string fault = experiment.Run(byKill);
      if (fault.empty()) continue;
      ++faults;
      std::printf("picture %d: %s\n", pictures, fault.c_str());
    }
    std::printf("%s: %d renders stopped, %d of them left a state, %d pictures\n",
                byKill ? "kill -9" : "signals", experiment.Stopped(), experiment.Continued(),
                pictures);
    isEnough &= experiment.Stopped() >= wanted && experiment.Continued() * 2 >= wanted;
  }
  std::printf("%d faults\n", faults);
  return faults == 0 && isEnough ? 0 : 1;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) {
  int moments = 6, kills = 4;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--moments")) moments = std::atoi(argv[i + 1]);
    if (!std::strcmp(argv[i], "--kills")) kills = std::atoi(argv[i + 1]);
  }
  return exphoton::Run(moments, kills);
}
