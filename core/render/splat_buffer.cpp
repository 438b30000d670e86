// SPDX-License-Identifier: BSD-2-Clause
// SplatBuffer: a pixel's samples are summed in the order of their index. The sums of all pixels are
// then added exactly.
#include "core/render/splat_buffer.h"

#include <algorithm>

#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

constexpr std::size_t kFilmValues = 5;  // r, g, b, alpha, 1

}  // namespace

SplatBuffer::SplatBuffer(const SplatWeights& weights, Film* film, AovFilm* aovs)
    : weights_(weights),
      film_(film),
      aovs_(aovs),
      valueCount_(kFilmValues + (aovs ? aovs->LightCount() : 0)),
      squareCount_(aovs && aovs->Wanted().Has(Aov::Variance) ? AovFilm::kSquares : 0),
      sums_(film->PixelCount() * Stride()),
      rows_(std::size_t(film->Crop().Height())) {}

SplatBuffer::SplatBuffer(const SplatBuffer& other, Film* film, AovFilm* aovs)
    : weights_(other.weights_),
      film_(film),
      aovs_(aovs),
      valueCount_(other.valueCount_),
      squareCount_(other.squareCount_),
      sums_(other.sums_),
      rows_(other.rows_.size()) {}

void SplatBuffer::Transfer(ByteArchive* archive) {
  archive->Same(std::uint64_t(sums_.size()));
  // A pixel without samples takes one byte, so that a render which stops early writes little.
  for (std::size_t at = 0; at < sums_.size(); at += Stride()) {
    const auto begin = sums_.begin() + std::ptrdiff_t(at);
    char isUsed = std::any_of(begin, begin + std::ptrdiff_t(Stride()),
                              [](const WideExactSum& sum) { return sum.Total() != 0; });
    archive->Values(&isUsed);
    for (std::size_t i = 0; isUsed && i < Stride(); ++i) sums_[at + i].Transfer(archive);
  }
}

void SplatBuffer::SaveRow(ByteArchive* archive, int y) const {
  const PixelBounds& crop = film_->Crop();
  const auto width = std::size_t(crop.Width());
  const auto first = sums_.begin() + std::ptrdiff_t(std::size_t(y - crop.y0) * width * Stride());
  std::vector<std::uint32_t> used;
  for (std::size_t x = 0; x < width; ++x) {
    const auto begin = first + std::ptrdiff_t(x * Stride());
    if (std::any_of(begin, begin + std::ptrdiff_t(Stride()),
                    [](const WideExactSum& sum) { return sum.Total() != 0; }))
      used.push_back(std::uint32_t(x));
  }
  archive->List(&used);
  for (const std::uint32_t x : used) {
    for (std::size_t i = 0; i < Stride(); ++i) {
      WideExactSum sum(first[std::ptrdiff_t(x * Stride() + i)]);
      sum.Transfer(archive);
    }
  }
}

void SplatBuffer::AddRow(ByteArchive* archive, int y) {
  const PixelBounds& crop = film_->Crop();
  std::vector<std::uint32_t> used;
  archive->List(&used);
  for (const std::uint32_t x : used) {
    if (x >= std::uint32_t(crop.Width())) throw ArchiveError("a pixel is outside the picture");
    const std::size_t at = std::size_t(y - crop.y0) * std::size_t(crop.Width()) + x;
    for (std::size_t i = 0; i < Stride(); ++i) {
      WideExactSum sum;
      sum.Transfer(archive);
      sums_[at * Stride() + i].Add(sum);
    }
  }
}

PixelBounds SplatBuffer::Window() const {
  const PixelBounds& crop = film_->Crop();
  const int reach = weights_.Reach();
  return {crop.x0 - reach, crop.y0 - reach, crop.x1 + reach, crop.y1 + reach};
}

void SplatBuffer::Pixel::Begin(SplatBuffer* buffer, Point2i pixel) {
  buffer_ = buffer;
  pixel_ = pixel;
  samples_ = 0;
  const auto width = std::size_t(buffer->weights_.Width());
  sums_.assign(width * width * buffer->Stride(), 0);
  values_.resize(buffer->valueCount_);
  squares_.resize(buffer->squareCount_);
}

