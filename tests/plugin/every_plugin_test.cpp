// SPDX-License-Identifier: BSD-2-Clause
// These tests check every plugin that is built: its exported symbol, its declared parameters, its
// summary and its page in docs/reference/.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/base/log.h"
#include "core/params/param_reader.h"
#include "core/parser/language_page.h"
#include "core/parser/overrides.h"
#include "core/parser/reference/parameter_strips.h"
#include "core/plugins/catalogue.h"
#include "core/plugins/registry.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

const std::string kPlugins = EXPHOTON_BINARY_DIR "/plugins";

class EveryPlugin : public ::testing::Test {
 protected:
  template <class F>
  void ForEachFactory(F&& visit) {
    for (int i = 0; i < kPluginKindCount; ++i) {
      const auto kind = static_cast<PluginKind>(i);
      for (const std::string& name : registry_.Available(kind)) {
        SCOPED_TRACE(std::string(PluginKindName(kind)) + " " + name);
        visit(registry_.Load(kind, name, {}), registry_.Find(kind, name, {}));
      }
    }
  }
  Log log_{Log::Level::Normal, Log::Sink::Memory};
  PluginRegistry registry_{{kPlugins}, &log_};
};

#ifndef EXPHOTON_STATIC_PLUGINS

std::string OutputOf(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return text;
  char buffer[4096];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
    text.append(buffer, count);
  return pclose(pipe) == 0 ? text : "failed: " + text;
}

TEST_F(EveryPlugin, ExportsExactlyOneSymbol) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kPlugins)) {
    if (entry.path().extension() != ".so") continue;
    ++count;
    const std::string symbols =
        OutputOf("nm -D --defined-only --format=posix '" + entry.path().string() + "'");
    EXPECT_EQ(symbols.rfind("ExphotonPlugin T ", 0), 0u) << entry.path() << '\n' << symbols;
    EXPECT_EQ(std::count(symbols.begin(), symbols.end(), '\n'), 1) << entry.path() << '\n'
                                                                   << symbols;
  }
  EXPECT_GT(count, 20);
}

TEST_F(EveryPlugin, CanBeLoaded) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kPlugins)) {
    if (entry.path().extension() != ".so") continue;
    bool isLoaded = false;
    for (int i = 0; i < kPluginKindCount; ++i) {
      const auto kind = static_cast<PluginKind>(i);
      if (PluginKindFolder(kind) != entry.path().parent_path().filename()) continue;
      EXPECT_NO_THROW(registry_.Load(kind, entry.path().stem(), {})) << entry.path();
      isLoaded = true;
    }
    EXPECT_TRUE(isLoaded) << entry.path() << " lies in a folder of no kind";
  }
}

#endif

// Returns the plugin's source: NAME.cpp in a folder named as the folder of its kind.
fs::path SourceOf(PluginKind kind, const std::string& name) {
  const fs::path top = EXPHOTON_SOURCE_DIR;
  for (const char* folder : {"accelerators", "core/cameras", "integrators", "lights", "materials",
                             "samplers", "shapes"}) {
    for (const fs::path& place : {top / folder, top / folder / PluginKindFolder(kind)}) {
      const fs::path source = place / (name + ".cpp");
      if (place.filename() == PluginKindFolder(kind) && fs::exists(source)) return source;
    }
  }
  return {};
}

TEST_F(EveryPlugin, HasItsSourceInAFolderNamedAsItsKind) {
  ForEachFactory([](const PluginDescriptor& plugin, const PluginFactory& factory) {
    EXPECT_NE(SourceOf(factory.kind, plugin.name), fs::path());
  });
}

TEST_F(EveryPlugin, IsRegisteredByTheOneMacroOfItsKind) {
  ForEachFactory([](const PluginDescriptor& plugin, const PluginFactory& factory) {
    std::ifstream file(SourceOf(factory.kind, plugin.name));
    int macros = 0;
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with("EXPHOTON_")) continue;
      ++macros;
      EXPECT_FALSE(line.starts_with("EXPHOTON_PLUGIN")) << line;
    }
    EXPECT_EQ(macros, 1);
  });
}

TEST_F(EveryPlugin, SaysWhatItIsInOneLine) {
  ForEachFactory([](const PluginDescriptor& plugin, const PluginFactory&) {
    const std::string summary = plugin.summary;
    EXPECT_FALSE(summary.empty());
    EXPECT_LT(summary.size(), 90u);
    EXPECT_EQ(summary.find('\n'), std::string::npos);
    EXPECT_NE(summary.back(), '.') << "the pages add it";
  });
}

