// SPDX-License-Identifier: BSD-2-Clause
// These tests check how the loader handles materials that it cannot find.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/plugins/registry.h"

#ifndef EXPHOTON_STATIC_PLUGINS

namespace exphoton {
namespace {

namespace fs = std::filesystem;

class MissingMaterials : public ::testing::Test {
 protected:
  MissingMaterials() {
    folder_ = fs::path(::testing::TempDir()) / ("exphoton_materials_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "materials");
    fs::permissions(folder_ / "materials", fs::perms(0755));
  }
  ~MissingMaterials() override { fs::remove_all(folder_); }

  void AddPlugin(const std::string& name) {
    const fs::path file = folder_ / "materials" / (name + ".so");
    fs::copy_file(EXPHOTON_BINARY_DIR "/plugins/materials/" + name + ".so", file);
    fs::permissions(file, fs::perms(0644));
  }

  fs::path folder_;
  Log log_{Log::Level::Normal, Log::Sink::Memory};
};

// "matte" replaces unknown materials, but not itself.
TEST_F(MissingMaterials, AreErrorsWhereMatteIsMissingToo) {
  PluginRegistry registry(std::vector<std::string>{folder_.string()}, &log_);
  for (const std::string name : {"matte", "mattte"}) {
    try {
      registry.Find(PluginKind::Material, name, {"a.pbrt", 2, 1, "Material", nullptr});
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.Status(), ExitStatus::Scene);
      EXPECT_EQ(error.what(), "there is no material \"" + name +
                                  "\"; no plugin of this kind was found (looked in " +
                                  folder_.string() + ")");
    }
  }
  EXPECT_TRUE(log_.Messages().empty());
}

// The library of a plugin that a scene allows keeps its descriptor open, so it must not be loaded
// again for each name.
TEST_F(MissingMaterials, OpenNoFileAgain) {
  AddPlugin("matte");
  AddPlugin("mirror");
  PluginRegistry registry({{folder_.string(), PluginTrust::Allowed}}, &log_);
  const auto load = [&](int number) {
    EXPECT_STREQ(registry.Load(PluginKind::Material, "mirror" + std::to_string(number), {}).name,
                 "matte");
  };
  const auto descriptors = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  load(0);
  const auto before = descriptors();
  for (int i = 0; i < 40; ++i) load(i / 2);
  EXPECT_EQ(descriptors(), before);
  const std::vector<std::string> messages = log_.Messages();
  ASSERT_EQ(messages.size(), 20u);
  for (const std::string& message : messages)
    EXPECT_NE(message.find("did you mean \"mirror\"?"), std::string::npos) << message;
  EXPECT_EQ(registry.Loaded(), std::vector<std::string>{"materials/matte"});
}

}  // namespace
}  // namespace exphoton

#endif