void SplatBuffer::Pixel::Add(const SplatSample& sample) {
  const Spectrum& L = sample.L;
  const double l[3] = {double(L.r), double(L.g), double(L.b)};
  std::copy_n(l, 3, values_.begin());
  values_[3] = double(sample.alpha);
  values_[4] = 1;
  if (sample.aovs) buffer_->aovs_->ValuesOf(*sample.aovs, values_.data() + kFilmValues);
  if (!squares_.empty()) {
    const Spectrum own = L + sample.aovs->ownGathers;
    const double v[3] = {double(own.r), double(own.g), double(own.b)};
    squares_[0] = 1;
    for (std::size_t c = 0; c < 3; ++c) squares_[1 + c] = v[c], squares_[4 + c] = v[c] * v[c];
  }
  AddValues(sample.place, sample.share);
  ++samples_;
  if (!buffer_->film_->Crop().Contains(pixel_.x, pixel_.y)) return;
  buffer_->film_->AddOwn(pixel_, L, sample.alpha, sample.share);
  if (sample.aovs) buffer_->aovs_->AddOwn(pixel_, *sample.aovs, sample.share);
}

void SplatBuffer::Pixel::AddLight(Point2 place, Real share, const Spectrum& L, Aov lightAov) {
  std::ranges::fill(values_, 0.);
  std::ranges::fill(squares_, 0.);
  const double l[3] = {double(L.r), double(L.g), double(L.b)};
  std::copy_n(l, 3, values_.begin());
  AovFilm* aovs = buffer_->aovs_;
  const auto at = aovs ? aovs->FirstValueOf(lightAov) : std::nullopt;
  if (at) std::copy_n(l, 3, values_.begin() + std::ptrdiff_t(kFilmValues + *at));
  AddValues(place, share);
  if (!buffer_->film_->Crop().Contains(pixel_.x, pixel_.y)) return;
  buffer_->film_->AddOwnLight(pixel_, L, share);
  if (at) aovs->AddOwnLight(pixel_, *at, L, share);
}

void SplatBuffer::Pixel::AddValues(Point2 place, Real share) {
  buffer_->weights_.Fill(place, &weights_);
  double* sum = sums_.data();
  for (const double weight : weights_) {
    const double w = weight * double(share);
    for (const double x : values_) *sum++ += w * x;
    for (const double x : squares_) *sum++ += w * w * x;
  }
}

// The samples of a pixel are a stratum: only their spread about their own mean is noise. With y = w
// L and n samples, the variance of their sum is estimated by n / (n - 1) (sum y^2 - (sum y)^2 / n).
// The same holds for the products w L w and w w, which the variance of a quotient needs.
void SplatBuffer::Pixel::End() {
  const PixelBounds& crop = buffer_->film_->Crop();
  const int reach = buffer_->weights_.Reach();
  const std::size_t stride = buffer_->Stride(), values = buffer_->valueCount_;
  double* cell = sums_.data();
  for (int y = pixel_.y - reach; y <= pixel_.y + reach; ++y) {
    if (y < crop.y0 || y >= crop.y1) {
      cell += stride * std::size_t(2 * reach + 1);
      continue;
    }
    const std::lock_guard lock(buffer_->rows_[std::size_t(y - crop.y0)]);
    for (int x = pixel_.x - reach; x <= pixel_.x + reach; ++x, cell += stride) {
      if (x < crop.x0 || x >= crop.x1) continue;
      if (!squares_.empty() && samples_ > 1) {
        const double n = samples_, bessel = n / (n - 1), w = cell[4];
        double* square = cell + values;
        square[0] = bessel * (square[0] - w * w / n);
        for (std::size_t c = 0; c < 3; ++c) {
          square[1 + c] = bessel * (square[1 + c] - w * cell[c] / n);
          square[4 + c] = bessel * (square[4 + c] - cell[c] * cell[c] / n);
        }
      }
      const std::size_t at =
          std::size_t(y - crop.y0) * std::size_t(crop.Width()) + std::size_t(x - crop.x0);
      for (std::size_t i = 0; i < stride; ++i) buffer_->sums_[at * stride + i].Add(cell[i]);
    }
  }
}

void SplatBuffer::Finish() {
  const std::size_t stride = Stride();
  std::vector<double> sums(stride);
  for (std::size_t at = 0; at < film_->PixelCount(); ++at) {
    for (std::size_t i = 0; i < stride; ++i) sums[i] = sums_[at * stride + i].Total();
    film_->AddSums(at, {sums[0], sums[1], sums[2], sums[4]}, sums[3]);
    if (aovs_)
      aovs_->AddSums(at, sums.data(), sums.data() + kFilmValues, sums.data() + valueCount_);
  }
}

}  // namespace exphoton
