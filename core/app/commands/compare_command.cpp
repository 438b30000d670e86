// SPDX-License-Identifier: BSD-2-Clause
// RunCompare prints a table of differences and writes difference images. core/imaging computes the
// metrics.
#include "core/app/commands/compare_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

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
  double maxRelMse = -1, maxMean = -1;  // < 0: no bound
  std::string differenceFolder;         // "": no difference images
  double fullScale = .5;
  std::string limits;
};

struct Comparison {
  std::string name;
  bool isIdentical = false;
  ImageDifference difference;
  double flip = 0;
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
  text += row("FLIP", [](const Comparison& c) { return Format("%.6g", c.flip); });
  text += row("not finite", [](const Comparison& c) {
    return std::to_string(c.difference.nonFinitePixels) + " pixels";
  });
  return text;
}

bool AreIdentical(const Image& a, const Image& b) {
  const auto isSame = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return a.data == b.data && a.channels == b.channels &&
         std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(), isSame);
}

// Errors name the files, because the command reads several.
Comparison Compare(const std::string& referenceName, const Image& reference,
                   const std::string& name, const Image& picture) {
  FindColors(reference, referenceName);
  FindColors(picture, name);
  Comparison result;
  result.name = fs::path(name).filename().string();
  try {
    result.difference = CompareImages(reference, picture);
  } catch (const ImageError& error) {
    throw ImageError(name + ": " + error.what());
  }
  result.isIdentical = AreIdentical(reference, picture);
  result.flip = FlipError(reference, picture);
  return result;
}

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
  for (std::size_t i = 0; i < options.pictures.size(); ++i) {
    const std::string& picture = options.pictures[i];
    files.AddInput(picture, "this command");
    for (const char* ending : {".exr", ".png"})
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
}

bool IsWithin(const CompareOptions& options, const Comparison& one) {
  if (one.isIdentical) return one.difference.nonFinitePixels == 0;
  const bool isBounded = options.maxRelMse >= 0 || options.maxMean >= 0;
  const ImageDifference& d = one.difference;
  return isBounded && d.nonFinitePixels == 0 &&
         (options.maxRelMse < 0 || d.relMse <= options.maxRelMse) &&
         (options.maxMean < 0 || std::abs(d.relativeMeanError) <= options.maxMean);
}

CompareOptions ParseCompareOptions(const std::vector<std::string>& arguments) {
  CompareOptions options;
  OptionParser app(
      "Measures how far pictures are from a reference (R, G and B). Exit status: 0 all the same, "
      "1 one differs, 2 they cannot be compared.",
      "exphoton compare");
  app.Add("reference", options.reference, "EXR or PNG").Required();
  app.Add("pictures", options.pictures, "EXR or PNG files of the same size").Required();
  app.Add("--max-relmse", options.maxRelMse, "largest relMSE of pictures that count as the same")
      .AtLeastZero();
  app.Add("--max-mean", options.maxMean, "largest relative error of their means").AtLeastZero();
  app.Add("--difference", options.differenceFolder,
          "write NAME-difference.exr (layers: signed, relative, squared error, FLIP) and "
          "NAME-difference.png (red: too bright, blue: too dark) to this folder")
      .TypeName("DIR");
  app.Add("--scale", options.fullScale, "relative error of full red or blue (default 0.5)")
      .Positive();
  AddLimitsOption(app, &options.limits);
  app.Footer(
      "relMSE: mean over pixels and colours of (x-r)^2 / (r^2 + 0.01); trimmed: without the "
      "worst thousandth of the pixels; p99 error: 99 % of the pixels have a smaller root of their "
      "relMSE; "
      "FLIP: visible difference, 0 to 1 (LDR-FLIP, mean luminance of the reference at 0.18).");
  app.Parse(arguments);
  return options;
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
    const Image reference = ReadImage(options.reference);
    std::vector<Comparison> all;
    for (const std::string& name : options.pictures) {
      const Image picture = ReadImage(name);
      all.push_back(Compare(options.reference, reference, name, picture));
      isSame &= IsWithin(options, all.back());
      if (!options.differenceFolder.empty()) WriteDifference(options, reference, name, picture);
    }
    PrintOut(Table(all));
  });
  if (status != 0) return kTrouble;
  return isSame ? 0 : kDifferent;
}

}  // namespace exphoton::cli
