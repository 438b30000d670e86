// SPDX-License-Identifier: BSD-2-Clause
// Runs the built program in a folder of its own, as a user would, and looks at what it leaves.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/support/process.h"

namespace exphoton {

using ProgramResult = ProcessResult;

// A test with an empty folder, which is the program's working folder and is removed at the end.
class ProgramTest : public testing::Test {
 protected:
  // `input`: what standard input holds.
  ProgramResult Run(const std::vector<std::string>& arguments, const std::string& input = "") const;
  // Starts it without waiting; Wait gives its result.
  pid_t Start(const std::vector<std::string>& arguments, const std::string& input = "") const;
  ProgramResult Wait(pid_t process) const;
  // Waits until what Start began has said this on standard error; false after 30 s.
  bool WaitForMessage(const std::string& text) const;

  std::string Path(const std::string& name) const { return folder_.File(name); }
  void Write(const std::string& name, const std::string& text) const;
  std::string Read(const std::string& name) const;
  bool Exists(const std::string& name) const;
  // Sorted names of all files, except what the test's own plumbing made.
  std::vector<std::string> Files() const { return folder_.Names(); }

 private:
  TestFolder folder_;
};

// A lit sphere, rendered in no time to "out.exr"; `options` stand before WorldBegin, `world` after.
std::string SmallScene(const std::string& options = "", const std::string& world = "");

}  // namespace exphoton
