// SPDX-License-Identifier: BSD-2-Clause
// Gallery reads pictures when they are shown, so that only a few are in memory.
#include "core/app/report/gallery.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/app/analysis/numbers.h"
#include "core/app/report/markup.h"
#include "core/app/report/page_pictures.h"
#include "core/base/format.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/metrics/flip.h"
#include "core/imaging/metrics/metrics.h"

namespace exphoton::study {
namespace {

constexpr double kErrorScale = .5;  // relative error shown as full red or blue
constexpr double kFlipScale = .5;   // FLIP shown as the last colour
constexpr std::size_t kCrops = 2;

// Returns the one of these settings whose `member` is nearest to `value` (log ratio).
std::size_t Nearest(const Analysis& analysis, const std::vector<std::size_t>& settings,
                    double value, Measured CostPoint::*member) {
  std::size_t nearest = settings.front();
  double least = 1e300;
  for (const std::size_t i : settings) {
    const double v = (analysis.settings[i].cost.*member).value;
    const double distance = v > 0 ? std::abs(std::log(v / value)) : 1e299;
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

}  // namespace

double CommonTime(const Analysis& analysis) {
  double time = 1e300;
  for (const Contender& contender : analysis.contenders)
    if (contender.toTarget.kind != TimeToError::Kind::Never)
      time = std::min(time, contender.toTarget.seconds.value);
  if (time < 1e300) return time;
  std::vector<double> times;
  for (const SettingResult& s : analysis.settings) times.push_back(s.cost.seconds.value);
  std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
  return times[times.size() / 2];
}

Shot NearestInTime(const Analysis& analysis, std::size_t line, double seconds) {
  const std::vector<std::size_t>& own = analysis.lines[line].settings;
  std::vector<std::size_t> front;
  for (const std::size_t i : ParetoFront(analysis.Points(own))) front.push_back(own[i]);
  return {line, Nearest(analysis, front.empty() ? own : front, seconds, &CostPoint::seconds)};
}

Shot NearestInError(const Analysis& analysis, std::size_t line, double error) {
  const std::vector<std::size_t>& own = analysis.lines[line].settings;
  const std::vector<std::size_t> front = analysis.Front(own);
  return {line, Nearest(analysis, front.empty() ? own : front, error, &CostPoint::error)};
}

std::string OffText(double ratio, const char* more, const char* less) {
  constexpr double kClose = 2;
  if (!(ratio > 0) || !std::isfinite(ratio)) return "";
  if (ratio >= kClose) return "closest: " + ShortNumber(ratio) + " times the " + more;
  if (ratio <= 1 / kClose) return "closest: " + ShareText(ratio) + " of the " + less;
  return "";
}

Gallery::Gallery(const std::string& folder, const Results& results, const Analysis& analysis,
                 const std::vector<Shot>& shots)
    : folder_(folder), results_(results), analysis_(analysis) {
  constexpr double kTall = 1.2;  // pictures of a smaller aspect ratio count as tall
  std::vector<Image> pictures;
  for (const Shot& shot : shots) pictures.push_back(Read(shot.setting));
  reference_ = analysis.hasReference ? analysis.reference.mean : pictures.front();
  scale_ = DisplayScale(reference_);
  isTall_ = double(reference_.Width()) / reference_.Height() < kTall;
  crops_ = results.crops;
  if (crops_.empty()) crops_ = WorstWindows(pictures, reference_, kCrops);
}

Image Gallery::Read(std::size_t setting) const {
  const std::size_t run = analysis_.settings[setting].runs.front();
  return ReadExr(PathOf(folder_, results_.runs[run].image));
}

Html Gallery::Shown(const Image& image, const std::string& alt) const {
  return PictureElement(image, scale_, alt, false);
}

Html Gallery::Crops(const Image& image, const std::string& of) const {
  Html crops;
  for (std::size_t i = 0; i < crops_.size(); ++i)
    crops += Fill(
        "crop",
        {{"number", i % kCrops},
         {"picture", PictureElement(CropOf(image, crops_[i]), scale_, "part of " + of, true)}});
  return Fill("crops", {{"crops", crops}});
}

Html Gallery::Frames() const {
  Html frames;
  for (std::size_t i = 0; i < crops_.size(); ++i) {
    const auto& [x0, x1, y0, y1] = crops_[i];
    frames += Fill("frame", {{"number", i % kCrops},
                             {"left", Percent(x0)},
                             {"top", Percent(y0)},
                             {"width", Percent(x1 - x0)},
                             {"height", Percent(y1 - y0)}});
  }
  return frames;
}

std::string Gallery::PosterKind() const {
  if (isTall_) return "tall";
  // Enlarged parts cover this share of the picture in one of its corners.
  constexpr double kWidth = .54, kHeight = .3;
  const auto covered = [&](bool isLeft, bool isTop) {
    double area = 0;
    const double x = isLeft ? 0 : 1 - kWidth, y = isTop ? 0 : 1 - kHeight;
    for (const auto& [x0, x1, y0, y1] : crops_)
      area += std::max(0., std::min(x1, x + kWidth) - std::max(x0, x)) *
              std::max(0., std::min(y1, y + kHeight) - std::max(y0, y));
    return area;
  };
  const char* best = "broad";
  double least = covered(false, false);
  for (const auto& [kind, isLeft, isTop] :
       {std::tuple("broad left", true, false), std::tuple("broad upper", false, true),
        std::tuple("broad upper left", true, true)})
    if (covered(isLeft, isTop) < least) least = covered(isLeft, isTop), best = kind;
  return best;
}

Html Gallery::Caption(const Shot& shot, const std::string& remark) const {
  const SettingResult& s = analysis_.settings[shot.setting];
  std::string values = SecondsText(s.cost.seconds.value) + " · " +
                       (analysis_.hasReference ? "relMSE " : "noise ") +
                       ShortNumber(s.cost.error.value);
  if (analysis_.hasReference) values += " · FLIP " + ShortNumber(s.flip);
  std::string setting = results_.settings[s.setting].Text();
  if (!remark.empty()) setting = remark + "; " + setting;
  return Fill("caption", {{"marker", LineMarker(shot.line)},
                          {"label", analysis_.lines[shot.line].label},
                          {"values", values},
                          {"setting", setting}});
}

Html Gallery::Poster(const Shot& shot, const std::string& remark) const {
  const Image image = Read(shot.setting);
  const std::string& label = analysis_.lines[shot.line].label;
  return Fill("poster", {{"kind", PosterKind()},
                         {"picture", Shown(image, label)},
                         {"frames", Frames()},
                         {"crops", Crops(image, label)},
                         {"caption", Caption(shot, remark)}});
}

Html Gallery::ReferencePoster() const {
  return Fill("poster",
              {{"kind", PosterKind()},
               {"picture", Shown(reference_, "reference")},
               {"frames", Frames()},
               {"crops", Crops(reference_, "the reference")},
               {"caption", Fill("reference-line", {{"setting", results_.reference.integrator}})}});
}

Html Gallery::ErrorMaps(const Image& reference, const Image& image, const std::string& of) const {
  return PictureElement(SignedErrorImage(reference, image, kErrorScale), 1, "signed error of " + of,
                        true) +
         ScalarPicture(FlipMap(reference, image), image, kFlipScale, "FLIP map of " + of);
}

Html Gallery::Comparison(const Shot& shot, const std::string& remark) const {
  const Image image = Read(shot.setting);
  const std::string& label = analysis_.lines[shot.line].label;
  Html pictures = Shown(image, label) + Crops(image, label);
  if (analysis_.hasReference) pictures += ErrorMaps(reference_, image, label);
  return Fill("figure", {{"pictures", pictures}, {"caption", Caption(shot, remark)}});
}

Html Gallery::ReferenceComparison() const {
  if (!analysis_.hasReference) return {};
  Html pictures = Shown(reference_, "reference") + Crops(reference_, "the reference");
  const std::vector<float>& difference = analysis_.reference.halfDifference;
  std::string setting = results_.reference.integrator;
  if (!difference.empty()) {
    Image half = reference_;
    for (std::size_t i = 0; i < half.pixels.size(); ++i) half.pixels[i] += difference[i];
    pictures += ErrorMaps(reference_, half, "the reference: one half");
    setting += "; its error row shows one half against the mean of both";
  } else {
    pictures += ErrorMaps(reference_, reference_, "the reference");
    setting += "; its own noise is not known";
  }
  return Fill("figure", {{"pictures", pictures},
                         {"caption", Fill("reference-caption", {{"setting", setting}})}});
}

Html ErrorLegends() {
  constexpr int kSteps = 65;
  Image zero(kSteps, 1, {"R", "G", "B"}), errors(kSteps, 1, {"R", "G", "B"});
  for (int x = 0; x < kSteps; ++x) {
    const double error = kErrorScale * (2. * x / (kSteps - 1) - 1);
    for (int c = 0; c < 3; ++c) errors.At(x, 0, c) = float(error * std::sqrt(kRelMseOffset));
  }
  const std::string limit = ShortNumber(100 * kErrorScale) + " %";
  return Fill("ramp-legend",
              {{"name", "Signed error"},
               {"low", "−" + limit + " too dark"},
               {"ramp", PictureElement(SignedErrorImage(zero, errors, kErrorScale), 1, "", false)},
               {"high", "+" + limit + " too bright"}}) +
         Fill("legend", {{"name", "FLIP"},
                         {"low", "0"},
                         {"stops", FalseColorStops()},
                         {"high", ShortNumber(kFlipScale) + " and more"}});
}

}  // namespace exphoton::study
