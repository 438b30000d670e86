// SPDX-License-Identifier: BSD-2-Clause
// AovFilm: sums of the AOVs, and their output as channels in the order of the AOVs.
#include "core/imaging/film/aov_film.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

// AOVs that are means over a pixel's own samples.
constexpr AovSet kOwn = kSurfaceAovs | AovSet{Aov::PhotonDensity};
constexpr AovSet kIds{Aov::ObjectId, Aov::MaterialId};

// Writes the values of a light AOV, or of an AOV in kOwn, at one sample to `out`. Returns their
// number. Ids have no values to average.
std::size_t WriteValues(Aov aov, const AovSample& sample, double* out) {
  const auto color = [out](const Spectrum& s) {
    out[0] = double(s.r), out[1] = double(s.g), out[2] = double(s.b);
    return std::size_t(3);
  };
  const auto vector = [out](const auto& v) {
    out[0] = double(v.x), out[1] = double(v.y), out[2] = double(v.z);
    return std::size_t(3);
  };
  switch (aov) {
    case Aov::Albedo:
      return color(sample.albedo);
    case Aov::Normal:
      return vector(sample.n);
    case Aov::GeometricNormal:
      return vector(sample.ng);
    case Aov::Position:
      return vector(sample.p);
    case Aov::Depth:
      out[0] = double(sample.depth);
      return 1;
    case Aov::TexCoords:
      out[0] = double(sample.uv.x), out[1] = double(sample.uv.y);
      return 2;
    case Aov::Emission:
      return color(sample.emission);
    case Aov::Direct:
      return color(sample.direct);
    case Aov::Caustic:
      return color(sample.caustic);
    case Aov::Indirect:
      return color(sample.indirect);
    case Aov::Specular:
      return color(sample.specular);
    case Aov::PhotonDensity:
      out[0] = sample.photonDensity;
      return 1;
    default:
      return 0;
  }
}

}  // namespace

AovFilm::AovFilm(const PixelBounds& crop, AovSet wanted)
    : crop_(crop),
      wanted_(wanted),
      aovs_(wanted.List()),
      lights_((wanted & kLightAovs).List()),
      surfaces_((wanted & kOwn).Without(kIds).List()) {
  const std::size_t pixels = std::size_t(crop.Width()) * std::size_t(crop.Height());
  for (const Aov aov : lights_) valueCount_ += GetAovInfo(aov).channels.size();
  for (const Aov aov : surfaces_) surfaceCount_ += GetAovInfo(aov).channels.size();
  weights_.resize(pixels);
  values_.resize(pixels * valueCount_);
  surfaceValues_.resize(pixels * surfaceCount_);
  if (surfaceCount_ > 0) surfaceWeights_.resize(pixels);
  if (wanted.Has(Aov::ObjectId)) objects_.resize(pixels);
  if (wanted.Has(Aov::MaterialId)) materials_.resize(pixels);
  if (wanted.Has(Aov::Variance)) moments_.resize(pixels * 3);
  if (wanted.Has(Aov::Time)) seconds_.resize(pixels);
  if (wanted.Has(Aov::SharingBias)) biases_.resize(pixels);
  if (wanted.Has(Aov::RadianceDistance)) {
    distances_.resize(pixels);
    reads_.resize(pixels);
  }
}

std::size_t AovFilm::IndexOf(Point2i pixel) const {
  return std::size_t(pixel.y - crop_.y0) * std::size_t(crop_.Width()) +
         std::size_t(pixel.x - crop_.x0);
}

void AovFilm::AddSample(Point2i pixel, const AovSample& sample, const Spectrum& L, Real weight) {
  const std::size_t at = IndexOf(pixel);
  const double w = weight;
  Weights& weights = weights_[at];
  weights.sum += w;
  weights.sumOfSquares += w * w;
  weights.absSum += float(std::abs(w));
  AddSurface(at, sample, std::abs(w));
  Value* value = values_.data() + at * valueCount_;
  for (const Aov aov : lights_) {
    double x[3];
    const std::size_t count = WriteValues(aov, sample, x);
    for (std::size_t c = 0; c < count; ++c, ++value) {
      value->sum += w * x[c];
      value->absSum += float(std::abs(w) * x[c]);
    }
  }
  if (!moments_.empty()) {
    const Spectrum own = L + sample.ownGathers;
    const double l[3] = {double(own.r), double(own.g), double(own.b)};
    for (std::size_t c = 0; c < 3; ++c) {
      Moments& m = moments_[at * 3 + c];
      m.wL += w * l[c];
      m.wwL += w * w * l[c];
      m.wwLL += w * w * l[c] * l[c];
    }
  }
}

