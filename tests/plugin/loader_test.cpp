// SPDX-License-Identifier: BSD-2-Clause
// These tests check the plugin loader: the plugins that it finds, and the message for each kind of
// failure. The faulty plugins are built from tests/plugin/modules/.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/base/log.h"
#include "core/plugins/elf_file.h"
#include "core/plugins/registry.h"

#ifndef EXPHOTON_STATIC_PLUGINS

namespace exphoton {
namespace {

std::string ReadAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

namespace fs = std::filesystem;

const std::string kLoaderPlugins = EXPHOTON_BINARY_DIR "/plugins";
const std::string kFaulty = EXPHOTON_BINARY_DIR "/faulty_plugins";

class Loader : public ::testing::Test {
 protected:
  Loader() {
    folder_ = fs::path(::testing::TempDir()) / ("exphoton_loader_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "filters");
  }
  ~Loader() override { fs::remove_all(folder_); }

  PluginRegistry Registry(const std::vector<std::string>& folders) {
    return PluginRegistry(folders, &log_);
  }
  SourceLocation Here() const { return {"a.pbrt", 2, 1, "PixelFilter", nullptr}; }

  // Returns the message that a user reads when a scene names this filter.
  std::string Fails(const std::string& name, const std::vector<std::string>& folders) {
    PluginRegistry registry = Registry(folders);
    ParamSet params;
    params.where = Here();
    try {
      registry.Create<PluginKind::Filter>(name, params, {}, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.Status(), ExitStatus::Scene);
      EXPECT_TRUE(error.Where());
      return error.what();
    }
    return "no error";
  }
  std::string FailsToLoad(const std::string& name, const std::string& folder) {
    const std::string text = Fails(name, {folder});
    const std::string begin =
        "cannot load filter \"" + name + "\": \"" + folder + "/filters/" + name + ".so\" ";
    EXPECT_EQ(text.substr(0, begin.size()), begin);
    return text.size() > begin.size() ? text.substr(begin.size()) : "";
  }

  fs::path folder_;
  Log log_{Log::Level::Normal, Log::Sink::Memory};
};

TEST_F(Loader, LoadsOnlyWhatIsNamed) {
  PluginRegistry registry = Registry({kLoaderPlugins});
  EXPECT_TRUE(registry.Loaded().empty());
  EXPECT_TRUE(registry.Create<PluginKind::Filter>("box", {}, {}, {}));
  EXPECT_TRUE(registry.Create<PluginKind::Filter>("box", {}, {}, {}));
  EXPECT_EQ(registry.Loaded(), std::vector<std::string>{"filters/box"});
}

TEST_F(Loader, ListsWhatThereIsWhereAFilterIsMissing) {
  const std::string text = Fails("gausian", {kLoaderPlugins});
  EXPECT_EQ(text,
            "there is no filter \"gausian\"; available: box, gaussian, mitchell, "
            "sinc, triangle (looked in " +
                kLoaderPlugins + ")");
  PluginRegistry registry = Registry({kLoaderPlugins});
  try {
    registry.Find(PluginKind::Filter, "gausian", Here());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Hint(), "did you mean \"gaussian\"?");
  }
  EXPECT_EQ(Fails("box", {"/nowhere"}),
            "there is no filter \"box\"; no plugin of this kind was found (looked in /nowhere)");
}

// The registry opens the plugins of a kind once and keeps their parameter tables for all unknown
// parameter names. Opening every plugin of a kind takes about 1 ms, and a scene may have
// thousands of unknown parameters. After the file of "mitchell" is removed, its parameters can
// only come from memory.
TEST_F(Loader, LooksUpTheParametersOfAKindOnce) {
  for (const char* name : {"box.so", "mitchell.so"})
    fs::copy_file(kLoaderPlugins + "/filters/" + name, folder_ / "filters" / name);
  PluginRegistry registry = Registry({folder_.string()});
  ParsedParam another;
  another.type = "float";
  another.name = "B";
  another.numbers = {1};
  ParamSet params;
  params.Add(another);
  const auto messages = [&] {
    Log log(Log::Level::Normal, Log::Sink::Memory);
    BindContext bind;
    bind.log = &log;
    EXPECT_TRUE(registry.Create<PluginKind::Filter>("box", params, std::move(bind), {}));
    return log.Messages();
  };
  const std::vector<std::string> first = messages();
  ASSERT_EQ(first.size(), 1u);
  fs::remove(folder_ / "filters/mitchell.so");
  EXPECT_EQ(messages(), first);
}

TEST_F(Loader, RefusesNamesThatAreNotNames) {
  EXPECT_EQ(Fails("", {kLoaderPlugins}), "the name of filter \"\" is empty");
  for (const std::string name : {"../box", "filters/box", "/etc/passwd", "..", "a..b"}) {
    EXPECT_EQ(Fails(name, {kLoaderPlugins}),
              "the name of filter \"" + name +
                  "\" contains a path: --plugin-dir or PBRT_SEARCHPATH names folders");
  }
  EXPECT_EQ(Fails(std::string(5000, 'x'), {kLoaderPlugins}).substr(0, 20), "the name of filter \"");
}

TEST_F(Loader, SaysWhatIsWrongWithAFile) {
  const fs::path filters = folder_ / "filters";
  std::ofstream(filters / "text.so") << "I am no library.\n";
  std::ofstream(filters / "empty.so") << "";
  fs::create_directory(filters / "folder.so");
  EXPECT_EQ(FailsToLoad("text", folder_), "is not a library");
  EXPECT_EQ(FailsToLoad("empty", folder_), "is not a library");
  EXPECT_EQ(FailsToLoad("folder", folder_), "is a directory, not a plugin");
  if (geteuid() != 0) {
    fs::copy_file(kLoaderPlugins + "/filters/box.so", filters / "box.so");
    fs::permissions(filters / "box.so", fs::perms::none);
    EXPECT_EQ(FailsToLoad("box", folder_), "cannot be read: Permission denied");
  }
}

TEST_F(Loader, APluginWhoseConstructorThrowsDoesNotAbortTheProgram) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(FailsToLoad("throwing_constructor", EXPHOTON_BINARY_DIR "/fatal_plugins"),
              testing::ExitedWithCode(2),
              "throwing_constructor.so\" fails while it is loaded, in a constructor: no licence");
}

// The test cuts the file at every sixteenth of its length. A cut before the end of the loadable
// segments must be reported as truncation. A later cut removes only debug tables, so the library
// may still load.
TEST_F(Loader, ATruncatedLibraryIsRefusedAndKillsNothing) {
  std::ifstream whole(kLoaderPlugins + "/filters/box.so", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  ASSERT_GT(bytes.size(), 1000u);
  for (std::size_t part = 0; part < 16; ++part) {
    const std::string name = "cut" + std::to_string(part);
    const fs::path file = folder_ / "filters" / (name + ".so");
    std::ofstream(file, std::ios::binary) << bytes.substr(0, bytes.size() * part / 16);
    const std::string text = FailsToLoad(name, folder_);
    const std::string expected = part == 0 ? "is not a library" : "is truncated";
    if (text == expected) continue;
    EXPECT_GE(part, 8u) << text;
    EXPECT_EQ(text, "names itself \"box\": the file must have the name of the plugin") << part;
  }
}

TEST_F(Loader, GivesTheReasonOfTheSystemForAnotherMachine) {
  std::ifstream whole(kLoaderPlugins + "/filters/box.so", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  bytes[18] = char(0xF7);  // e_machine becomes 247 (EM_BPF), which is no host CPU
  std::ofstream(folder_ / "filters/alien.so", std::ios::binary) << bytes;
  EXPECT_EQ(FailsToLoad("alien", folder_).rfind("cannot be loaded: ", 0), 0u);
}

TEST_F(Loader, CodeOfALibraryThatIsNoPluginNeverRuns) {
  const std::string mark = (folder_ / "mark").string();
  setenv("EXPHOTON_TEST_MARK", mark.c_str(), 1);
  EXPECT_EQ(FailsToLoad("marking_library", kFaulty),
            "is a library, but not a plugin: it has no symbol ExphotonPlugin");
  EXPECT_FALSE(fs::exists(mark));
  PluginRegistry registry = Registry({kFaulty});
  EXPECT_TRUE(registry.Create<PluginKind::Filter>("marking_filter", {}, {}, {}));
  EXPECT_TRUE(fs::exists(mark)) << "the plugins of this test leave no marks";
  unsetenv("EXPHOTON_TEST_MARK");
}

// The test damages one byte at a time in the first 4096 bytes of a library, which include its
// tables. FaultOfLibrary must refuse or accept the file, and must not cause a signal.
TEST_F(Loader, DamagedTablesOfALibraryAreRefusedOrHarmless) {
  const std::string bytes = ReadAll(kLoaderPlugins + "/filters/box.so");
  const fs::path file = folder_ / "filters/box.so";
  int refused = 0;
  for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 4096); at += 17) {
    std::string damaged = bytes;
    damaged[at] = char(damaged[at] ^ 0xA5);
    std::ofstream(file, std::ios::binary) << damaged;
    const int opened = open(file.c_str(), O_RDONLY);
    refused += FaultOfLibrary(opened, kPluginSymbol).has_value();
    close(opened);
  }
  EXPECT_GT(refused, 10);
}

TEST_F(Loader, AFolderThatASceneNamesIsNotSearchedUnlessItIsAllowed) {
  const std::string faulty = kFaulty;
  PluginRegistry skipping({{faulty, PluginTrust::Skipped}, {kLoaderPlugins}}, &log_);
  EXPECT_THROW(skipping.Find(PluginKind::Filter, "refusing_factory", Here()), Error);
  try {
    skipping.Find(PluginKind::Filter, "refusing_factory", Here());
  } catch (const Error& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("did not look in " + faulty + ", named by the scene: --allow-scene-plugins"),
        std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(skipping.Create<PluginKind::Filter>("box", {}, {}, {}));
}

// Anyone who can write the file chooses the code that the program runs.
TEST_F(Loader, AnAllowedPluginThatOthersCanChangeIsRefused) {
  const fs::path file = folder_ / "filters/refusing_factory.so";
  fs::copy_file(kFaulty + "/filters/refusing_factory.so", file);
  const auto load = [&]() -> std::string {
    PluginRegistry registry({{folder_.string(), PluginTrust::Allowed}}, &log_);
    try {
      registry.Find(PluginKind::Filter, "refusing_factory", Here());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  for (const int byGroupOrOthers : {0664, 0646, 0666}) {
    fs::permissions(file, fs::perms(byGroupOrOthers));
    EXPECT_NE(load().find("can be changed by other users"), std::string::npos) << load();
  }
  fs::permissions(file, fs::perms(0644));
  for (const int byGroupOrOthers : {0775, 0757, 0777}) {
    fs::permissions(folder_ / "filters", fs::perms(byGroupOrOthers));
    EXPECT_NE(load().find("lies in a folder that can be changed"), std::string::npos) << load();
  }
  fs::permissions(folder_ / "filters", fs::perms(0755));
  if (geteuid() == 0) {
    ASSERT_EQ(chown(file.c_str(), 1234, 0), 0);
    EXPECT_NE(load().find("belongs to another user"), std::string::npos) << load();
    ASSERT_EQ(chown(file.c_str(), 0, 0), 0);
  }
  EXPECT_EQ(load(), "");
  EXPECT_EQ(load(), "");  // the second load uses another descriptor
}

TEST_F(Loader, SaysWhatIsWrongWithADescriptor) {
  EXPECT_EQ(FailsToLoad("no_symbol", kFaulty),
            "is a library, but not a plugin: it has no symbol ExphotonPlugin");
  EXPECT_EQ(FailsToLoad("wrong_abi", kFaulty),
            "is built for plugin interface " + std::to_string(kPluginAbi + 6) +
                ", and this program has " + std::to_string(kPluginAbi) + ": build it again");
  EXPECT_EQ(FailsToLoad("wrong_build", kFaulty),
            "is built by \"exphoton 1, 3.2.1, float\", and this program by \"" +
                std::string(CoreBuildTag()) + "\": build it again");
  EXPECT_EQ(FailsToLoad("misnamed", kFaulty),
            "names itself \"rightly_named\": the file must have the name of the plugin");
  EXPECT_EQ(FailsToLoad("null_descriptor", kFaulty), "returns no description of itself");
  EXPECT_EQ(FailsToLoad("throwing_entry", kFaulty),
            "throws an exception when the program asks for its description: ask me later");
  const std::string unresolved = FailsToLoad("unresolved", kFaulty);
  EXPECT_NE(unresolved.find("NowhereToBeFound"), std::string::npos) << unresolved;
}

TEST_F(Loader, SaysWhatIsWrongWithAFactory) {
  EXPECT_EQ(Fails("throwing_factory", {kFaulty}),
            "filter \"throwing_factory\" cannot be made: out of filters");
  EXPECT_EQ(Fails("foreign_exception", {kFaulty}),
            "filter \"foreign_exception\" cannot be made: it threw an exception without a message");
  EXPECT_EQ(Fails("null_factory", {kFaulty}),
            "filter \"null_factory\" cannot be made: its plugin returned no object");
}

TEST_F(Loader, AFactorysRefusalIsPutAtItsParameter) {
  PluginRegistry registry = Registry({kFaulty});
  EXPECT_TRUE(registry.Create<PluginKind::Filter>("refusing_factory", {}, {}, {}));
  ParamSet params;
  params.where = Here();
  ParsedParam width;
  width.type = "float";
  width.name = "width";
  width.numbers = {3};
  width.where = Here();
  width.where.line = 7;
  params.Add(width);
  try {
    registry.Create<PluginKind::Filter>("refusing_factory", params, {}, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "parameter \"width\" of filter \"refusing_factory\" is too wide for me");
    EXPECT_EQ(error.Where()->line, 7);
    EXPECT_EQ(error.Hint(), "try 2");
  }
}

TEST_F(Loader, APluginOfAnotherKindIsNotTaken) {
  fs::copy_file(kLoaderPlugins + "/samplers/random.so", folder_ / "random.so");
  EXPECT_EQ(Fails("random", {folder_.string(), kLoaderPlugins}),
            "\"random\" has the kind sampler, not filter; available: box, gaussian, "
            "mitchell, sinc, triangle");
}

TEST_F(Loader, OfTwoFoldersTheFirstCountsEvenWhereItsFileIsBroken) {
  std::ofstream(folder_ / "filters/box.so") << "text";
  EXPECT_TRUE(
      Registry({kLoaderPlugins, folder_.string()}).Create<PluginKind::Filter>("box", {}, {}, {}));
  EXPECT_NE(Fails("box", {folder_.string(), kLoaderPlugins}).find("is not a library"),
            std::string::npos);
}

TEST_F(Loader, RemovingAPluginBreaksOnlyWhatNamesIt) {
  fs::copy(kLoaderPlugins + "/filters", folder_ / "filters");
  fs::remove(folder_ / "filters/box.so");
  EXPECT_TRUE(Registry({folder_.string()}).Create<PluginKind::Filter>("gaussian", {}, {}, {}));
  EXPECT_EQ(Fails("box", {folder_.string()}),
            "there is no filter \"box\"; available: gaussian, mitchell, sinc, triangle "
            "(looked in " +
                folder_.string() + ")");
}

TEST_F(Loader, ReadsTheOlderTableOfSymbols) {
  EXPECT_EQ(Fails("old_hash_table", {EXPHOTON_BINARY_DIR "/old_hash_plugins"}), "no error");
}

TEST_F(Loader, SkipsLibrariesOfOtherPrograms) {
  fs::copy(kFaulty + "/filters/no_symbol.so", folder_ / "filters/gaussian.so",
           fs::copy_options::overwrite_existing);
  PluginRegistry registry = Registry({folder_.string(), kLoaderPlugins});
  EXPECT_STREQ(registry.Load(PluginKind::Filter, "gaussian", {}).name, "gaussian");
  ASSERT_EQ(log_.Messages().size(), 1u);
  EXPECT_NE(log_.Messages()[0].find("is skipped: it is a library, but not a plugin"),
            std::string::npos);
}

TEST_F(Loader, AliasesStandForTheirPlugins) {
  PluginRegistry registry = Registry({kLoaderPlugins});
  EXPECT_STREQ(registry.Load(PluginKind::AreaLight, "diffuse", {}).name, "area");
  EXPECT_STREQ(registry.Load(PluginKind::Sampler, "02sequence", {}).name, "lowdiscrepancy");
  EXPECT_TRUE(log_.Messages().empty());
  for (int i = 0; i < 2; ++i)
    EXPECT_STREQ(registry.Load(PluginKind::Sampler, "sobol", {}).name, "lowdiscrepancy");
  EXPECT_EQ(log_.Messages(),
            std::vector<std::string>{
                "exphoton: warning: there is no sampler \"sobol\": \"lowdiscrepancy\" is used "
                "instead; its points differ, the picture does not\n"});
}

TEST_F(Loader, FoldersComeFromTheCommandLineTheEnvironmentAndTheProgram) {
  setenv("PBRT_SEARCHPATH", "/one::/two:", 1);
  const std::vector<std::string> folders = PluginRegistry::DefaultFolders({"/usr"});
  unsetenv("PBRT_SEARCHPATH");
  ASSERT_EQ(folders.size(), 4u);
  EXPECT_EQ(folders[0], "/usr");
  EXPECT_EQ(folders[1], "/one");
  EXPECT_EQ(folders[2], "/two");
  EXPECT_EQ(fs::canonical(folders[3]), fs::canonical(kLoaderPlugins));
}

TEST_F(Loader, ParametersOfSiblingsAreRecognised) {
  PluginRegistry registry = Registry({kLoaderPlugins});
  ParamSet params;
  ParsedParam tau;
  tau.type = "float";
  tau.name = "tau";  // a parameter of the filter "sinc"
  tau.numbers = {3};
  params.Add(tau);
  BindContext bind;
  bind.log = &log_;
  bind.isStrict = true;
  EXPECT_TRUE(registry.Create<PluginKind::Filter>("box", params, bind, {}));
  EXPECT_EQ(log_.WarningCount(), 0);
  EXPECT_EQ(registry.Loaded(), std::vector<std::string>{"filters/box"});
}

}  // namespace
}  // namespace exphoton

#endif
