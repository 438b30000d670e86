// SPDX-License-Identifier: BSD-2-Clause
// These tests measure the noise of pictures under every pixel filter, and compare it with the noise
// that the program reports. The scene is a lamp over a floor with two colours, so that the picture
// has smooth shading, edges and noise. Seeds are fixed, so the results never change.
#include <cmath>
#include <functional>
#include <vector>

#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

constexpr int kWidth = 32, kHeight = 24;
constexpr double kOffset = .01;  // of relMSE

std::string Scene(const std::string& filter, const std::string& sampler,
                  const std::string& integrator = "\"directlighting\"") {
  return "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 24\n"
         "LookAt 0 2 -3  0 0 1  0 1 0 Camera \"perspective\" \"float fov\" 50\nPixelFilter \"" +
         filter + "\"\nSampler \"" + sampler + "\" \"integer pixelsamples\" 4\nSurfaceIntegrator " +
         integrator +
         "\nWorldBegin\n"
         "AttributeBegin AreaLightSource \"area\" \"color L\" [6 6 6] Translate .5 4 1\n"
         "Shape \"sphere\" \"float radius\" 1.2 AttributeEnd\n"
         "AttributeBegin Rotate -90 1 0 0 Material \"matte\" \"color Kd\" [.6 .5 .4]\n"
         "Shape \"disk\" \"float radius\" 40 AttributeEnd\n"
         "AttributeBegin Translate -1.6 .001 0 Rotate -90 1 0 0 Material \"matte\" \"color Kd\" "
         "[.2 .3 .4]\nShape \"disk\" \"float radius\" 1.5 AttributeEnd\n"
         "AttributeBegin Translate .3 .5 1 Shape \"sphere\" \"float radius\" .5 AttributeEnd\n"
         "WorldEnd\n";
}

class FilterNoiseTest : public ProgramTest {
 protected:
  Image Render(const std::string& filter, const std::string& sampler, Names arguments,
               const std::string& integrator = "\"directlighting\"") {
    Write("scene.pbrt", Scene(filter, sampler, integrator));
    for (const char* word :
         {"scene.pbrt", "-o", "out.exr", "--float", "--quiet", "--stats-json", "stats.json"})
      arguments.push_back(word);
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return ReadExr(Path("out.exr"));
  }
  // Returns the noise that the program reports, the noise part of relMSE.
  double ReportedNoise() const {
    const std::string json = Read("stats.json"), key = "\"noise\":";
    const std::size_t at = json.find(key);
    return at == std::string::npos ? -1 : std::stod(json.substr(at + key.size()));
  }
  const Image& Truth(const std::string& filter) {
    if (truthFilter_ != filter) {
      truth_ = Render(filter, "lowdiscrepancy", {"--spp", "512", "--seed", "99"});
      truthFilter_ = filter;
    }
    return truth_;
  }

 private:
  std::string truthFilter_;
  Image truth_;
};

// Returns the values of three channels, "R", "G" and "B" with this prefix, by pixel.
std::vector<double> Values(const Image& image, const std::string& prefix = "") {
  std::vector<double> values;
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      for (const char* name : {"R", "G", "B"})
        values.push_back(double(image.At(x, y, image.FindChannel(prefix + name))));
  return values;
}

// Returns the mean over pixels and channels of (a - b)^2 / scale(b).
double Error(const Image& a, const Image& b, const std::function<double(double)>& scale) {
  const std::vector<double> first = Values(a), second = Values(b);
  double sum = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    sum += (first[i] - second[i]) * (first[i] - second[i]) / scale(second[i]);
  return sum / double(first.size());
}
double MeanSquare(const Image& a, const Image& b) {
  return Error(a, b, [](double) { return 1.; });
}
double RelMse(const Image& a, const Image& b) {
  return Error(a, b, [](double r) { return r * r + kOffset; });
}

std::string Seed(int number) { return std::to_string(number); }