void AovFilm::Majority::Add(std::uint32_t vote, double weight) {
  if (vote == id) {
    lead += weight;
  } else if (lead >= weight) {
    lead -= weight;
  } else {
    id = vote;
    lead = weight - lead;
  }
}

void AovFilm::AddSurface(std::size_t pixel, const AovSample& sample, double weight) {
  ++weights_[pixel].samples;
  if (!objects_.empty()) objects_[pixel].Add(sample.objectId, weight);
  if (!materials_.empty()) materials_[pixel].Add(sample.materialId, weight);
  double* sum = surfaceValues_.data() + pixel * surfaceCount_;
  for (const Aov aov : surfaces_) {
    double x[3];
    const std::size_t count = WriteValues(aov, sample, x);
    for (std::size_t c = 0; c < count; ++c) *sum++ += weight * x[c];
  }
  if (!surfaceWeights_.empty()) {
    surfaceWeights_[pixel].all += weight;
    if (sample.isHit) surfaceWeights_[pixel].hit += weight;
  }
  if (reads_.empty()) return;
  distances_[pixel] += sample.radianceDistance;
  reads_[pixel] += sample.radiancePhotonsRead;
}

void AovFilm::ValuesOf(const AovSample& sample, double* out) const {
  for (const Aov aov : lights_) out += WriteValues(aov, sample, out);
}

std::optional<std::size_t> AovFilm::FirstValueOf(Aov aov) const {
  std::size_t at = 0;
  for (const Aov each : lights_) {
    if (each == aov) return at;
    at += GetAovInfo(each).channels.size();
  }
  return std::nullopt;
}

void AovFilm::AddOwn(Point2i pixel, const AovSample& sample) {
  const std::size_t at = IndexOf(pixel);
  weights_[at].absSum += 1;
  AddSurface(at, sample, 1);
  Value* value = values_.data() + at * valueCount_;
  for (const Aov aov : lights_) {
    double x[3];
    const std::size_t count = WriteValues(aov, sample, x);
    for (std::size_t c = 0; c < count; ++c, ++value) value->absSum += float(x[c]);
  }
}

void AovFilm::AddOwnLight(Point2i pixel, std::size_t firstValue, const Spectrum& L) {
  Value* value = values_.data() + IndexOf(pixel) * valueCount_ + firstValue;
  for (int c = 0; c < 3; ++c) value[c].absSum += float(L[c]);
}

void AovFilm::AddSums(std::size_t pixel, const double* film, const double* values,
                      const double* squares) {
  isSplatted_ = true;
  weights_[pixel].sum += film[4];
  for (std::size_t i = 0; i < valueCount_; ++i) values_[pixel * valueCount_ + i].sum += values[i];
  if (moments_.empty()) return;
  weights_[pixel].sumOfSquares += squares[0];
  for (std::size_t c = 0; c < 3; ++c) {
    Moments& m = moments_[pixel * 3 + c];
    m.wL += film[c];
    m.wwL += squares[1 + c];
    m.wwLL += squares[4 + c];
  }
}

void AovFilm::AddLight(Point2i pixel, Aov lightAov, const Spectrum& L, Real weight) {
  Value* value = values_.data() + IndexOf(pixel) * valueCount_;
  for (const Aov aov : lights_) {
    if (aov == lightAov) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double x = double(L[int(c)]);
        value[c].sum += double(weight) * x;
        value[c].absSum += float(std::abs(double(weight)) * x);
      }
      return;
    }
    value += GetAovInfo(aov).channels.size();
  }
}

void AovFilm::AddTime(Point2i pixel, double seconds) { seconds_[IndexOf(pixel)] += seconds; }

void AovFilm::AddSharingBias(Point2i pixel, const Spectrum& bias, double samples) {
  const Bias added{samples,
                   {samples * double(bias.r), samples * double(bias.g), samples * double(bias.b)}};
  biases_[IndexOf(pixel)].Add(added, 1);
}

