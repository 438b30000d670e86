// SPDX-License-Identifier: BSD-2-Clause
// The program's entry; everything else is in app.cpp, so that tests can call it.
#include "core/cli/app.h"

int main(int argc, char** argv) {
  return exphoton::cli::RunProgram(std::vector<std::string>(argv, argv + argc));
}
