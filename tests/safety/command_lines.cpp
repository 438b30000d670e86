// SPDX-License-Identifier: BSD-2-Clause
// command_lines runs random command lines in a scratch folder. Afterwards every file must be
// unchanged, unless the command line names it as an output, or a scene names it and it was a
// picture of this program. Usage: command_lines [--cases N] [--first N]. Cases have fixed seeds.
// Worker processes call cli::RunProgram directly.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/app/options/app.h"
#include "core/app/output/png_output.h"
#include "core/imaging/files/exr.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  int Below(int n) { return int(engine_() % unsigned(n)); }
  bool OneIn(int n) { return Below(n) == 0; }
  const std::string& Of(const Names& names) { return names[std::size_t(Below(int(names.size())))]; }

 private:
  std::mt19937 engine_;
};

// Returns the content of a folder: the text of each file and the target of each link.
std::map<std::string, std::string> Snapshot(const fs::path& folder) {
  std::map<std::string, std::string> entries;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder);
    if (entry.is_symlink())
      entries[name] = "link to " + fs::read_symlink(entry).string();
    else if (!entry.is_directory())
      entries[name] = ReadFile(entry.path());
  }
  return entries;
}

void WritePicture(const std::string& name, const std::string& software, float value) {
  Image image(2, 2, {"R", "G", "B"});
  image.attributes["software"] = software;
  for (float& pixel : image.pixels) pixel = value;
  WriteExr(name, image, false);
}

// Returns the file at the end of all links, which may be missing. This code is independent of the
// program's code for the same task.
fs::path Target(const fs::path& name) {
  fs::path at = fs::absolute(name);
  for (int i = 0; i < 20 && fs::is_symlink(at); ++i)
    at = fs::weakly_canonical(at.parent_path()) / fs::read_symlink(at);
  return fs::weakly_canonical(at.parent_path()) / at.filename();
}

struct Command {
  Names words{"exphoton"};
  Names outputs;       // named on the command line
  Names sceneOutputs;  // named only by scenes
  Names inputs;
};

// Case is the folder of one case. It is the working folder during the object's lifetime.
class Case {
 public:
  Case(const std::string& folder, unsigned seed) : dice_(seed), folder_(folder) {
    fs::create_directories(folder + "/sub");
    fs::create_directories(folder + "/other");
    fs::current_path(folder);
    WriteFile("inc.pbrt", "Shape \"disk\"\n");
    WriteFile("sub/inc2.pbrt", "Translate 0 0 1\n");
    WriteFile("notes.txt", "my notes\n");
    WriteFile("light.spd", "400 1 700 1\n");
    WriteFile("sub/notes.txt", "more notes\n");
    WritePicture("map.exr", "a camera", .5f);
    WritePicture("own.exr", "exphoton 0.1.0", .25f);
    WritePicture("sub/own.exr", "exphoton 0.1.0", .75f);
    fs::create_symlink("notes.txt", "to-notes");
    fs::create_symlink("../inc.pbrt", "sub/to-inc");
    fs::create_symlink("own.exr", "to-own.exr");
    fs::create_symlink("to-nothing-2", "to-nothing.exr");
    fs::create_symlink("sub/fresh.exr", "to-nothing-2");
    fs::create_symlink("..", "sub/up");
    fs::create_hard_link("inc.pbrt", "hard.pbrt");
    fs::create_hard_link("own.exr", "other/hard-own.exr");
    fs::create_hard_link("notes.txt", "other/hard-notes");
  }
  ~Case() { fs::current_path("/"); }

  Command MakeCommand() {
    const int kind = dice_.Below(20);
    if (kind == 0) return MakeConvert();
    if (kind == 1) return MakeCompare();
    if (kind == 2) return MakePlot();
    return MakeRender();
  }

 private:
  // Returns the name of an existing or a new file, in one of many spellings.
  std::string Name() {
    static const Names kNames{
        "inc.pbrt",    "sub/inc2.pbrt",  "notes.txt",      "light.spd",          "sub/notes.txt",
        "map.exr",     "own.exr",        "sub/own.exr",    "to-notes",           "sub/to-inc",
        "to-own.exr",  "to-nothing.exr", "hard.pbrt",      "other/hard-own.exr", "other/hard-notes",
        "scene0.pbrt", "scene1.pbrt",    "own.partial.exr"};
    static const Names kFresh{"new0.exr",     "new1.exr",   "new2.png",
                              "sub/new3.exr", "fresh.json", "sub/fresh.exr"};
    return Spelt(dice_.OneIn(3) ? dice_.Of(kNames) : dice_.Of(kFresh));
  }

  std::string Spelt(const std::string& name) {
    switch (dice_.Below(7)) {
      case 0:
        return "./" + name;
      case 1:
        return "sub/../" + name;
      case 2:
        return "sub/up/" + name;
      case 3:
        return folder_ + "/" + name;
      case 4:
        return "other/.././sub/up/" + name;
      default:
        return name;
    }
  }

