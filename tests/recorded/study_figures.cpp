// SPDX-License-Identifier: BSD-2-Clause
// StudyFigures: curves of cost and error, their texts, the settings of a plan, and differences
// between small invented pictures.
#include <cmath>
#include <stdexcept>

#include "core/app/analysis/curves.h"
#include "core/app/analysis/headline/headline.h"
#include "core/app/analysis/headline/target.h"
#include "core/app/analysis/numbers.h"
#include "core/app/analysis/plan.h"
#include "core/app/analysis/separation.h"
#include "core/imaging/metrics/flip.h"
#include "core/imaging/metrics/metrics.h"
#include "core/imaging/metrics/noise_test.h"
#include "tests/recorded/draw.h"
#include "tests/recorded/figures.h"

namespace exphoton::recorded {
namespace {

using namespace study;

void AddTexts(FigureLines* lines) {
  for (const double value : {-1., 0., 2e-7, .00034, .0495, .25, .996, 1., 9.97, 59.6, 61., 99.94,
                             599., 3599., 3601., 43000., 99999., 1.2e6, 3.4e9}) {
    lines->Add("text of", value, SecondsText(value), ShortNumber(value), ShortNumber(value, 3),
               CountText(value), MeasuredText({value, .03}), MeasuredText({value, kUnknown}),
               ChangeText({value, .02}), SignedSecondsText({value, .4}), ShareText(value));
    for (const double error : {0., .0004, .096, 2.4, 700.}) {
      const RoundedPair pair = RoundTogether({value, error});
      lines->Add("rounded", value, error, pair.value, pair.error);
    }
  }
  for (const int number : {-12, -3, 0, 4, 10}) lines->Add("superscript", Superscript(number));
  for (const double error : RoundErrors()) lines->Add("round error", error);
}

void AddCurves(FigureLines* lines) {
  const std::vector<CostPoint> points{
      {{4, .2}, {.1, .004}},   {{1, .1}, {.5, .02}},       {{2, .1}, {.5, .01}},
      {{2, .3}, {.2, .01}},    {{9, .2}, {.1, .002}},      {{0, .1}, {.3, .01}},
      {{5, .2}, {0, .01}},     {{kUnknown, .1}, {.01, 0}}, {{16, .5}, {.02, .001}},
      {{16, .4}, {.03, .001}}, {{30, .4}, {.02, .004}}};
  for (const std::size_t i : ParetoFront(points)) lines->Add("front", double(i));
  for (const double error : {.7, .5, .3, .2, .07, .02, .015}) {
    const TimeToError time = FindTimeToError(points, error);
    lines->Add("time to", error, double(int(time.kind)), time.seconds.value, time.seconds.error,
               time.best.seconds.value, time.best.error.value);
  }
  const Measured ratio = Ratio({3, .2}, {4, .5});
  lines->Add("ratio", ratio.value, ratio.error);
  std::vector<Setting> settings;
  std::vector<CostPoint> costs;
  for (const int spp : {1, 2, 8})
    for (const int photons : {100, 400}) {
      settings.push_back(
          {"A", "path", {{"spp", std::to_string(spp)}, {"n", std::to_string(photons)}}});
      costs.push_back({{spp + photons / 90., .1 * spp}, {1. / spp + 30. / photons, .01}});
    }
  settings.push_back({"B", "path", {{"spp", "4"}, {"n", "x"}}});
  costs.push_back({{3, .1}, {.2, .01}});
  for (const DoublingEffect& effect : FindDoublingEffects(settings, costs))
    lines->Add("doubling " + effect.label + " " + effect.parameter, effect.secondsPerDoubling.value,
               effect.secondsPerDoubling.error, effect.errorFactor.value, effect.errorFactor.error,
               double(effect.pairs));
}

class Names : public ParameterLookup {
 public:
  bool Has(const std::string& integrator, const std::string& parameter) const override {
    return parameter == "maxdepth" || (integrator == "photonmap" && parameter == "nused");
  }
};

void AddStudyPlans(FigureLines* lines) {
  for (const char* text : {"path", "Long: path maxdepth=9 spp=4", "Few:photonmap nused=7", "a b",
                           "path spp", ": path", "path =3", "", "A=1: path"}) {
    try {
      const Setting setting = ParseSetting(text);
      lines->Add("setting " + setting.label, setting.integrator, setting.Text(),
                 RunName(setting, 3));
    } catch (const std::invalid_argument& error) {
      lines->Add("setting", text, error.what());
    }
  }
  for (const char* text : {"4", "2s", "1.5m", "1h", "0", "-1", "x", "3d", "1,2m,4s", "1,,2", ""}) {
    try {
      for (const double seconds : ParseBudgets(text)) lines->Add("budget", text, seconds);
    } catch (const std::invalid_argument& error) {
      lines->Add("budget", text, error.what());
    }
  }
  for (const char* varied : {"maxdepth=1,2", "photonmap:nused=5,50", "Long:maxdepth=3", "nused=4",
                             "path:nused=4", "spp=1,4", "maxdepth", "=3", "none:maxdepth=1"}) {
    try {
      StudyPlan plan;
      plan.bases = {ParseSetting("path"), ParseSetting("photonmap"),
                    ParseSetting("Long: path maxdepth=9")};
      plan.varied = {ParseVariedParameter(varied), ParseVariedParameter("spp=2,8")};
      plan.budgets = {3};
      for (const Setting& setting : ExpandPlan(plan, Names()))
        lines->Add("plan", varied, setting.label, setting.Text(), RunName(setting, 12));
    } catch (const std::invalid_argument& error) {
      lines->Add("plan", varied, error.what());
    }
  }
}

Image PictureOf(std::uint64_t seed, int width, int height, double noise) {
  Image image({0, 0, width, height}, {0, 0, width, height}, {"R", "G", "B"});
  Draw draw(seed);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double light = .1 + .03 * x + .02 * c * y + (x > 40 ? 1.5 : 0);
        image.At(x, y, c) = float(light + noise * (double(draw.Below(1000)) / 1000 - .5));
      }
  return image;
}

void AddDifference(const Image& a, const Image& b, FigureLines* lines) {
  const ImageDifference d = CompareImages(a, b);
  lines->Add("difference", d.mse, d.relMse, d.trimmedRelMse, d.p99, d.meanError, d.meanReference,
             d.relativeMeanError, double(d.nonFinitePixels));
  lines->Add("flip", FlipError(a, b), DisplayScale(a));
  for (const Image& image :
       {DifferenceImage(a, b), SignedErrorImage(a, b, .4), SignedErrorImage(a, b, .2, 1)})
    for (int c = 0; c < image.ChannelCount(); ++c) {
      double sum = 0, moment = 0;
      for (int y = 0; y < image.Height(); ++y)
        for (int x = 0; x < image.Width(); ++x) {
          const double value = double(image.At(x, y, c));
          sum += value;
          moment += value * (x + 3 * y);
        }
      lines->Add("channel " + image.channels[std::size_t(c)], sum, moment);
    }
}

void AddTest(const std::vector<Image>& references, const Image& picture, bool shares,
             FigureLines* lines) {
  const NoiseTest test = TestAgainstNoise(references, picture, {.03, shares});
  lines->Add("noise test", double(int(test.source)), test.reason, double(test.count),
             test.threshold, test.Differs() ? "differs" : "agrees");
  for (const NoiseFinding& finding : {test.mean, test.block})
    lines->Add("finding " + finding.channel, double(finding.part.x0), double(finding.part.x1),
               double(finding.part.y0), double(finding.part.y1), finding.relativeDifference,
               finding.p);
}

void AddPictures(FigureLines* lines) {
  const Image a = PictureOf(1, 70, 45, .2), b = PictureOf(2, 70, 45, .4);
  Image odd = PictureOf(3, 70, 45, .3);
  odd.At(3, 4, 1) = float(NAN);
  odd.At(50, 20, 0) = float(INFINITY);
  for (int x = 40; x < 60; ++x) odd.At(x, 30, 2) *= 2;
  AddDifference(a, b, lines);
  AddDifference(a, odd, lines);
  std::vector<Image> references, pictures;
  for (std::uint64_t seed = 10; seed < 14; ++seed)
    references.push_back(PictureOf(seed, 70, 45, .3));
  for (const bool shares : {false, true}) {
    AddTest(references, odd, shares, lines);
    AddTest({references[0], references[1]}, b, shares, lines);
    AddTest({a}, b, shares, lines);
  }
  for (std::uint64_t seed = 20; seed < 24; ++seed) pictures.push_back(PictureOf(seed, 70, 45, .5));
  for (const Reference& reference :
       {MakeReference(a), MakeReference(references[0], references[1])}) {
    lines->Add("reference", reference.variance.value, reference.variance.error,
               BlackError(reference), ReferenceShortfall(reference, .01),
               ShortfallText(reference, .001), ShortfallText(reference, 1));
    for (const std::size_t count : {1, 2, 4}) {
      const Separation s = Separate({pictures.begin(), pictures.begin() + long(count)}, reference);
      lines->Add("separation", double(s.seeds), s.relMse.value, s.relMse.error, s.error.value,
                 s.error.error, s.variance.value, s.variance.error, s.bias2.value, s.bias2.error,
                 double(s.mean[100]));
    }
  }
}

}  // namespace

std::vector<std::string> StudyFigures() {
  FigureLines lines;
  AddTexts(&lines);
  AddCurves(&lines);
  AddStudyPlans(&lines);
  AddPictures(&lines);
  return lines.Take();
}

}  // namespace exphoton::recorded
