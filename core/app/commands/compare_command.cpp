// SPDX-License-Identifier: BSD-2-Clause
// RunCompare prints a table of differences and writes difference images. core/imaging computes the
// metrics.
#include "core/app/commands/compare_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/app/commands/compare_verdict.h"
#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/output/run_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/base/format.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/files/png.h"
#include "core/imaging/metrics/flip.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::string reference;
  std::vector<std::string> pictures;
  std::vector<std::string> moreReferences;
  CompareLimits bounds;
  std::string differenceFolder;  // "": no difference images
  double fullScale = .5;
  std::string limits;
};

std::string Row(const std::string& label, const std::vector<std::string>& cells) {
  constexpr std::size_t kLabelWidth = 20, kCellWidth = 16;
  std::string text = label;
  text.resize(std::max(kLabelWidth, text.size() + 1), ' ');
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::string cell = cells[i];
    if (i + 1 < cells.size()) cell.resize(std::max(kCellWidth, cell.size() + 2), ' ');
    text += cell;
  }
  return text + "\n";
}

std::string Table(const std::vector<Comparison>& all) {
  const auto row = [&](const char* label, auto&& cell) {
    std::vector<std::string> cells;
    for (const Comparison& one : all) cells.push_back(cell(one));
    return Row(label, cells);
  };
  const auto number = [&](const char* label, double ImageDifference::*member,
                          const char* format = "%.9g") {
    return row(label, [=](const Comparison& c) { return Format(format, c.difference.*member); });
  };
  std::string text;
  if (all.size() > 1) text += row("", [](const Comparison& c) { return c.name; });
  text += row("identical", [](const Comparison& c) { return c.isIdentical ? "yes" : "no"; });
  text += number("relMSE", &ImageDifference::relMse);
  text += number("trimmed relMSE", &ImageDifference::trimmedRelMse);
  text += number("MSE", &ImageDifference::mse);
  text += number("p99 error", &ImageDifference::p99);
  text += number("mean error", &ImageDifference::meanError, "%+.9g");
  text += row("relative mean error", [](const Comparison& c) {
    return Format("%+.6g %%", c.difference.relativeMeanError * 100);
  });
  text += number("mean of reference", &ImageDifference::meanReference);
  for (std::size_t i = 0; i < 3; ++i)
    text += row((std::string("relative mean of ") + "RGB"[i]).c_str(),
                [i](const Comparison& c) { return Format("%+.4g %%", c.relativeMeans[i] * 100); });
  text += row("FLIP", [](const Comparison& c) { return Format("%.6g", c.flip); });
  text += row("not finite", [](const Comparison& c) {
    return std::to_string(c.difference.nonFinitePixels) + " pixels";
  });
  if (std::any_of(all.begin(), all.end(), [](const Comparison& c) { return c.noise.has_value(); }))
    text += row("noise test", [](const Comparison& c) {
      return NoiseText(c).empty() ? std::string("none") : NoiseText(c);
    });
  return text;
}

bool AreIdentical(const Image& a, const Image& b) {
  const auto isSame = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.data == b.data && a.channels == b.channels &&
         std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(), isSame);
}

// Returns the relative difference of the mean of each channel, over pixels that are finite.
std::array<double, 3> RelativeMeans(const Image& reference, const Image& picture) {
  const auto from = FindColors(reference, "the reference"), to = FindColors(picture, "the picture");
  std::array<double, 3> sums{}, differences{};
  for (int y = 0; y < picture.Height(); ++y) {
    for (int x = 0; x < picture.Width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double r = double(reference.At(x, y, from[c])), v = double(picture.At(x, y, to[c]));
        if (!std::isfinite(r) || !std::isfinite(v)) continue;
        sums[c] += r;
        differences[c] += v - r;
      }
    }
  }
  std::array<double, 3> relative{};
  for (std::size_t c = 0; c < 3; ++c)
    if (differences[c] != 0) relative[c] = sums[c] != 0 ? differences[c] / sums[c] : HUGE_VAL;
  return relative;
}

// Errors name the files, because the command reads several.
Comparison Compare(const CompareOptions& options, const std::vector<Image>& references,
                   const std::string& name, const Image& picture) {
  const Image& reference = references.front();
  FindColors(reference, options.reference);
  FindColors(picture, name);
  Comparison result;
  result.name = fs::path(name).filename().string();
  try {
    result.difference = CompareImages(reference, picture);
    result.noise = TestNoise(references, picture, name, options.bounds);
  } catch (const ImageError& error) {
    const std::string text = error.what();
    throw ImageError(text.starts_with(name + ": ") ? text : name + ": " + text);
  }
  result.isIdentical = AreIdentical(reference, picture);
  result.relativeMeans = RelativeMeans(reference, picture);
  result.flip = FlipError(reference, picture);
  return result;
}

constexpr const char* kDifferenceEndings[] = {".exr", ".png", "-R.png", "-G.png", "-B.png"};

// Returns the path without extension.
std::string DifferenceName(const CompareOptions& options, const std::string& picture) {
  return (fs::path(options.differenceFolder) / fs::path(picture).stem()).string() + "-difference";
}

// Checks the files to write. Two pictures with the same name in different folders are refused,
// because they would share a difference image.
void CheckFiles(const CompareOptions& options) {
  if (options.differenceFolder.empty()) return;
  MakeFolder(options.differenceFolder);
  RunFiles files;
  files.AddInput(options.reference, "this command");
  for (const std::string& name : options.moreReferences) files.AddInput(name, "this command");
  for (std::size_t i = 0; i < options.pictures.size(); ++i) {
    const std::string& picture = options.pictures[i];
    files.AddInput(picture, "this command");
    for (const char* ending : kDifferenceEndings)
      files.AddOutput(
          std::to_string(i) + ending,
          {DifferenceName(options, picture) + ending, "the difference image of \"" + picture + '"',
           "compare these pictures one at a time, with another --difference DIR"});
  }
  Log log;
  files.Check(log);
}