  std::string SceneText(const std::string& picture, Names* inputs) {
    std::string text =
        "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1" +
        (picture.empty() ? "" : " \"string filename\" \"" + picture + "\"") +
        "\nAccelerator \"bruteforce\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 1\n"
        "Camera \"perspective\"\nWorldBegin\nLightSource \"point\"\n";
    const auto reads = [&](int oneIn, const char* before, const char* name, const char* file) {
      if (!dice_.OneIn(oneIn)) return;
      text += before + Spelt(name) + "\"\n";
      inputs->push_back(file);
    };
    reads(2, "Include \"", "inc.pbrt", "inc.pbrt");
    reads(3, "Include \"", "sub/to-inc", "inc.pbrt");
    reads(3, "Include \"", "sub/inc2.pbrt", "sub/inc2.pbrt");
    reads(4, "LightSource \"distant\" \"spectrum L\" \"", "light.spd", "light.spd");
    reads(4, "LightSource \"infinite\" \"string mapname\" \"", "map.exr", "map.exr");
    if (dice_.OneIn(20)) text += "Shpae \"sphere\"\n";
    return text + "WorldEnd\n";
  }

  Command MakeRender() {
    Command command;
    const int scenes = dice_.OneIn(3) ? 2 : 1;
    const bool isNamed = scenes == 1 && dice_.OneIn(2);
    for (int i = 0; i < scenes; ++i) {
      const std::string name = "scene" + std::to_string(i) + ".pbrt";
      std::string text;
      for (int world = dice_.OneIn(6) ? 2 : 1; world > 0; --world) {
        const std::string picture = dice_.OneIn(8) ? "" : Name();
        text += SceneText(picture, &command.inputs);
        if (!isNamed)
          command.sceneOutputs.push_back(picture.empty() ? "pbrt.exr" : cli::ExrName(picture));
      }
      WriteFile(name, text);
      command.words.push_back(Spelt(name));
      command.inputs.push_back(name);
    }
    if (isNamed) AddOutput(dice_.OneIn(2) ? "-o" : "--outfile", &command);
    if (dice_.OneIn(4)) AddOutput("--preview", &command);
    if (dice_.OneIn(4)) AddOutput("--stats-json", &command);
    if (dice_.OneIn(10)) AddOutput("--state", &command);
    if (dice_.OneIn(10)) command.words.push_back("--resume");
    if (dice_.OneIn(10)) command.words.insert(command.words.end(), {"--write-every", ".001s"});
    if (dice_.OneIn(20)) command.words.push_back("--check");
    command.words.insert(command.words.end(), {"--nthreads", "1", "--no-progress"});
    return command;
  }

  Command MakeConvert() {
    Command command;
    const std::string from = Spelt(dice_.OneIn(2) ? "map.exr" : "own.exr");
    command.words.insert(command.words.end(), {"convert", from});
    command.inputs.push_back(from);
    command.outputs.push_back(Name());
    command.words.push_back(command.outputs[0]);
    return command;
  }

  Command MakeCompare() {
    Command command;
    const std::string folder = dice_.OneIn(2) ? "sub" : "fresh";
    const Names pictures{Spelt("map.exr"), Spelt("own.exr"), Spelt("sub/own.exr")};
    command.words.push_back("compare");
    for (int i = 0, count = 2 + dice_.Below(2); i < count; ++i) {
      const std::string picture = dice_.Of(pictures);
      command.words.push_back(picture);
      command.inputs.push_back(picture);
      for (const char* end : {"-difference.exr", "-difference.png", "-difference-R.png",
                              "-difference-G.png", "-difference-B.png"})
        command.outputs.push_back(folder + "/" + fs::path(picture).stem().string() + end);
    }
    command.words.insert(command.words.end(), {"--difference", folder});
    return command;
  }

  Command MakePlot() {
    Command command;
    WriteFile("scene0.pbrt", SceneText("x.exr", &command.inputs));
    command.inputs.push_back("scene0.pbrt");
    command.words.insert(command.words.end(),
                         {"info", "--photons-at", "0,0", "scene0.pbrt", "--nthreads", "1", "--set",
                          "SurfaceIntegrator.indirectphotons=10", "--integrator", "photonmap"});
    AddOutput("--plot", &command);
    return command;
  }

  void AddOutput(const std::string& option, Command* command) {
    const std::string name = Name();
    command->words.insert(command->words.end(), {option, name});
    command->outputs.push_back(name);
  }

  Dice dice_;
  std::string folder_;
};

// Silence redirects output to a file outside the case's folder, from which it can be printed later.
class Silence {
 public:
  explicit Silence(const std::string& file) {
    std::fflush(nullptr);
    const int to = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
    for (int i = 0; i < 2; ++i) {
      kept_[std::size_t(i)] = dup(i + 1);
      dup2(to, i + 1);
    }
    close(to);
  }
  ~Silence() {
    std::fflush(nullptr);
    for (int i = 0; i < 2; ++i) {
      dup2(kept_[std::size_t(i)], i + 1);
      close(kept_[std::size_t(i)]);
    }
  }

 private:
  std::array<int, 2> kept_{};
};

struct Tally {
  int cases = 0, rendered = 0, refused = 0, failed = 0;
};

