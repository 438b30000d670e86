// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/options/accuracy_option.h"

#include "core/app/options/errors.h"
#include "core/app/options/values.h"

namespace exphoton::cli {

// The dial chooses the settings of the excluded options.
void TakeAccuracy(const std::string& percentage, RenderCommand* command) {
  if (command->keepsSettings && percentage.empty()) FailUsage("--keep needs --accuracy");
  if (percentage.empty()) return;
  command->accuracy = ParsePercentage("--accuracy", percentage);
  const auto exclude = [](bool isGiven, const char* option) {
    if (isGiven) FailUsage(std::string("--accuracy and ") + option + " exclude each other");
  };
  exclude(command->load.samplesPerPixel.has_value(), "--spp");
  exclude(command->targetError.has_value(), "--target-error");
  exclude(command->asTwoHalves, "--two-halves");
  exclude(command->certifies, "--certify");
  exclude(command->isProgressive, "--progressive");
  exclude(command->load.isQuick, "--quick");
  if (command->maxPasses == 1)
    FailUsage("--accuracy needs --max-passes 2 at least: the error shows between two passes");
}

}  // namespace exphoton::cli
