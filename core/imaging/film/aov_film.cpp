// SPDX-License-Identifier: BSD-2-Clause
// AovFilm: sums of the AOVs. aov_film_output.cpp makes channels of them.
#include "core/imaging/film/aov_film.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

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
  if (wanted.Has(Aov::CryptoObject)) objectShares_ = IdShares(pixels);
  if (wanted.Has(Aov::CryptoMaterial)) materialShares_ = IdShares(pixels);
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
  if (!objectShares_.IsEmpty()) objectShares_.Add(pixel, sample.objectId, weight);
  if (!materialShares_.IsEmpty()) materialShares_.Add(pixel, sample.materialId, weight);
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

void AovFilm::AddOwn(Point2i pixel, const AovSample& sample, Real share) {
  const std::size_t at = IndexOf(pixel);
  const auto s = float(share);
  weights_[at].absSum += s;
  AddSurface(at, sample, double(share));
  Value* value = values_.data() + at * valueCount_;
  for (const Aov aov : lights_) {
    double x[3];
    const std::size_t count = WriteValues(aov, sample, x);
    for (std::size_t c = 0; c < count; ++c, ++value) value->absSum += s * float(x[c]);
  }
}

void AovFilm::AddOwnLight(Point2i pixel, std::size_t firstValue, const Spectrum& L, Real share) {
  Value* value = values_.data() + IndexOf(pixel) * valueCount_ + firstValue;
  for (int c = 0; c < 3; ++c) value[c].absSum += float(share) * float(L[c]);
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
  objectShares_.Clear();
  materialShares_.Clear();
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
  objectShares_.ClearPixel(at);
  materialShares_.ClearPixel(at);
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
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i].wwLL -= other.moments_[i].wwLL;
    moments_[i].wwL -= other.moments_[i].wwL;
    moments_[i].wL -= other.moments_[i].wL;
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
  objectShares_.Add(other.objectShares_);
  materialShares_.Add(other.materialShares_);
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

}  // namespace exphoton