std::string Line(const Names& words) {
  std::string line;
  for (const std::string& word : words) line += word + " ";
  return line;
}

// KnownFiles are the outputs that the user and the scene name, the inputs, and the names of files
// that an earlier run wrote.
struct KnownFiles {
  std::set<fs::path> user, scene, inputs;
  std::set<std::string> own;
};

// Returns a description of the fault, or "" if there is none.
std::string Judge(const Command& command, int status, const KnownFiles& files,
                  const std::map<std::string, std::string>& before) {
  const auto& [user, scene, inputs, own] = files;
  const fs::path folder = fs::current_path();
  const auto after = Snapshot(folder);
  for (const auto& [name, text] : before) {
    const auto found = after.find(name);
    if (found == after.end()) return name + " is gone";
    if (found->second == text) continue;
    const fs::path path = folder / name;
    if (text.starts_with("link to ")) return "the link " + name + " is replaced";
    if (inputs.contains(path)) return "the input " + name + " is replaced";
    if (!user.contains(path) && !(scene.contains(path) && own.contains(name)))
      return name + " is replaced";
    if (status == 3) return name + " is replaced, but the status is 3";
  }
  for (const auto& [name, text] : after) {
    if (before.contains(name)) continue;
    const fs::path path = folder / name;
    if (!user.contains(path) && !scene.contains(path)) return name + " was not asked for";
  }
  if (status < 0 || status > 4) return "the status is " + std::to_string(status);
  bool isConflict = false;
  for (const Names* names : {&command.outputs, &command.sceneOutputs})
    for (const std::string& name : *names) isConflict |= inputs.contains(Target(name));
  const bool isCheck = Line(command.words).find("--check") != std::string::npos;
  if (isConflict && status == 0 && !isCheck) return "an output is an input, and the status is 0";
  return "";
}

bool RunCase(unsigned seed, const std::string& scratch, Tally* tally) {
  const std::string folder = scratch + "/case";
  fs::remove_all(folder);
  fs::create_directories(folder);
  Case one(fs::canonical(folder), seed);
  const Command command = one.MakeCommand();
  KnownFiles files;
  for (const std::string& name : command.outputs) files.user.insert(Target(name));
  for (const std::string& name : command.sceneOutputs) files.scene.insert(Target(name));
  for (const std::string& name : command.inputs) files.inputs.insert(Target(name));
  const auto before = Snapshot(fs::current_path());
  for (const auto& [name, text] : before)
    if (text.starts_with("v/1\x01") && text.find("exphoton ") != std::string::npos)
      files.own.insert(name);
  int status = 0;
  {
    const Silence silence(scratch + "/output");
    status = cli::RunProgram(command.words);
  }
  ++tally->cases;
  tally->rendered += status == 0;
  tally->refused += status == 3;
  const std::string fault = Judge(command, status, files, before);
  if (fault.empty()) return true;
  ++tally->failed;
  std::printf("case %u: %s\n  %s\n%s\n", seed, fault.c_str(), Line(command.words).c_str(),
              ReadFile(scratch + "/output").c_str());
  return false;
}

// Runs every `step`-th case in this process and writes the tally to the pipe.
[[noreturn]] void Work(unsigned first, unsigned count, unsigned offset, unsigned step, int out) {
  Tally tally;
  {
    const TestFolder scratch;
    for (unsigned i = offset; i < count; i += step) RunCase(first + i, scratch.Path(), &tally);
    fs::current_path("/");
  }
  std::fflush(nullptr);
  const bool isWritten = write(out, &tally, sizeof tally) == ssize_t(sizeof tally);
  _exit(isWritten ? 0 : 1);
}

int Run(unsigned first, unsigned count) {
  const unsigned workers = std::max(1u, std::thread::hardware_concurrency());
  int ends[2];
  if (pipe(ends) != 0) return 1;
  for (unsigned i = 0; i < workers; ++i)
    if (fork() == 0) Work(first, count, i, workers, ends[1]);
  close(ends[1]);
  Tally sum, tally;
  while (read(ends[0], &tally, sizeof tally) == ssize_t(sizeof tally)) {
    sum.cases += tally.cases;
    sum.rendered += tally.rendered;
    sum.refused += tally.refused;
    sum.failed += tally.failed;
  }
  while (wait(nullptr) > 0) {
  }
  std::printf("%d command lines: %d with status 0, %d refused (status 3), %d with a fault\n",
              sum.cases, sum.rendered, sum.refused, sum.failed);
  // The test needs renders and refusals, more than 10 % of each.
  const bool isTelling = sum.rendered * 10 > sum.cases && sum.refused * 10 > sum.cases;
  return sum.failed == 0 && sum.cases == int(count) && isTelling ? 0 : 1;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) {
  // The program flushes each written file to the disk, so a folder in memory is faster.
  if (access("/dev/shm", W_OK) == 0) setenv("TMPDIR", "/dev/shm", 0);
  unsigned cases = 400, first = 0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--cases")) cases = unsigned(std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--first")) first = unsigned(std::atoi(argv[i + 1]));
  }
  return exphoton::Run(first, cases);
}
