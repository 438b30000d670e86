// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/study/study_predictions.h"

#include <algorithm>
#include <cmath>

#include "core/app/quote/missing_light.h"
#include "core/app/quote/quote_pilots.h"
#include "core/app/study/study_runner.h"

namespace exphoton::cli {
namespace {

constexpr double kPilotSeconds = 5;
constexpr double kLargestError = .5, kSmallestError = .005;  // roots of relMSE
constexpr int kPoints = 41;

std::vector<std::string> IntegratorsOf(const std::vector<study::Setting>& settings) {
  std::vector<std::string> names;
  for (const study::Setting& setting : settings)
    if (std::ranges::find(names, setting.integrator) == names.end())
      names.push_back(setting.integrator);
  return names;
}

study::Prediction PredictionFrom(const Quote& quote, const std::vector<PilotMean>& means) {
  study::Prediction prediction{quote.integrator, quote.failure, {}};
  if (prediction.failure.empty())
    prediction.failure = MissingLight({quote.integrator, quote.light}, means);
  if (!prediction.failure.empty()) return prediction;
  for (int i = 0; i < kPoints; ++i) {
    const double t = double(i) / (kPoints - 1);
    const double error = kLargestError * std::pow(kSmallestError / kLargestError, t);
    // The line between measured numbers of samples needs prices of any number.
    if (const auto price = PriceOf(quote.model, {error}))
      prediction.points.push_back({error * error, price->seconds, price->least, price->most});
  }
  return prediction;
}

}  // namespace

std::vector<study::Prediction> Predict(const StudyOptions& options,
                                       const std::vector<study::Setting>& settings) {
  const std::vector<std::string> names = IntegratorsOf(settings);
  StudyOptions all = options;
  all.foreignSets.clear();  // the pilots know which integrators are compared
  std::vector<std::string> arguments =
      RenderArguments(all, options.scene, {"", names.front(), {}}, 0);
  arguments.erase(arguments.begin());  // the name of the command
  RenderCommand command = ParseRenderCommand(arguments, RenderMode::Render);
  command.load.comparedIntegrators = names;
  if (!options.makeReference.empty())
    command.load.comparedIntegrators.push_back(
        study::ParseSetting(options.makeReference).integrator);
  FileSource::Streams streams;
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  std::vector<Quote> quotes;
  std::vector<PilotMean> means;
  try {
    PilotRenderer renderer(command, options.scene, {"--predict", &streams, &log});
    for (const std::string& name : names) {
      Say(options, "pilots of " + name);
      quotes.push_back(RunPilots(&renderer, name, kPilotSeconds / double(names.size())));
      if (quotes.back().failure.empty()) means.push_back({name, quotes.back().light});
    }
  } catch (const LoadingStopped&) {
    throw StudyInterrupted();
  }
  std::vector<study::Prediction> predictions;
  for (const Quote& quote : quotes) predictions.push_back(PredictionFrom(quote, means));
  return predictions;
}

}  // namespace exphoton::cli
