// SPDX-License-Identifier: BSD-2-Clause
// Names, aliases and folders of plugins.
#include "core/plugins/search.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "core/base/error.h"
#include "core/plugins/library.h"
#include "core/plugins/registry.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".so";

constexpr const char* kSamePicture = "the picture is the same";
constexpr const char* kOneBounceMore = "the same maxdepth follows one bounce more";
constexpr const char* kOtherPoints = "its points differ, the picture does not";
constexpr const char* kOneScattering = "media scatter light once at most";
constexpr const char* kDiffuseSurface =
    "no light travels below the surface, and the surface has no gloss";

constexpr PluginAlias kAliases[] = {
    {PluginKind::Integrator, "dipolesubsurface", "path", "no light travels below surfaces"},
    {PluginKind::Integrator, "glossyprt", "path", "light is simulated, not precomputed"},
    {PluginKind::Integrator, "diffuseprt", "path", "light is simulated, not precomputed"},
    {PluginKind::Integrator, "useprobes", "path", "light is simulated, not read from probes"},
    {PluginKind::Integrator, "volpath", "path", kOneScattering},
    {PluginKind::Integrator, "simplepath", "path", kOneBounceMore},
    {PluginKind::Integrator, "simplevolpath", "path", kOneScattering},
    {PluginKind::Integrator, "randomwalk", "path", "it also shows mirrors, glass and point lights"},
    {PluginKind::Integrator, "lightpath", "bidirectional", "it also shows mirrors and glass"},
    {PluginKind::Integrator, "mlt", "path", "hidden light is noisier"},
    {PluginKind::Integrator, "sppm", "exphotonmap", "a fixed number of photons is used"},
    {PluginKind::Integrator, "bdpt", "bidirectional", kOneBounceMore},
    {PluginKind::Integrator, "ao", "ambientocclusion", nullptr},
    {PluginKind::Accelerator, "grid", "bvh", kSamePicture},
    {PluginKind::Accelerator, "none", "bvh", kSamePicture},
    {PluginKind::AreaLight, "diffuse", "area", nullptr},
    {PluginKind::Light, "infinitesample", "infinite", nullptr},
    {PluginKind::Camera, "realistic", "perspective",
     "there is no lens, and \"fov\" sets the field of view"},
    {PluginKind::Camera, "spherical", "environment",
     "it shows latitude and longitude instead of equal areas"},
    {PluginKind::Material, "subsurface", "matte", kDiffuseSurface},
    {PluginKind::Material, "kdsubsurface", "matte", kDiffuseSurface},
    {PluginKind::Material, "disney", "plastic", "only diffuse and glossy reflection remain"},
    {PluginKind::Material, "fourier", "matte", "the measured reflection is lost"},
    {PluginKind::Material, "hair", "matte", "hair does not shine"},
    {PluginKind::Sampler, "02sequence", "lowdiscrepancy", nullptr},
    {PluginKind::Sampler, "zerotwosequence", "lowdiscrepancy", nullptr},
    {PluginKind::Sampler, "sobol", "lowdiscrepancy", kOtherPoints},
    {PluginKind::Sampler, "maxmindist", "lowdiscrepancy", kOtherPoints},
    {PluginKind::Sampler, "paddedsobol", "lowdiscrepancy", kOtherPoints},
    {PluginKind::Sampler, "zsobol", "lowdiscrepancy", kOtherPoints},
    {PluginKind::Sampler, "pmj02bn", "lowdiscrepancy", kOtherPoints},
    {PluginKind::Sampler, "independent", "random", nullptr},
    {PluginKind::FloatTexture, "ptex", "constant", "the image is lost"},
    {PluginKind::ColorTexture, "ptex", "constant", "the image is lost"},
};

struct MissingPlugin {
  PluginKind kind;
  const char* name;
  const char* advice;
};
constexpr MissingPlugin kMissingPlugins[] = {
    {PluginKind::Shape, "curve",
     "a mesh of the same form can take its place: trianglemesh, plymesh or obj"},
    {PluginKind::Shape, "bilinearmesh",
     "two triangles of a trianglemesh can take the place of each patch; exphoton import makes them "
     "from scenes of version 4"},
};

