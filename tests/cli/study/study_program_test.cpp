// SPDX-License-Identifier: BSD-2-Clause
// These tests count how often a study reads the program's plugins. The fingerprint of the program
// covers all plugins, and computing it reads tens of megabytes.
#include <sys/inotify.h>
#include <unistd.h>

#include <filesystem>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

class StudyProgramTest : public ProgramTest {
 protected:
  StudyProgramTest() : notify_(inotify_init1(IN_NONBLOCK)) {
    Write("box.pbrt", SmallScene());
    fs::create_directories(Path("mine/integrators"));
    Write("mine/integrators/unused.so", "not named by any scene");
    // A close separates two opens, which would otherwise merge into one event.
    inotify_add_watch(notify_, Path("mine/integrators/unused.so").c_str(),
                      IN_OPEN | IN_CLOSE_NOWRITE);
  }
  ~StudyProgramTest() override { close(notify_); }

  // Runs a study with these options and returns how often it opened the unused plugin.
  int OpensOf(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"study",     "box.pbrt",     "--integrators", "path",
                                       "--vary",    "spp=1,2",      "--seeds",       "1",
                                       "--no-maps", "--plugin-dir", "mine"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    alignas(inotify_event) char buffer[1 << 16];
    int opens = 0;
    for (ssize_t size; (size = read(notify_, buffer, sizeof buffer)) > 0;) {
      for (ssize_t at = 0; at < size;) {
        const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
        opens += (event->mask & IN_OPEN) != 0;
        at += ssize_t(sizeof *event) + ssize_t(event->len);
      }
    }
    return opens;
  }

 private:
  int notify_;
};

// A plan computes the fingerprint once and renders nothing.
TEST_F(StudyProgramTest, ReadsThePluginsAsOftenAsAPlanDoes) {
  const int planOpens = OpensOf({"--plan"});
  ASSERT_GT(planOpens, 0);
  EXPECT_EQ(OpensOf({"--out", "out"}), planOpens);
}

}  // namespace
}  // namespace exphoton