void WriteDifference(const CompareOptions& options, const Image& reference, const std::string& name,
                     const Image& picture) {
  const std::string base = DifferenceName(options, name);
  WriteExr(base + ".exr", DifferenceImage(reference, picture), false);
  WritePng(base + ".png", SignedErrorImage(reference, picture, options.fullScale));
  for (int c = 0; c < 3; ++c)
    WritePng(base + kDifferenceEndings[2 + c],
             SignedErrorImage(reference, picture, options.fullScale, c));
}

void CheckSignificance(double significance) {
  if (!(significance > 0 && significance <= .5))
    FailUsage("--significance takes a probability above 0 and at most 0.5");
}

CompareOptions ParseCompareOptions(const std::vector<std::string>& arguments) {
  CompareOptions options;
  OptionParser app(
      "Measures how far pictures are from a reference (R, G and B), and tests whether they differ "
      "by more than their noise. The last line is the verdict. Exit status: 0 all pass, 1 one "
      "fails, 2 they cannot be compared.",
      "exphoton compare");
  app.Add("reference", options.reference, "EXR or PNG").Required();
  app.Add("pictures", options.pictures, "EXR or PNG files of the same size").Required();
  app.Group("Limits");
  app.Add("--max-relmse", options.bounds.maxRelMse, "largest relMSE of pictures that pass")
      .AtLeastZero();
  app.Add("--max-mean", options.bounds.maxMean,
          "largest relative error of the mean of R, G and B: 0.01 is 1 %")
      .AtLeastZero();
  app.Group("Noise");
  app.AddFlag("--z-test", options.bounds.requiresNoiseTest,
              "require that no difference exceeds the noise; without limits this is done anyway "
              "where the pictures say how noisy they are (render --two-halves, or --aov variance)");
  app.Add("--significance", options.bounds.significance,
          "probability that pictures that differ by noise alone fail (default 0.01)");
  app.Add("--more-reference", options.moreReferences,
          "another render of the reference by another seed; each one sharpens the noise test")
      .TypeName("FILE")
      .OnePerUse();
  app.Group("Difference pictures");
  app.Add("--difference", options.differenceFolder,
          "write NAME-difference.exr (layers: signed, relative, squared error, FLIP), "
          "NAME-difference.png (red: too bright, blue: too dark) and the same for each channel "
          "(NAME-difference-R.png) to this folder")
      .TypeName("DIR");
  app.Add("--scale", options.fullScale, "relative error of full red or blue (default 0.5)")
      .Positive();
  app.Group("Files");
  AddLimitsOption(app, &options.limits);
  app.Footer(
      "relMSE: mean over pixels and colours of (x-r)^2 / (r^2 + 0.01); trimmed: without the "
      "worst thousandth of the pixels; p99 error: 99 % of the pixels have a smaller root of their "
      "relMSE; "
      "FLIP: visible difference, 0 to 1 (LDR-FLIP, mean luminance of the reference at 0.18).");
  app.Parse(arguments);
  CheckSignificance(options.bounds.significance);
  return options;
}

// Reads a picture with colours times alpha, so that a PNG can be compared with an EXR.
Image ReadPremultiplied(const std::string& path) {
  Image image = ReadImage(path);
  PremultiplyAlpha(&image);
  return image;
}

// Each further reference must be another render. The same pixels again would hide their own noise.
void CheckOthers(const CompareOptions& options, const std::vector<Image>& references,
                 const std::string& name, const Image& picture, std::size_t first) {
  const auto nameOf = [&](std::size_t i) {
    return i == 0 ? options.reference : options.moreReferences[i - 1];
  };
  for (std::size_t i = first; i < references.size(); ++i)
    if (AreIdentical(references[i], picture))
      throw Error(ExitStatus::CommandLine,
                  "\"" + name + "\" has the pixels of the reference \"" + nameOf(i) +
                      "\", so the noise test would count them twice",
                  {}, "--more-reference takes another render of the reference, by another --seed");
}

std::vector<Image> ReadReferences(const CompareOptions& options) {
  std::vector<Image> references{ReadPremultiplied(options.reference)};
  for (const std::string& name : options.moreReferences) {
    Image image = ReadPremultiplied(name);
    CheckOthers(options, references, name, image, 0);
    references.push_back(std::move(image));
  }
  return references;
}

}  // namespace

int RunCompare(const std::vector<std::string>& arguments) {
  constexpr int kDifferent = 1, kTrouble = 2;
  bool isSame = true;  // stays true if only help was requested
  const int status = Guarded([&] {
    const CompareOptions options = ParseCompareOptions(arguments);
    const Limits limits = ParseLimits(options.limits);
    LimitMemory(limits);
    const InterruptWatch watch(limits.seconds);
    CheckFiles(options);
    const std::vector<Image> references = ReadReferences(options);
    std::vector<Comparison> all;
    std::string verdicts;
    for (const std::string& name : options.pictures) {
      const Image picture = ReadPremultiplied(name);
      CheckOthers(options, references, name, picture, 1);
      all.push_back(Compare(options, references, name, picture));
      const Verdict verdict = Judge(all.back(), options.bounds);
      isSame &= verdict.isPass;
      verdicts += (options.pictures.size() > 1 ? all.back().name + ": " : "") + verdict.text + "\n";
      if (!options.differenceFolder.empty())
        WriteDifference(options, references.front(), name, picture);
    }
    PrintOut(Table(all) + verdicts);
  });
  if (status != 0) return kTrouble;
  return isSame ? 0 : kDifferent;
}

}  // namespace exphoton::cli
