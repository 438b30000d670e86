// SPDX-License-Identifier: BSD-2-Clause
// WritePngPicture chooses the exposure, reports it and writes the file.
#include "core/app/output/png_output.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/base/format.h"
#include "core/base/log.h"
#include "core/imaging/files/png.h"

namespace exphoton::cli {
namespace {

constexpr double kMaxLoss = .2;  // of the pixels; more cause a hint
constexpr float kMaxStops = 100;

// Returns the extension in lower case, with its dot.
std::string Extension(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return ending;
}

std::optional<float> Stops(const std::string& text) {
  float value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || next != end || !(std::abs(value) <= kMaxStops)) return {};
  return value;
}

void HintAtLoss(const std::string& path, const Image& image, const ToneMapping& tone, Log& log) {
  const ToneLoss loss = MeasureToneLoss(image, tone);
  if (loss.clipped + loss.black <= kMaxLoss) return;
  log.Notice(Format("%.0f %% of the pixels of \"", 100 * (loss.clipped + loss.black)) + path +
                 Format("\" are lost: %.0f %% clipped, %.0f %% black", 100 * loss.clipped,
                        100 * loss.black),
             {},
             Format("--exposure auto would choose %.2f; --tone-curve filmic keeps highlights",
                    double(AutoExposure(image))));
}

}  // namespace

void AddPngOptions(OptionParser& app, PngOptions* options) {
  app.Add("--exposure", options->exposure,
          "for PNG: multiply by 2 to this power (default 0); auto: chosen by the mean brightness, "
          "and printed")
      .TypeName("EV|auto");
  app.Add("--tone-curve", options->curve,
          "for PNG: clamp cuts values above 1 (default); filmic rolls highlights off")
      .OneOf({"clamp", "filmic"});
}

void CheckPngOptions(const PngOptions& options) {
  const std::string& text = options.exposure;
  if (!text.empty() && text != "auto" && !Stops(text))
    FailUsage("--exposure takes stops from -100 to 100, or auto, not \"" + text + '"');
}

void WritePngPicture(const std::string& path, const Image& image, const PngOptions& options,
                     Log& log) {
  ToneMapping tone;
  if (options.curve == "filmic") tone.curve = ToneCurve::Filmic;
  if (options.exposure == "auto") {
    tone.exposure = AutoExposure(image);
    log.Notice("exposure of \"" + path + Format("\": %.2f", double(tone.exposure)));
  } else {
    tone.exposure = Stops(options.exposure).value_or(0);
  }
  WritePng(path, image, tone);
  if (options.exposure != "auto") HintAtLoss(path, image, tone, log);
}

bool IsPngName(const std::string& path) { return Extension(path) == ".png"; }
bool IsExrName(const std::string& path) { return Extension(path) == ".exr"; }

std::string ExrName(const std::string& path) {
  if (IsExrName(path)) return path;
  for (const char* ending :
       {".png", ".tga", ".pfm", ".jpg", ".jpeg", ".hdr", ".tif", ".tiff", ".bmp", ".ppm", ".gif"})
    if (Extension(path) == ending)
      return std::filesystem::path(path).replace_extension(".exr").string();
  return path + ".exr";
}

}  // namespace exphoton::cli
