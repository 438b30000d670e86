// SPDX-License-Identifier: BSD-2-Clause
// signals sends signals at random moments of renders and studies. The picture must then be the
// older one or a complete new one, no temporary file may be left, and a study must be able to
// continue.
// Usage: signals [--moments N], the number of moments for each signal that ends a process.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/imaging/files/exr.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
constexpr double kPatience = 60;  // seconds

std::vector<int> FatalSignals() {
  std::vector<int> signals;
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    switch (signal) {
      case SIGKILL:
      case SIGSTOP:
      case SIGTSTP:
      case SIGTTIN:
      case SIGTTOU:
      case SIGCHLD:
      case SIGCONT:
      case SIGURG:
      case SIGWINCH:
      case SIGPIPE:  // the program ignores SIGPIPE and SIGXFSZ
      case SIGXFSZ:
        continue;
      default:
        break;
    }
    // The first and the last realtime signal represent all of them.
    if (signal >= 32 && signal != SIGRTMIN && signal != SIGRTMAX) continue;
    signals.push_back(signal);
  }
  return signals;
}

bool AsksToStop(int signal) { return signal == SIGINT || signal == SIGTERM || signal == SIGHUP; }

// Returns a large picture of cheap pixels, so writing files takes much of the time.
std::string RenderScene() {
  return "Film \"image\" \"integer xresolution\" 320 \"integer yresolution\" 240 \"string "
         "filename\" \"out.exr\"\nAccelerator \"bruteforce\"\nCamera \"perspective\"\nSampler "
         "\"lowdiscrepancy\" \"integer pixelsamples\" 1\nPixelFilter "
         "\"box\"\nWorldBegin\nLightSource "
         "\"point\"\nTranslate 0 0 4 Shape \"sphere\"\nWorldEnd\n";
}

class Experiment {
 public:
  explicit Experiment(unsigned seed) : engine_(seed) {
    WriteFile(folder_.File("scene.pbrt"), RenderScene());
    Image older(1, 1, {"R", "G", "B"});
    older.attributes["software"] = std::string("exphoton 0");
    WriteExr(folder_.File("older.exr"), older, false);
    ResetRender();
    renderSeconds_ = RunProcess(Command(kRender)).seconds;
    studySeconds_ = RunProcess(Command(kStudy)).seconds;
    fs::remove_all(folder_.File("study"));
  }

  // Returns a description of the fault, or "" if there is none.
  std::string RenderWith(int signal) {
    ResetRender();
    const ProcessResult result = Interrupt(Command(kRender), signal, renderSeconds_);
    for (const std::string& name : folder_.Names())
      if (name != "study" && name != "scene.pbrt" && name != "older.exr" && name != "out.exr" &&
          name != "p.png" && name != "s.json" &&
          !((name == "out.partial.exr" || name == "out.exr.state") && AsksToStop(signal)))
        return name + " is left";
    if (result.status != 0 && result.status != 128 + signal)
      return "status " + std::to_string(result.status) + "\n" + result.err;
    const std::string picture = ReadFile(folder_.File("out.exr"));
    if (picture == ReadFile(folder_.File("older.exr"))) return Partial(result, signal);
    return Width("out.exr") == 320 ? "" : "the picture is neither the older nor a new one";
  }

  std::string StudyWith(int signal) {
    const ProcessResult result = Interrupt(Command(kStudy), signal, studySeconds_);
    const fs::path study = folder_.File("study");
    if (fs::exists(study)) {
      for (const auto& entry : fs::recursive_directory_iterator(study)) {
        const std::string name = entry.path().filename();
        if (entry.is_directory()) continue;
        if (name.ends_with(".partial") || entry.path().parent_path().filename() == "running")
          return entry.path().string() + " is left";
      }
    }
    if (result.status != 0 && result.status != 128 + signal)
      return "status " + std::to_string(result.status) + "\n" + result.err;
    if (++studies_ % 10 == 0) {
      const ProcessResult again = RunProcess(Command(kStudy));
      if (again.status != 0) return "the study does not go on: " + again.err;
      fs::remove_all(study);
    }
    return "";
  }

  int Ended() const { return ended_; }  // number of runs that a signal ended

 private:
  enum Kind { kRender, kStudy };

  ProcessCommand Command(Kind kind) const {
    ProcessCommand command;
    command.words = {std::string(EXPHOTON_BINARY_DIR) + "/bin/exphoton"};
    const Names render{"scene.pbrt", "--quiet", "--float",      "--nthreads", "1",
                       "--preview",  "p.png",   "--stats-json", "s.json"};
    const Names study{"study",   "scene.pbrt", "--integrators", "path,directlighting",
                      "--seeds", "2",          "--no-maps",     "--resolution",
                      "64x48",   "--quiet",    "--nthreads",    "1",
                      "--out",   "study"};
    const Names& words = kind == kRender ? render : study;
    command.words.insert(command.words.end(), words.begin(), words.end());
    command.folder = folder_.Path();
    return command;
  }

  void ResetRender() const {
    for (const char* name : {"out.exr", "out.partial.exr", "out.exr.state", "p.png", "s.json"})
      fs::remove(folder_.File(name));
    fs::copy_file(folder_.File("older.exr"), folder_.File("out.exr"));
  }

  // Half of the moments are late, when files are written.
  ProcessResult Interrupt(const ProcessCommand& command, int signal, double seconds) {
    std::uniform_real_distribution<double> any(0, 1.1);
    const bool isLate = engine_() % 2 == 0;
    const double share = isLate ? .6 + .45 * any(engine_) : any(engine_);
    const pid_t process = StartProcess(command);
    std::this_thread::sleep_for(std::chrono::duration<double>(share * seconds));
    kill(process, signal);
    const ProcessResult result = WaitForProcess(process, command.folder, kPatience);
    ended_ += result.status == 128 + signal;
    return result;
  }

  int Width(const std::string& name) const {
    try {
      return ReadExr(folder_.File(name)).Width();
    } catch (const std::exception&) {
      return -1;
    }
  }

  // An interrupted run may leave the older picture, but its partial picture must be readable.
  std::string Partial(const ProcessResult& result, int signal) const {
    if (result.status == 0) return "status 0, and the older picture is there";
    if (AsksToStop(signal) && fs::exists(folder_.File("out.partial.exr")) &&
        Width("out.partial.exr") != 320)
      return "the interrupted picture cannot be read";
    return "";
  }

  const TestFolder folder_;
  std::mt19937 engine_;
  double renderSeconds_ = 0, studySeconds_ = 0;
  int studies_ = 0, ended_ = 0;
};

int Run(int moments) {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  int count = 0, faults = 0;
  Experiment experiment(7);
  for (int i = 0; i < moments; ++i) {
    for (const int signal : FatalSignals()) {
      const bool isStudy = (i + signal) % 3 == 0;
      const std::string fault =
          isStudy ? experiment.StudyWith(signal) : experiment.RenderWith(signal);
      ++count;
      if (fault.empty()) continue;
      ++faults;
      std::printf("signal %d (%s), moment %d, %s: %s\n", signal, strsignal(signal), i,
                  isStudy ? "study" : "render", fault.c_str());
    }
  }
  std::printf("%d signals of %zu kinds: %d runs ended by them, %d faults\n", count,
              FatalSignals().size(), experiment.Ended(), faults);
  return faults == 0 && experiment.Ended() * 4 > count ? 0 : 1;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) {
  int moments = 3;
  for (int i = 1; i + 1 < argc; i += 2)
    if (!std::strcmp(argv[i], "--moments")) moments = std::atoi(argv[i + 1]);
  return exphoton::Run(moments);
}