TEST_F(EveryPlugin, DeclaresParametersThatMakeSense) {
  ForEachFactory([](const PluginDescriptor&, const PluginFactory& factory) {
    std::set<std::string> names;
    for (const ParamDecl& decl : factory.parameters->Declarations()) {
      SCOPED_TRACE(decl.name);
      EXPECT_TRUE(names.insert(decl.name).second) << "declared twice";
      EXPECT_FALSE(decl.name.empty());
      EXPECT_EQ(decl.name.find_first_of(" \t\""), std::string::npos);
      EXPECT_FALSE(decl.doc.empty());
      EXPECT_FALSE(AcceptedTypes(decl.type).empty());
      EXPECT_EQ(decl.type == ParamType::Choice, !decl.choices.empty());
      if (decl.min && decl.max) {
        EXPECT_LT(*decl.min, *decl.max);
      }
    }
  });
}

TEST_F(EveryPlugin, IsInTheReferenceAsItDeclaresItself) {
  if (sizeof(Real) != 4) GTEST_SKIP() << "defaults such as 1/3 have more digits in double";
  const fs::path folder = EXPHOTON_SOURCE_DIR "/docs/reference";
  std::set<std::string> files;
  for (const auto& [file, page] : AllReferencePages(registry_)) {
    const bool isCurrent = ReadFile(folder / file) == page;
    EXPECT_TRUE(isCurrent) << file
                           << " is stale: run exphoton plugins --write-reference docs/reference";
    files.insert(file);
  }
  ASSERT_TRUE(fs::is_directory(folder));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() == "images") continue;
    EXPECT_TRUE(files.count(entry.path().filename())) << entry.path() << " belongs to no plugin";
  }
}

// Returns the section of the plugin on the reference pages, and "" if there is none.
std::string SectionOf(std::map<std::string, std::string>& pages, PluginKind kind,
                      const std::string& plugin) {
  const std::string& page = pages[std::string(PluginKindFolder(kind)) + ".md"];
  std::string heading = std::string(PluginKindName(kind)) + " `" + plugin + "`\n";
  heading[0] = char(std::toupper(heading[0]));
  const std::size_t begin = page.find("\n## " + heading);
  if (begin == std::string::npos) return "";
  return page.substr(begin + 1, page.find("\n## ", begin + 1) - begin);
}