// The bound holds for the mean error over four seeds against each filter's own converged picture.
TEST_F(FilterNoiseTest, OfMitchellIsNearThatOfAGaussian) {
  const auto deviation = [&](const std::string& filter) {
    double sum = 0;
    for (int seed = 1; seed <= 4; ++seed)
      sum += MeanSquare(Render(filter, "lowdiscrepancy", {"--seed", Seed(seed)}), Truth(filter));
    return std::sqrt(sum / 4);
  };
  const double gaussian = deviation("gaussian");
  RecordProperty("gaussian", std::to_string(gaussian));
  EXPECT_LT(deviation("mitchell"), 1.3 * gaussian);
  EXPECT_LT(deviation("sinc"), 1.6 * gaussian);
}

TEST_F(FilterNoiseTest, OfMitchellLeavesNoBlackDots) {
  for (int seed = 1; seed <= 4; ++seed) {
    const std::vector<double> truth = Values(Truth("mitchell"));
    const std::vector<double> values =
        Values(Render("mitchell", "lowdiscrepancy", {"--seed", Seed(seed)}));
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!(truth[i] > .1)) continue;
      EXPECT_GT(values[i], .2 * truth[i]) << i / 3;
    }
  }
}

TEST_F(FilterNoiseTest, IsReportedByHalves) {
  for (const char* filter : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    double reported = 0, measured = 0;
    for (int seed = 1; seed <= 3; ++seed) {
      const Image image =
          Render(filter, "lowdiscrepancy", {"--two-halves", "--spp", "8", "--seed", Seed(seed)});
      reported += ReportedNoise();
      measured += RelMse(image, Truth(filter));
    }
    EXPECT_GT(reported, measured / 1.3) << filter;
    EXPECT_LT(reported, measured * 1.3) << filter;
  }
}

// A rule that stops when an estimate is low prefers low estimates, so the bound is the one of
// TargetErrorTest.
TEST_F(FilterNoiseTest, IsReportedByPasses) {
  for (const char* filter : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    double reported = 0, measured = 0;
    for (int seed = 1; seed <= 8; ++seed) {
      const Image image =
          Render(filter, "lowdiscrepancy", {"--target-error", ".003", "--seed", Seed(seed)});
      const double noise = ReportedNoise();
      EXPECT_LE(noise, .003) << filter;
      EXPECT_GT(noise, .0005) << filter;
      reported += noise;
      measured += RelMse(image, Truth(filter));
    }
    EXPECT_GT(reported, measured / 1.5) << filter;
    EXPECT_LT(reported, measured * 1.5) << filter;
  }
}

// Samples of "random" are independent, as the estimate assumes.
TEST_F(FilterNoiseTest, IsInTheVarianceAov) {
  for (const char* filter : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    double reported = 0, measured = 0;
    for (int seed = 1; seed <= 3; ++seed) {
      const Image image =
          Render(filter, "random", {"--aov", "variance", "--spp", "8", "--seed", Seed(seed)});
      measured += MeanSquare(image, Truth(filter));
      for (const double variance : Values(image, "variance."))
        reported += variance / (3 * kWidth * kHeight);
    }
    EXPECT_GT(reported, measured / 1.2) << filter;
    EXPECT_LT(reported, measured * 1.2) << filter;
  }
}

TEST_F(FilterNoiseTest, NeverDependsOnCropOrThreads) {
  const char* const shared =
      "\"exphotonmap\" \"integer indirectphotons\" 500 \"integer finalgathersamples\" 4 \"bool "
      "sharedgather\" \"true\"";
  for (const char* filter : {"mitchell", "sinc"}) {
    for (const char* integrator : {"\"directlighting\"", shared}) {
      const Image whole = Render(filter, "lowdiscrepancy", {"--nthreads", "1"}, integrator);
      const Image threaded = Render(filter, "lowdiscrepancy", {"--nthreads", "3"}, integrator);
      EXPECT_EQ(whole.pixels, threaded.pixels) << filter << integrator;
      const Image part =
          Render(filter, "lowdiscrepancy", {"--pixelbounds", "10,17,5,24"}, integrator);
      for (int y = 0; y < part.Height(); ++y)
        for (int x = 0; x < part.Width(); ++x)
          for (int c = 0; c < 4; ++c)
            ASSERT_EQ(part.At(x, y, c), whole.At(10 + x, 5 + y, c)) << filter << integrator;
    }
  }
}

}  // namespace
}  // namespace exphoton