// Returns the existing plugin folders beside the program and beside the core's library. It checks
// the layouts of a build tree and of an installation.
std::vector<std::string> FoldersBesideProgram() {
  std::error_code error;
  std::vector<std::string> candidates;
  for (const fs::path& file : {fs::read_symlink("/proc/self/exe", error), fs::path(CoreFile())}) {
    if (!file.has_parent_path()) continue;
    const fs::path prefix = file.parent_path().parent_path();
    for (const char* folder : {"plugins", "lib/exphoton/plugins"}) {
      const std::string candidate = (prefix / folder).lexically_normal().string();
      if (std::find(candidates.begin(), candidates.end(), candidate) == candidates.end()) {
        candidates.push_back(candidate);
      }
    }
  }
  std::vector<std::string> existing;
  for (const std::string& candidate : candidates) {
    if (fs::is_directory(candidate, error)) existing.push_back(candidate);
  }
  if (existing.empty() && !candidates.empty()) existing.push_back(candidates.front());
  return existing;
}

}  // namespace

const PluginAlias* FindPluginAlias(PluginKind kind, const std::string& name) {
  for (const PluginAlias& alias : kAliases) {
    if (alias.kind == kind && name == alias.alias) return &alias;
  }
  return nullptr;
}

std::string AdviceForMissingPlugin(PluginKind kind, const std::string& name) {
  for (const MissingPlugin& missing : kMissingPlugins) {
    if (missing.kind == kind && name == missing.name) return missing.advice;
  }
  return {};
}

std::optional<std::string> FaultOfPluginName(const std::string& name) {
  if (name.empty()) return "is empty";
  if (name.find('/') != std::string::npos || name.find("..") != std::string::npos) {
    return "contains a path: --plugin-dir or PBRT_SEARCHPATH names folders";
  }
  if (name.find('\0') != std::string::npos || name.size() > 200) {
    return "cannot be the name of a file";
  }
  return std::nullopt;
}

PluginFolders ChosenFolders(const std::vector<std::string>& paths) {
  PluginFolders folders;
  for (const std::string& path : paths) folders.push_back({path, PluginTrust::Chosen});
  return folders;
}

std::span<const PluginAlias> AllPluginAliases() { return kAliases; }

std::vector<PluginFile> FindPluginFiles(const PluginFolders& folders, PluginKind kind,
                                        const std::string& name) {
  std::vector<PluginFile> files;
  std::error_code error;
  for (const auto& [folder, trust] : folders) {
    if (trust == PluginTrust::Skipped) continue;
    for (const fs::path& file : {fs::path(folder) / PluginKindFolder(kind) / (name + kSuffix),
                                 fs::path(folder) / (name + kSuffix)}) {
      if (fs::exists(file, error)) files.push_back({file.string(), trust});
    }
  }
  return files;
}

std::vector<std::string> PluginNamesIn(const PluginFolders& folders, PluginKind kind) {
  std::set<std::string> names;
  for (const auto& [folder, trust] : folders) {
    if (trust == PluginTrust::Skipped) continue;
    std::error_code error;
    fs::directory_iterator files(fs::path(folder) / PluginKindFolder(kind), error);
    for (; !error && files != fs::directory_iterator(); files.increment(error)) {
      const fs::path& path = files->path();
      if (path.extension() == kSuffix) names.insert(path.stem().string());
    }
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> PluginRegistry::DefaultFolders(const std::vector<std::string>& extra) {
  for (const std::string& folder : extra) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (!fs::is_directory(status))
      throw Error(ExitStatus::File,
                  "cannot look for plugins in \"" + folder + "\" (--plugin-dir): " +
                      (fs::exists(status) ? "it is no folder" : "there is no such folder"),
                  {}, "name a folder that holds plugins, or folders of them such as materials/");
  }
  std::vector<std::string> folders = extra;
  const char* variable = std::getenv("PBRT_SEARCHPATH");
  std::string rest = variable ? variable : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  for (std::string& folder : FoldersBesideProgram()) folders.push_back(std::move(folder));
  return folders;
}

}  // namespace exphoton
