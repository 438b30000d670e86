// SPDX-License-Identifier: BSD-2-Clause
// The main function of test programs. Each process has a temporary folder of its own, so tests that
// run at the same time may write files of the same name.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/process.h"

int main(int argc, char** argv) {
  const exphoton::TestFolder folder;
  setenv("TMPDIR", folder.Path().c_str(), 1);
  setenv("TEST_TMPDIR", folder.Path().c_str(), 1);  // what testing::TempDir reads
  testing::InitGoogleTest(&argc, argv);  // makes parameters of tests, which may write files
  return RUN_ALL_TESTS();
}