void AovFilm::Clear() {
  isSplatted_ = false;
  std::ranges::fill(weights_, Weights());
  std::ranges::fill(values_, Value());
  std::ranges::fill(surfaceValues_, 0.);
  std::ranges::fill(surfaceWeights_, SurfaceWeights());
  std::ranges::fill(objects_, Majority());
  std::ranges::fill(materials_, Majority());
  std::ranges::fill(moments_, Moments());
  std::ranges::fill(seconds_, 0.);
  std::ranges::fill(distances_, 0.);
  std::ranges::fill(reads_, 0);
  std::ranges::fill(biases_, Bias());
}

void AovFilm::ClearPixel(Point2i pixel) {
  const std::size_t at = IndexOf(pixel);
  weights_[at] = Weights();
  std::fill_n(values_.begin() + std::ptrdiff_t(at * valueCount_), valueCount_, Value());
  std::fill_n(surfaceValues_.begin() + std::ptrdiff_t(at * surfaceCount_), surfaceCount_, 0.);
  if (!surfaceWeights_.empty()) surfaceWeights_[at] = SurfaceWeights();
  if (!objects_.empty()) objects_[at] = Majority();
  if (!materials_.empty()) materials_[at] = Majority();
  if (!moments_.empty()) std::fill_n(moments_.begin() + std::ptrdiff_t(at * 3), 3, Moments());
  if (!seconds_.empty()) seconds_[at] = 0;
  if (!reads_.empty()) distances_[at] = 0, reads_[at] = 0;
  if (!biases_.empty()) biases_[at] = Bias();
}

void AovFilm::SubtractLight(const AovFilm& other) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i].sum -= other.values_[i].sum;
    values_[i].absSum -= other.values_[i].absSum;
  }
  for (std::size_t i = 0; i < biases_.size(); ++i) biases_[i].Add(other.biases_[i], -1);
}

void AovFilm::Add(const AovFilm& other) {
  isSplatted_ = isSplatted_ || other.isSplatted_;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    weights_[i].sum += other.weights_[i].sum;
    weights_[i].sumOfSquares += other.weights_[i].sumOfSquares;
    weights_[i].samples += other.weights_[i].samples;
    weights_[i].absSum += other.weights_[i].absSum;
  }
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i].sum += other.values_[i].sum;
    values_[i].absSum += other.values_[i].absSum;
  }
  for (std::size_t i = 0; i < surfaceValues_.size(); ++i)
    surfaceValues_[i] += other.surfaceValues_[i];
  for (std::size_t i = 0; i < surfaceWeights_.size(); ++i) {
    surfaceWeights_[i].all += other.surfaceWeights_[i].all;
    surfaceWeights_[i].hit += other.surfaceWeights_[i].hit;
  }
  const auto addVotes = [](std::vector<Majority>* ids, const std::vector<Majority>& others) {
    for (std::size_t i = 0; i < ids->size(); ++i) (*ids)[i].Add(others[i].id, others[i].lead);
  };
  addVotes(&objects_, other.objects_);
  addVotes(&materials_, other.materials_);
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i].wwLL += other.moments_[i].wwLL;
    moments_[i].wwL += other.moments_[i].wwL;
    moments_[i].wL += other.moments_[i].wL;
  }
  for (std::size_t i = 0; i < seconds_.size(); ++i) seconds_[i] += other.seconds_[i];
  for (std::size_t i = 0; i < reads_.size(); ++i) {
    distances_[i] += other.distances_[i];
    reads_[i] += other.reads_[i];
  }
  for (std::size_t i = 0; i < biases_.size(); ++i) biases_[i].Add(other.biases_[i], 1);
}

double AovFilm::MeanOf(std::size_t pixel, std::size_t value) const {
  const Weights& weights = weights_[pixel];
  const Value& v = values_[pixel * valueCount_ + value];
  if (weights.samples == 0) return 0;
  if (std::abs(weights.sum) >= .5 * double(weights.samples)) return v.sum / weights.sum;
  return weights.absSum > 0 ? double(v.absSum) / double(weights.absSum) : 0;
}

// Returns the variance of the quotient R = sum(w L) / sum(w), to first order: the sum of (w (L -
// R))^2, divided by sum(w)^2. The samples are assumed to be independent. Splatted samples come with
// covariances that are unbiased already.
double AovFilm::VarianceOf(std::size_t pixel, std::size_t channel) const {
  const Weights& weights = weights_[pixel];
  const double n = double(weights.samples), sum = std::max(std::abs(weights.sum), .5 * n);
  if (weights.samples < 2 && !isSplatted_) return 0;
  const Moments& m = moments_[pixel * 3 + channel];
  const double mean = m.wL / sum;
  const double squares = m.wwLL - 2 * mean * m.wwL + mean * mean * weights.sumOfSquares;
  if (isSplatted_) return sum > 0 ? std::max(squares, 0.) / (sum * sum) : 0;
  return std::max(squares, 0.) * n / ((n - 1) * sum * sum);
}

