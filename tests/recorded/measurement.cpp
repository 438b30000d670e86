// SPDX-License-Identifier: BSD-2-Clause
// Measure renders a scene and reduces what comes out. Times are left out: the record that the texts
// are made from has none.
#include "tests/recorded/measurement.h"

#include <cctype>
#include <cstdio>
#include <sstream>

#include "core/app/output/run_record.h"
#include "tests/support/test_scene.h"

namespace exphoton::recorded {
namespace {

std::string AttributeText(const ImageAttribute& attribute) {
  std::ostringstream text;
  if (const auto* words = std::get_if<std::string>(&attribute)) text << *words;
  if (const auto* number = std::get_if<float>(&attribute)) text << *number;
  if (const auto* number = std::get_if<int>(&attribute)) text << *number;
  if (const auto* numbers = std::get_if<std::vector<float>>(&attribute))
    for (const float number : *numbers) text << number << ' ';
  return text.str();
}

std::vector<double> Quadrants(const Image& image, int channel) {
  std::vector<double> sums(4), counts(4);
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      const std::size_t quadrant =
          std::size_t((2 * x >= image.Width()) + 2 * (2 * y >= image.Height()));
      sums[quadrant] += double(image.At(x, y, channel));
      ++counts[quadrant];
    }
  }
  for (std::size_t i = 0; i < 4; ++i) sums[i] /= std::max(counts[i], 1.);
  return sums;
}

// Leaves out the folders of the sources and of the build.
std::string WithoutFolders(std::string text) {
  for (const std::string folder : {EXPHOTON_BINARY_DIR "/", EXPHOTON_SOURCE_DIR "/"})
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;)
      text.erase(at, folder.size());
  return text;
}

void MeasureTexts(const RenderSetup& setup, const TestRender& render, Measurement* result) {
  Statistics statistics;
  statistics.AddRays(render.rays);
  for (const Statistics::Counter& counter : render.counters)
    statistics.SetCounter(counter.name, counter.value, counter.meaning);
  cli::RunRecord run(setup, statistics);
  run.seed = kSeed;
  run.isComplete = render.result.isComplete;
  run.nonFiniteSamples = render.result.nonFiniteSamples;
  run.samplesPerPixel = setup.sampler->SamplesPerPixel();
  run.stoppedBy = "samples";
  result->texts["explain"] = cli::ExplainText(setup);
  result->texts["output"] = cli::StatisticsTable(run) + cli::StatisticsJson(run);
  for (const auto& [name, value] : cli::PictureAttributes(run, true))
    if (name != "software")  // the version
      result->texts["output"] += name + " " + AttributeText(value) + "\n";
  for (const std::string& message : render.messages)
    result->texts["messages"] += WithoutFolders(message) + "\n";
}

}  // namespace

Measurement Measure(const RecordedScene& scene, int threads) {
  Measurement result;
  try {
    LoadedScene loaded = LoadSceneText(scene.text);
    TestRenderOptions options;
    options.seed = kSeed;
    options.threads = threads;
    options.tileSize = 5;
    options.isStrict = false;
    options.aovs = scene.aovs;
    const TestRender render = RenderLoaded(loaded, options);
    for (int c = 0; c < render.image.ChannelCount(); ++c)
      result.numbers[render.image.channels[std::size_t(c)]] = Quadrants(render.image, c);
    for (int kind = 0; kind < kRayKindCount; ++kind)
      result.numbers["rays"].push_back(double(render.rays.counts[std::size_t(kind)]));
    if (render.rays.cutThroughput + render.rays.cutGatherThroughput > 0)
      result.numbers["cut"] = {render.rays.cutThroughput, render.rays.cutGatherThroughput};
    const double cameraRays = result.numbers["rays"][std::size_t(RayKind::Camera)];
    for (const Statistics::Counter& counter : render.counters) {
      // Most scenes have a camera ray for each sample, and no bad samples.
      const double usual = counter.name == "render/camera samples" ? cameraRays : 0;
      if (!counter.name.starts_with("render/") || counter.value != usual)
        result.numbers["counters"].push_back(counter.value);
    }
    MeasureTexts(*loaded.setup, render, &result);
  } catch (const std::exception& error) {
    result.texts["error"] = WithoutFolders(error.what());
  }
  return result;
}

std::string ShortHash(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char digits[8];
  std::snprintf(digits, sizeof digits, "%06x",
                unsigned((hash ^ hash >> 24 ^ hash >> 48) & 0xffffff));
  return digits;
}

std::vector<std::string> LinesWithoutNumbers(const Measurement& measurement) {
  std::vector<std::string> lines;
  for (const char* name : {"explain", "messages", "error"}) {
    const auto found = measurement.texts.find(name);
    if (found == measurement.texts.end()) continue;
    std::istringstream text(found->second);
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("hash ") || line.starts_with("plugins ")) continue;
      std::string known;
      for (const char c : line) {
        const bool isDigit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        if (!isDigit) known += c;
        if (isDigit && (known.empty() || known.back() != '#')) known += '#';
      }
      lines.push_back(known);
    }
  }
  return lines;
}

}  // namespace exphoton::recorded
