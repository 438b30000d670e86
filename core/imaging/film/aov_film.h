// SPDX-License-Identifier: BSD-2-Clause
// AovFilm accumulates the requested AOVs beside a Film. Light AOVs have the weights of the picture,
// so that they sum to it: a pixel is sum(w x) / sum(w). Surface AOVs and the photon density are
// means over the pixel's own samples with positive weights, so that they stay in their ranges with
// every filter (docs/decisions/0042-aovs-in-range.md). The object exists only if AOVs are
// requested.
#pragma once

#include <optional>
#include <vector>

#include "core/imaging/film/aovs.h"
#include "core/imaging/film/film.h"
#include "core/imaging/film/id_shares.h"

namespace exphoton {

class AovFilm {
 public:
  AovFilm(const PixelBounds& crop, AovSet wanted);

  const PixelBounds& Crop() const { return crop_; }
  AovSet Wanted() const { return wanted_; }
  bool NeedsSurface() const { return !(wanted_ & kSurfaceAovs).IsEmpty(); }
  bool NeedsTime() const { return wanted_.Has(Aov::Time); }
  bool NeedsSharingBias() const { return wanted_.Has(Aov::SharingBias); }

  // Adds one camera sample: its AOVs, the radiance L that the Film received, and the filter weight.
  // Only one thread at a time may add to a pixel.
  void AddSample(Point2i pixel, const AovSample& sample, const Spectrum& L, Real weight);
  // Adds radiance to a light AOV of a sample that was added before with this weight.
  void AddLight(Point2i pixel, Aov aov, const Spectrum& L, Real weight);
  void AddTime(Point2i pixel, double seconds);
  // Adds an estimate of the error that shared gathers add to the pixel, in radiance. `samples` is
  // the number of camera samples that share their gathers.
  void AddSharingBias(Point2i pixel, const Spectrum& bias, double samples);

  // Removes all samples, or those of one pixel.
  void Clear();
  void ClearPixel(Point2i pixel);
  // Adds the samples of another film with the same pixels and AOVs.
  void Add(const AovFilm& other);
  // Removes the light of another film, which has no samples of its own, from the light AOVs, the
  // variance and the bias.
  void SubtractLight(const AovFilm& other);
  // Saves or loads all sums. Throws ArchiveError if the saved film had other AOVs or pixels.
  void Transfer(ByteArchive* archive);
  // The same for one pixel: all sums but its time, and its time.
  void TransferPixel(ByteArchive* archive, Point2i pixel);
  void TransferTime(ByteArchive* archive, Point2i pixel);

  // For samples that are splatted (core/render/splat_buffer.h). ValuesOf writes the LightCount()
  // values of a sample's light AOVs. FirstValueOf returns the place of an AOV among them.
  std::size_t LightCount() const { return valueCount_; }
  void ValuesOf(const AovSample& sample, double* out) const;
  std::optional<std::size_t> FirstValueOf(Aov aov) const;
  // Adds a sample to its own pixel, and light to such a sample (Film::AddOwn).
  void AddOwn(Point2i pixel, const AovSample& sample, Real share);
  void AddOwnLight(Point2i pixel, std::size_t firstValue, const Spectrum& L, Real share);
  // Adds sums over samples: of w (r, g, b, alpha, 1), of w x for the values x of light AOVs, and,
  // if the variance is wanted, the covariances of w, w L and w L (1, then w L w and w L w L by
  // channel).
  void AddSums(std::size_t pixel, const double* film, const double* values, const double* squares);
  static constexpr std::size_t kSquares = 7;

  // Appends the channels to the film's picture. Light AOVs are scaled like the picture, so that
  // they sum to it. If the picture shows a negative channel as 0, the channel is 0 in all light
  // AOVs.
  void AppendTo(const Film& film, bool premultiplyAlpha, Image* image) const;

 private:
  // AOVs that are means over a pixel's own samples, and ids, which have no mean.
  static constexpr AovSet kOwn = kSurfaceAovs | AovSet{Aov::PhotonDensity};
  static constexpr AovSet kIds = kCryptomatte | AovSet{Aov::ObjectId, Aov::MaterialId};

  struct Weights {
    double sum = 0, sumOfSquares = 0;
    std::int64_t samples = 0;
    float absSum = 0;
  };
  // Sums of w x, and sums of |w| x for pixels whose weights nearly cancel (see film.h).
  struct Value {
    double sum = 0;
    float absSum = 0;
  };
  // Sums over a pixel's own samples, with positive weights: of all, and of samples that hit
  // a surface.
  struct SurfaceWeights {
    double all = 0, hit = 0;
  };
  // The number that more than half of the samples have, or else one that some sample has. Source:
  // Boyer and Moore 1981, "MJRTY - A Fast Majority Vote Algorithm".
  struct Majority {
    std::uint32_t id = 0;
    double lead = 0;
    void Add(std::uint32_t vote, double weight);
  };
  struct Moments {  // for Variance, one channel
    double wwLL = 0, wwL = 0, wL = 0;
  };

  std::size_t IndexOf(Point2i pixel) const;
  double MeanOf(std::size_t pixel, std::size_t value) const;
  double VarianceOf(std::size_t pixel, std::size_t channel) const;
  double SharingBiasOf(std::size_t pixel, std::size_t channel) const;
  void Collect(std::size_t pixel, const std::array<double, 4>& beauty, double lightScale,
               float* out) const;

  // Adds what does not depend on the picture's weights. `weight` is positive.
  void AddSurface(std::size_t pixel, const AovSample& sample, double weight);
  void CollectSurface(Aov aov, std::size_t pixel, const double* sums, float* out) const;
  double OtherValue(Aov aov, std::size_t pixel, std::size_t channel, double lightScale) const;

  PixelBounds crop_;
  AovSet wanted_;
  bool isSplatted_ = false;
  std::vector<Aov> aovs_, lights_, surfaces_;
  std::size_t valueCount_ = 0, surfaceCount_ = 0;  // channels per pixel
  std::vector<Weights> weights_;
  std::vector<Value> values_;          // of the light AOVs
  std::vector<double> surfaceValues_;  // sums of w x
  std::vector<SurfaceWeights> surfaceWeights_;
  std::vector<Majority> objects_, materials_;
  IdShares objectShares_, materialShares_;
  std::vector<Moments> moments_;  // three per pixel
  std::vector<double> seconds_;
  std::vector<double> distances_;  // sums of radianceDistance
  std::vector<std::int64_t> reads_;
  // Sums over groups of camera samples: of the number n of samples, and of n times the bias.
  struct Bias {
    double samples = 0;
    std::array<double, 3> sums{};
    void Add(const Bias& other, double factor) {
      samples += factor * other.samples;
      for (std::size_t c = 0; c < 3; ++c) sums[c] += factor * other.sums[c];
    }
  };
  std::vector<Bias> biases_;
};

// Adds channels to the image. `values` holds them pixel by pixel.
void AppendChannels(const std::vector<std::string>& names, const std::vector<float>& values,
                    Image* image);

}  // namespace exphoton
