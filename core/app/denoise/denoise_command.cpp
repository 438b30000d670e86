// SPDX-License-Identifier: BSD-2-Clause
// RunDenoise checks the layers of the picture and writes the filtered picture as EXR or PNG.
#include "core/app/denoise/denoise_command.h"

#include <algorithm>
#include <cmath>

#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/exr_output.h"
#include "core/app/output/png_output.h"
#include "core/app/output/run_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/base/error.h"
#include "core/base/format.h"
#include "core/base/log.h"
#include "core/imaging/denoise/denoise.h"

namespace exphoton::cli {
namespace {

struct DenoiseOptions {
  std::string from, to, limits;
  PngOptions png;
  int threads = 0;
  bool asFloat = false;
};

DenoiseOptions ParseDenoiseOptions(const std::vector<std::string>& arguments) {
  DenoiseOptions options;
  OptionParser app(
      "Filters the noise of a picture that was rendered with --two-halves --aov albedo,N,Z.",
      "exphoton denoise");
  app.Add("picture", options.from, "the EXR picture to filter").Required();
  app.Add("-o,--outfile", options.to, "NAME.exr or NAME.png (default: PICTURE-denoised.exr)")
      .TypeName("FILE");
  app.Add("--nthreads,--ncores", options.threads, "threads; 0: all cores").Between(0, 4096);
  app.AddFlag("--float", options.asFloat, "for EXR: 32-bit channels");
  AddPngOptions(app, &options.png);
  AddLimitsOption(app, &options.limits);
  app.Parse(arguments);
  CheckPngOptions(options.png);
  if (options.to.empty()) {
    const std::string exr = ExrName(options.from);
    options.to = exr.substr(0, exr.size() - 4) + "-denoised.exr";
  }
  const bool isPng = IsPngName(options.to);
  if (!isPng && !IsExrName(options.to))
    FailUsage("\"" + options.to + "\" ends neither in .exr nor .png");
  if (!isPng && options.png.IsGiven())
    FailUsage("--exposure and --tone-curve are for PNG: an EXR stays linear");
  if (isPng && options.asFloat) FailUsage("--float is for EXR: a PNG has 8 bits");
  return options;
}

void CheckLayers(const Image& picture, const std::string& name) {
  const std::vector<std::string> missing = MissingDenoiseLayers(picture);
  if (missing.empty()) return;
  std::string list;
  for (const std::string& layer : missing) list += (list.empty() ? "" : ", ") + layer;
  throw Error(
      ExitStatus::File,
      "\"" + name + "\" lacks " + (missing.size() == 1 ? "the layer " : "the layers ") + list, {},
      "render with --two-halves --aov albedo,N,Z");
}

std::string PercentText(double noise) {
  return Format("\u00b1%.2g %%", 100 * std::sqrt(std::max(noise, 0.)));
}

std::string TextOf(const Outliers& outliers) {
  const double percent = 100 * outliers.light;
  const std::string lost = percent < .01  ? "less than 0.01"
                           : percent < 10 ? Format("%.2g", percent)
                                          : Format("%.0f", percent);
  return Format("dimmed %lld %s that one half alone has found, and lost %s %% of the light",
                outliers.pixels, outliers.pixels == 1 ? "outlier" : "outliers", lost.c_str());
}

void Filter(const DenoiseOptions& options) {
  RunFiles files;
  files.AddInput(options.from, "this command");
  files.AddOutput("to", {options.to, "the picture", "-o FILE names another file"});
  Log log;
  files.Check(log);
  const Limits limits = ParseLimits(options.limits);
  LimitMemory(limits);
  const InterruptWatch watch(limits.seconds);
  const Image picture = ReadImage(options.from);
  CheckLayers(picture, options.from);
  ThreadPool threads(options.threads);
  DenoiseResult result = Denoise(picture, threads);
  if (result.nonFinite > 0)
    log.Warning(std::to_string(result.nonFinite) +
                (result.nonFinite == 1 ? " pixel is not finite and stays as it is"
                                       : " pixels are not finite and stay as they are"));
  if (result.outliers.pixels > 0) log.Notice(TextOf(result.outliers));
  result.picture.attributes["denoised"] = std::string("non-local means of two halves");
  result.picture.attributes["residualNoise"] = float(result.residualNoise);
  if (IsPngName(options.to))
    WritePngPicture(options.to, result.picture, options.png, log);
  else
    WriteExrPicture(options.to, result.picture, !options.asFloat, log);
  log.Notice("wrote \"" + options.to + "\": noise " + PercentText(result.noise) + " before and " +
             PercentText(result.residualNoise) + " after (bias not included)");
}

}  // namespace

int RunDenoise(const std::vector<std::string>& arguments) {
  return Guarded([&] { Filter(ParseDenoiseOptions(arguments)); });
}

}  // namespace exphoton::cli
