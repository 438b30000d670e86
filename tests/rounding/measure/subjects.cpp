// SPDX-License-Identifier: BSD-2-Clause
// Reads subjects and renders them in process.
#include "tests/rounding/measure/subjects.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <stdexcept>

#include "core/base/log.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/source.h"
#include "tests/hardcases/case_file.h"

namespace exphoton::rounding {
namespace {

// Replaces each value of an integer parameter that is above the limit.
std::string Limited(const std::string& text, const std::string& names, int limit) {
  const std::regex pattern("\"integer (" + names + ")\" (\\[ ?)?([0-9]+)");
  std::string result;
  auto rest = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    const std::smatch& match = *at;
    result.append(rest, text.cbegin() + match.position(3));
    result += std::to_string(std::min(std::stoll(match.str(3)), static_cast<long long>(limit)));
    rest = text.cbegin() + match.position(3) + match.length(3);
  }
  return result.append(rest, text.cend());
}

// Fewer photons; quick renders divide them once more. A guided path searches its map of photons at
// each bounce, which is slow without vectors.
std::string Small(const std::string& text) {
  const std::string few = Limited(text, "directphotons|causticphotons|indirectphotons", 10000);
  const bool isGuided = few.find("\"guidedpath\"") != std::string::npos;
  return isGuided ? Limited(few, "maxdepth", 20) : few;
}

// Returns why a run has no picture to compare; empty if it has one.
std::string ReasonAgainst(const hardcases::Run& run) {
  if (run.status != 0) return "ends with an error, as it must";
  const std::string option = run.arguments.empty() ? "" : run.arguments.front();
  const bool isEqual = option.empty() || option == "--nthreads" || option == "--verbose";
  return isEqual && run.environment.empty() ? "" : "has another command line";
}

void AddCase(const hardcases::Group& group, const hardcases::Case& each, Subjects* subjects) {
  if (each.runs.empty() && each.scripts.empty())
    subjects->leftOut.push_back({each.id, "has tests of parts, and no scene"});
  for (const hardcases::Script& script : each.scripts)
    subjects->leftOut.push_back(
        {each.id + " " + script.name, "is a script, with renders of its own"});
  for (const hardcases::Run& run : each.runs) {
    const std::string name = each.id + " " + run.name, reason = ReasonAgainst(run);
    if (reason.empty())
      subjects->all.push_back({group.title, name, Small(run.scene), ""});
    else
      subjects->leftOut.push_back({name, reason});
  }
}

bool ShootsPhotons(const std::string& integrator) {
  return integrator.find("photonmap") != std::string::npos ||
         integrator.find("\"guidedpath\"") != std::string::npos;
}

}  // namespace

Subjects ReadHardCases() {
  Subjects subjects;
  const std::string folder = std::string(EXPHOTON_SOURCE_DIR) + "/tests/hardcases/cases";
  for (const auto& group : hardcases::ReadCatalogue(folder))
    for (const auto& each : group.cases) AddCase(group, each, &subjects);
  return subjects;
}

std::vector<Subject> ReadScenes() {
  std::vector<Subject> subjects;
  const std::filesystem::path folder = std::string(EXPHOTON_SOURCE_DIR) + "/scenes";
  for (const auto& scene : std::filesystem::directory_iterator(folder)) {
    const auto file = scene.path() / "path.pbrt";
    if (std::filesystem::exists(file))
      subjects.push_back({scene.path().filename().string(), "path", "", file.string()});
  }
  std::sort(subjects.begin(), subjects.end(), [](const Subject& a, const Subject& b) {
    return std::tie(a.group, a.name) < std::tie(b.group, b.name);
  });
  return subjects;
}

namespace {

LoadOptions LoadOptionsFor(const Subject& subject) {
  LoadOptions load;
  load.isQuick = true;  // a quarter of the resolution, one sample, and fewer photons
  load.parameters = {{"Film", "xresolution", "32"}, {"Film", "yresolution", "24"}};
  if (ShootsPhotons(subject.file.empty() ? subject.text : subject.name))
    load.parameters.push_back({"SurfaceIntegrator", "maxphotonpaths", "5000"});
  return load;
}

LoadedScene LoadFile(const Subject& subject) {
  LoadOptions load = LoadOptionsFor(subject);
  load.pluginFolders = {std::string(EXPHOTON_BINARY_DIR) + "/plugins"};
  LoadedScene scene;
  scene.log = std::make_unique<Log>(Log::Level::Normal, Log::Sink::Memory);
  FileSource source;
  scene.setup = std::move(LoadScenes(source, subject.file, load, *scene.log).front());
  return scene;
}

}  // namespace

std::vector<TestRender> RenderSubject(const Subject& subject, int count,
                                      const std::function<void(int)>& begin) {
  TestRenderOptions options;
  options.isStrict = false;
  options.load = LoadOptionsFor(subject);
  LoadedScene scene;
  if (!subject.file.empty()) scene = LoadFile(subject);
  std::vector<TestRender> renders;
  for (int i = 0; i < count; ++i) {
    begin(i);
    if (subject.file.empty()) scene = LoadSceneText(subject.text, options.load);
    renders.push_back(RenderLoaded(scene, options));
  }
  return renders;
}

}  // namespace exphoton::rounding
