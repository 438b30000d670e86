// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/output/output_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "tests/support/process.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// As if the folder was removed, or the disk became full, while the picture was rendered.
TEST(WriteOrKeepElsewhere, KeepsWhatCannotBeWrittenToItsPlace) {
  const TestFolder folder;
  const std::string path = folder.File("removed/picture.exr");
  const auto write = [](const std::string& name) { WriteTextFile(name, "pixels"); };
  try {
    WriteOrKeepElsewhere(path, write);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::File);
    const std::string text = error.what(), before = "it is written to \"";
    EXPECT_NE(text.find('"' + path + '"'), std::string::npos) << text;
    const std::size_t begin = text.find(before) + before.size();
    const std::string kept = text.substr(begin, text.find('"', begin) - begin);
    EXPECT_EQ(fs::path(kept).filename(), "picture.exr") << text;
    EXPECT_EQ(TextOf(kept), "pixels");
    fs::remove_all(fs::path(kept).parent_path());
  }
  WriteOrKeepElsewhere(folder.File("picture.exr"), write);
  EXPECT_EQ(TextOf(folder.File("picture.exr")), "pixels");
}

// A file that cannot be written anywhere has its own error.
TEST(WriteOrKeepElsewhere, ThrowsTheFirstErrorIfNoPlaceIsLeft) {
  int calls = 0;
  try {
    WriteOrKeepElsewhere("a.exr", [&](const std::string&) {
      throw Error(ExitStatus::File, "failure " + std::to_string(++calls));
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "failure 1");
  }
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace exphoton::cli