TEST_F(EveryPlugin, HasTheParametersAndPicturesOfItsStrips) {
  const fs::path folder = EXPHOTON_SOURCE_DIR "/docs/reference/images";
  auto pages = AllReferencePages(registry_);
  std::set<fs::path> files;
  for (const ParameterStrip& strip : ParameterStrips()) {
    SCOPED_TRACE(strip.Name());
    const fs::path file = folder / (strip.Name() + ".jpg");
    EXPECT_TRUE(files.insert(file).second) << "is there twice";
    const std::string name = std::string(strip.plugin) + '-' + strip.parameter;
    const std::string script =
        ReadFile(folder / "strips" / (std::string(PluginKindFolder(strip.kind)) + ".py"));
    EXPECT_NE(script.find('"' + name + "\": (\"" + strip.values + '"'), std::string::npos);
    EXPECT_TRUE(fs::is_regular_file(file));
    EXPECT_LE(fs::file_size(file), 40000u);
    const std::string section = SectionOf(pages, strip.kind, strip.plugin);
    EXPECT_NE(section.find(std::string("\n| `") + strip.parameter + "` |"), std::string::npos);
    EXPECT_NE(section.find("](images/" + strip.Name() + ".jpg)"), std::string::npos);
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    EXPECT_TRUE(entry.path().extension() != ".jpg" || files.count(entry.path()))
        << entry.path() << " is on no page";
}

TEST_F(EveryPlugin, LinksToThePicturesOfTheSameParameterElsewhere) {
  auto pages = AllReferencePages(registry_);
  const auto shows = [&](PluginKind kind, const char* plugin, const std::string& text) {
    return SectionOf(pages, kind, plugin).find(text) != std::string::npos;
  };
  EXPECT_TRUE(shows(PluginKind::Material, "clay",
                    "\n\n[Material `matte`](#material-matte) shows `bumpmap`.\n"));
  EXPECT_TRUE(shows(PluginKind::Integrator, "whitted",
                    "[Integrator `directlighting`](#integrator-directlighting) shows `maxdepth`."));
  EXPECT_TRUE(shows(PluginKind::Camera, "environment",
                    "[Camera `perspective`](#camera-perspective) shows `hither`, `yon`,"));
  EXPECT_FALSE(shows(PluginKind::Camera, "environment", "`screenwindow`."));
  EXPECT_FALSE(shows(PluginKind::Material, "matte", "#material-matte"));
  EXPECT_FALSE(shows(PluginKind::Volume, "exponential", "#volume-exponential"));
  EXPECT_TRUE(shows(PluginKind::ColorTexture, "wrinkled", "#float-texture-wrinkled"));
}

std::optional<PluginKind> KindOfWord(const std::string& word) {
  if (word == "texture") return PluginKind::ColorTexture;
  for (int i = 0; i < kPluginKindCount; ++i) {
    std::string name = PluginKindName(PluginKind(i));
    std::erase(name, ' ');
    if (name == word) return PluginKind(i);
  }
  return std::nullopt;
}

// Returns the row of a plugin on the page, and "" if there is none.
std::string RowOf(const std::string& page, const std::string& plugin) {
  const std::size_t at = page.find("| `" + plugin + "` |");
  return at == std::string::npos ? "" : page.substr(at, page.find('\n', at) - at);
}

TEST_F(EveryPlugin, OfPbrtIsOnThePageOfItsLanguage) {
  const std::string page = LanguagePage(registry_);
  EXPECT_EQ(page.find("not available"), std::string::npos);
  for (const PbrtPlugin& plugin : PbrtPlugins()) {
    const std::string row = RowOf(page, plugin.name);
    ASSERT_NE(row, "") << plugin.name;
    for (const PbrtPlugin::Parameter& parameter : plugin.parameters)
      EXPECT_NE(page.find('`' + parameter.name + '`'), std::string::npos) << parameter.name;
  }
  EXPECT_EQ(RowOf(page, "cone"), "| `cone` | 1, 2 | available | `radius`, `height`, `phimax` |  |");
  EXPECT_EQ(RowOf(page, "grid"),
            "| `grid` | 1, 2 | replaced by `bvh`: the picture is the same |  | "
            "`refineimmediately` |");
  EXPECT_EQ(RowOf(page, "bvh"), "| `bvh` | 2 | available |  | `maxnodeprims`, `splitmethod` |");
}

// Every parameter of version 1 has an effect, except these.
TEST_F(EveryPlugin, HasTheParametersOfPbrt) {
  const std::set<std::string> ignored{"writefrequency", "refineimmediately"};
  for (const PbrtPlugin& plugin : PbrtPlugins()) {
    const auto kind = KindOfWord(plugin.kind);
    if (!kind || plugin.versions == "2" || plugin.name == "grid") continue;
    const auto& declared = registry_.Find(*kind, plugin.name, {}).parameters->Declarations();
    for (const PbrtPlugin::Parameter& parameter : plugin.parameters) {
      const bool isThere =
          std::any_of(declared.begin(), declared.end(),
                      [&](const ParamDecl& decl) { return decl.name == parameter.name; });
      EXPECT_TRUE(isThere || ignored.count(parameter.name))
          << plugin.kind << ' ' << plugin.name << ' ' << parameter.name;
    }
  }
}

TEST_F(EveryPlugin, IsListedAndDescribed) {
  const std::string list = ListPlugins(registry_);
  ForEachFactory([&](const PluginDescriptor& plugin, const PluginFactory& factory) {
    EXPECT_NE(list.find("  " + std::string(plugin.name) + " "), std::string::npos);
    const std::string text = DescribePlugin(registry_, plugin.name);
    for (const ParamDecl& decl : factory.parameters->Declarations()) {
      EXPECT_NE(text.find(' ' + decl.name + "  "), std::string::npos) << decl.name;
    }
  });
  try {
    DescribePlugin(registry_, "exphotonmpa");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::CommandLine);
    EXPECT_STREQ(error.what(), "there is no plugin \"exphotonmpa\"");
    EXPECT_EQ(error.Hint(), "did you mean \"exphotonmap\"?");
  }
}

// Returns "name=count" for each parameter that --quick changes. `given` is the count that the scene
// file gives all parameters, or 0 if it gives none.
std::set<std::string> QuickCounts(const PluginFactory& factory, int given) {
  const std::vector<ParamDecl>& declared = factory.parameters->Declarations();
  ParamSet params;
  for (const ParamDecl& decl : declared) {
    if (given == 0) break;
    ParsedParam param;
    param.type = "integer", param.name = decl.name, param.numbers = {double(given)};
    params.Add(param);
  }
  ScaleForQuick(declared, &params);
  std::set<std::string> counts;
  for (const ParsedParam& param : params.All())
    if (const int count = int(param.numbers.at(0)); count != given)
      counts.insert(param.name + "=" + std::to_string(count));
  return counts;
}

using QuickPhotons = EveryPlugin;

TEST_F(QuickPhotons, AreATenthAndTheGatherSamplesAQuarter) {
  using Counts = std::set<std::string>;
  for (const std::string& name : registry_.Available(PluginKind::Integrator)) {
    SCOPED_TRACE(name);
    const PluginFactory& factory = registry_.Find(PluginKind::Integrator, name, {});
    // The default counts of direct and caustic photons are automatic, so they are not scaled.
    Counts byDefault, given;
    if (name == "photonmap" || name == "exphotonmap") {
      byDefault = {"indirectphotons=10000", "nused=5", "finalgathersamples=8"};
      given = {"causticphotons=1", "directphotons=1", "indirectphotons=1", "nused=2",
               "finalgathersamples=3"};
    } else if (name == "guidedpath") {
      byDefault = {"indirectphotons=10000"};
      given = {"indirectphotons=1"};
    }
    EXPECT_EQ(QuickCounts(factory, 0), byDefault);
    EXPECT_EQ(QuickCounts(factory, 15), given);
  }
}

}  // namespace
}  // namespace exphoton