double AovFilm::SharingBiasOf(std::size_t pixel, std::size_t channel) const {
  const Bias& bias = biases_[pixel];
  return bias.samples > 0 ? bias.sums[channel] / bias.samples : 0;
}

// Normals are averaged to a direction. Properties of a surface are means over the samples that hit
// one.
void AovFilm::CollectSurface(Aov aov, std::size_t pixel, const double* sums, float* out) const {
  const std::size_t count = GetAovInfo(aov).channels.size();
  double weight = surfaceWeights_[pixel].hit;
  if (aov == Aov::Albedo || aov == Aov::PhotonDensity) weight = surfaceWeights_[pixel].all;
  if (aov == Aov::Normal || aov == Aov::GeometricNormal)
    weight = std::hypot(sums[0], sums[1], sums[2]);
  for (std::size_t c = 0; c < count; ++c) out[c] = weight > 0 ? float(sums[c] / weight) : 0;
}

void AovFilm::Collect(std::size_t pixel, const std::array<double, 4>& beauty, double lightScale,
                      float* out) const {
  std::size_t value = 0;
  const double* sums = surfaceValues_.data() + pixel * surfaceCount_;
  for (const Aov aov : aovs_) {
    const std::size_t channels = GetAovInfo(aov).channels.size();
    if (kOwn.Without(kIds).Has(aov)) {
      CollectSurface(aov, pixel, sums, out);
      sums += channels;
      out += channels;
      continue;
    }
    for (std::size_t c = 0; c < channels; ++c) {
      double x = 0;
      if (kLightAovs.Has(aov)) {
        x = MeanOf(pixel, value++) * (beauty[c] < 0 ? 0 : lightScale);
      } else if (kIds.Has(aov)) {
        x = (aov == Aov::ObjectId ? objects_ : materials_)[pixel].id;
      } else if (aov == Aov::Variance) {
        x = VarianceOf(pixel, c) * lightScale * lightScale;
      } else if (aov == Aov::Time) {
        x = 1e3 * seconds_[pixel];
      } else if (aov == Aov::Samples) {
        x = double(weights_[pixel].samples);
      } else if (aov == Aov::SharingBias) {
        x = SharingBiasOf(pixel, c) * lightScale;
      } else if (reads_[pixel] > 0) {
        x = distances_[pixel] / double(reads_[pixel]);
      }
      *out++ = float(x);
    }
  }
}

void AovFilm::AppendTo(const Film& film, bool premultiplyAlpha, Image* image) const {
  std::vector<std::string> names;
  for (const Aov aov : aovs_) {
    const auto& channels = GetAovInfo(aov).channels;
    names.insert(names.end(), channels.begin(), channels.end());
    if (GetAovInfo(aov).isExact) image->exactChannels.insert(channels.begin(), channels.end());
  }
  std::vector<float> values(names.size() * weights_.size());
  std::size_t at = 0;
  for (int y = crop_.y0; y < crop_.y1; ++y) {
    for (int x = crop_.x0; x < crop_.x1; ++x, ++at) {
      const std::array<double, 4> beauty = film.MeanOf({x, y});
      const double scale = premultiplyAlpha ? std::clamp(beauty[3], 0., 1.) : 1;
      Collect(at, beauty, scale, values.data() + at * names.size());
    }
  }
  AppendChannels(names, values, image);
}

void AppendChannels(const std::vector<std::string>& names, const std::vector<float>& values,
                    Image* image) {
  const std::size_t before = image->channels.size(), added = names.size();
  const std::size_t pixels = added == 0 ? 0 : values.size() / added;
  std::vector<float> all;
  all.reserve(image->pixels.size() + values.size());
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto old = image->pixels.begin() + std::ptrdiff_t(i * before);
    const auto own = values.begin() + std::ptrdiff_t(i * added);
    all.insert(all.end(), old, old + std::ptrdiff_t(before));
    all.insert(all.end(), own, own + std::ptrdiff_t(added));
  }
  if (added == 0) return;
  image->pixels = std::move(all);
  image->channels.insert(image->channels.end(), names.begin(), names.end());
}

}  // namespace exphoton
