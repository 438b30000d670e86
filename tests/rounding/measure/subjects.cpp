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
#include "tests/support/test_scene.h"

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

// Fewer photons; quick renders divide them once more.
std::string Small(const std::string& text) {
  return Limited(text, "directphotons|causticphotons|indirectphotons", 10000);
}

}  // namespace

std::vector<Subject> ReadHardCases() {
  std::vector<Subject> subjects;
  const std::string folder = std::string(EXPHOTON_SOURCE_DIR) + "/tests/hardcases/cases";
  for (const auto& group : hardcases::ReadCatalogue(folder))
    for (const auto& each : group.cases)
      for (const auto& run : each.runs)
        if (run.status == 0 && !each.isSlow && !run.isSlow && run.arguments.empty() &&
            run.scene.find("\"guidedpath\"") == std::string::npos)
          subjects.push_back({group.title, each.id + " " + run.name, Small(run.scene), ""});
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

Image RenderSubject(const Subject& subject) {
  LoadOptions load;
  load.isQuick = true;  // a quarter of the resolution, one sample, and fewer photons
  load.parameters = {{"Film", "xresolution", "32"}, {"Film", "yresolution", "24"}};
  const std::string& integrator = subject.file.empty() ? subject.text : subject.name;
  if (integrator.find("photonmap") != std::string::npos)
    load.parameters.push_back({"SurfaceIntegrator", "maxphotonpaths", "5000"});
  TestRenderOptions options;
  options.isStrict = false;
  options.load = load;
  if (!subject.text.empty()) return RenderSceneText(subject.text, options).image;
  LoadedScene scene;
  scene.log = std::make_unique<Log>(Log::Level::Normal, Log::Sink::Memory);
  FileSource source;
  load.pluginFolders = {std::string(EXPHOTON_BINARY_DIR) + "/plugins"};
  scene.setup = std::move(LoadScenes(source, subject.file, load, *scene.log).front());
  return RenderLoaded(scene, options).image;
}

}  // namespace exphoton::rounding
