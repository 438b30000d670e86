// SPDX-License-Identifier: BSD-2-Clause
// ProgramTest runs the built program in a temporary folder, as a user would, and inspects the files
// that the program leaves there.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstdio>
#include <string>
#include <vector>

#include "tests/support/process.h"

namespace exphoton {

using ProgramResult = ProcessResult;

// ProgramTest gives each test an empty folder. The folder is the program's working folder and is
// removed at the end of the test.
class ProgramTest : public testing::Test {
 protected:
  // The program reads `input` from its standard input.
  ProgramResult Run(const std::vector<std::string>& arguments, const std::string& input = "") const;
  // Starts the program without waiting for it. Wait returns its result.
  pid_t Start(const std::vector<std::string>& arguments, const std::string& input = "") const;
  ProgramResult Wait(pid_t process) const;
  // Waits until the started program has written this text to standard error. Returns
  // false after 30 s.
  bool WaitForMessage(const std::string& text) const;

  std::string Path(const std::string& name) const { return folder_.File(name); }
  void Write(const std::string& name, const std::string& text) const;
  std::string Read(const std::string& name) const;
  bool Exists(const std::string& name) const;
  void Remove(const std::string& name) const { std::remove(folder_.File(name).c_str()); }
  // Returns the sorted names of all files, except the files that the test harness makes.
  std::vector<std::string> Files() const { return folder_.Names(); }

  // Whether a text contains a part of it.
  static void ExpectIn(const std::string& part, const std::string& text) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nnot in\n" << text;
  }
  static void ExpectNotIn(const std::string& part, const std::string& text) {
    EXPECT_EQ(text.find(part), std::string::npos) << part << "\nis in\n" << text;
  }

 private:
  TestFolder folder_;
};

// Returns a scene with a lit sphere that renders quickly to "out.exr". `options` are placed before
// WorldBegin and `world` after it.
std::string SmallScene(const std::string& options = "", const std::string& world = "");

// Returns a closed round room with a lamp and a ball, for exphotonmap, of 24 x 16 pixels.
std::string SmallRoom();
// A room in which few paths from the camera meet a lamp that only a mirror behind it shows. The
// lamp has 4 % of the light, so that pilots of path miss it, and a picture meets it.
std::string RoomWithAHiddenLamp();

}  // namespace exphoton
