// SPDX-License-Identifier: BSD-2-Clause
// main calls RunProgram. Everything else is in app.cpp, so that tests can call it.
#include "core/app/options/app.h"
#include "core/app/options/errors.h"

int main(int argc, char** argv) {
  int status = 0;
  const int failure = exphoton::cli::Guarded(
      [&] { status = exphoton::cli::RunProgram(std::vector<std::string>(argv, argv + argc)); });
  return failure ? failure : status;
}
