// SPDX-License-Identifier: BSD-2-Clause
// MeasureLowerBounds renders pictures with one camera sample and one gather ray a pixel. They are
// in the folder bounds/, beside the pictures of the study, and are found again there. They have no
// certificates.
#include <algorithm>

#include "core/app/analysis/headline/lower_bound.h"
#include "core/app/output/output_files.h"
#include "core/app/study/study_runner.h"

namespace exphoton::cli {
namespace {

// Times of different processors cannot be compared.
bool IsOfThisProcessor(const study::Results& results) {
  return std::ranges::all_of(results.runs, [&](const study::RunRow& row) {
    return !row.IsOfTask() || row.processor == results.processor;
  });
}

}  // namespace

std::vector<study::LowerBound> MeasureLowerBounds(const StudyOptions& options,
                                                  const study::Results& results,
                                                  const study::Analysis& analysis,
                                                  StudyRunner& runner) {
  std::vector<study::LowerBound> bounds;
  if (!IsOfThisProcessor(results)) return bounds;
  StudyOptions plain = options;
  plain.certifies = false;
  for (const std::size_t index : study::SettingsForLowerBounds(results, analysis)) {
    const study::Setting setting = study::LowerBoundSetting(results.settings[index]);
    Say(options, "lower bound of " + setting.integrator);
    MakeFolder(options.folder + "/bounds");
    const auto seeds = std::uint64_t(std::min(options.seeds, kMostBoundSeeds));
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const study::RunRow row = runner.RunAs("bounds/" + study::RunName(setting, seed),
                                             RunArguments(plain, setting, seed), seed);
      if (seed == 1) bounds.push_back({index, row.cpuSeconds, row.wallSeconds, row.command});
      study::LowerBound& bound = bounds.back();
      bound.cpuSeconds = std::min(bound.cpuSeconds, row.cpuSeconds);
      bound.wallSeconds = std::min(bound.wallSeconds, row.wallSeconds);
    }
  }
  return bounds;
}

}  // namespace exphoton::cli
