// SPDX-License-Identifier: BSD-2-Clause
// Film: sums in double precision, so that the mean of 1e8 samples is as accurate as a single
// sample. Each pixel is divided by its weight once, at the end.
#include "core/imaging/film/film.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/files/byte_archive.h"

namespace exphoton {

PixelBounds FilmSettings::Crop() const {
  const std::vector<Real> window = cropWindow.value_or(std::vector<Real>{0, 1, 0, 1});
  // Computed in Real like the values in scene files: 0.2 of 300 pixels is 60, not 60.0000009.
  const auto pixel = [](int resolution, Real fraction) {
    const double edge = double(std::ceil(Real(resolution) * fraction));
    return int(std::clamp(edge, 0., double(resolution)));
  };
  return {pixel(xResolution, window[0]), pixel(yResolution, window[2]),
          pixel(xResolution, window[1]), pixel(yResolution, window[3])};
}

Film::Film(PixelBounds full, PixelBounds crop) : full_(full), crop_(crop) {
  if (full.IsEmpty()) throw Error(ExitStatus::Scene, "the film has no pixels");
  if (crop.IsEmpty() || crop.x0 < full.x0 || crop.y0 < full.y0 || crop.x1 > full.x1 ||
      crop.y1 > full.y1) {
    throw Error(ExitStatus::Scene, "the crop window holds no pixel of the film");
  }
  // Counts the pixels and the final image.
  const double need = double(crop.Width()) * crop.Height() * (sizeof(Pixel) + 4 * sizeof(float));
  const std::string text = "a film of " + std::to_string(crop.Width()) + " x " +
                           std::to_string(crop.Height()) + " pixels needs " + Megabytes(need);
  if (need > PhysicalMemory()) {
    throw Error(ExitStatus::Resource, text + "; " + MemoryLimit());
  }
  try {
    pixels_.resize(std::size_t(crop.Width()) * std::size_t(crop.Height()));
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::Resource, text + "; " + MemoryLimit());
  }
}

std::size_t Film::IndexOf(Point2i pixel) const {
  return std::size_t(pixel.y - crop_.y0) * std::size_t(crop_.Width()) +
         std::size_t(pixel.x - crop_.x0);
}

void Film::AddSample(Point2i pixel, const Spectrum& L, Real alpha, Real weight) {
  AddLight(pixel, L, weight);
  Pixel& p = pixels_[IndexOf(pixel)];
  p.alpha += double(weight) * double(alpha);
  p.weight += double(weight);
  ++p.samples;
  const auto a = float(std::abs(weight));
  p.absAlpha += a * float(alpha);
  p.absWeight += a;
}

void Film::AddLight(Point2i pixel, const Spectrum& L, Real weight) {
  Pixel& p = pixels_[IndexOf(pixel)];
  const double w = weight;
  p.r += w * double(L.r);
  p.g += w * double(L.g);
  p.b += w * double(L.b);
  const auto a = float(std::abs(weight));
  p.absR += a * float(L.r);
  p.absG += a * float(L.g);
  p.absB += a * float(L.b);
}

void Film::AddOwn(Point2i pixel, const Spectrum& L, Real alpha, Real share) {
  AddOwnLight(pixel, L, share);
  Pixel& p = pixels_[IndexOf(pixel)];
  p.absAlpha += float(share) * float(alpha);
  p.absWeight += float(share);
  ++p.samples;
}

void Film::AddOwnLight(Point2i pixel, const Spectrum& L, Real share) {
  Pixel& p = pixels_[IndexOf(pixel)];
  const auto s = float(share);
  p.absR += s * float(L.r);
  p.absG += s * float(L.g);
  p.absB += s * float(L.b);
}

void Film::AddSums(std::size_t index, const Sums& sums, double alpha) {
  Pixel& p = pixels_[index];
  p.r += sums.r;
  p.g += sums.g;
  p.b += sums.b;
  p.alpha += alpha;
  p.weight += sums.weight;
}

void Film::Clear() { std::fill(pixels_.begin(), pixels_.end(), Pixel()); }

void Film::Add(const Film& other) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    Pixel& p = pixels_[i];
    const Pixel& q = other.pixels_[i];
    p.r += q.r;
    p.g += q.g;
    p.b += q.b;
    p.alpha += q.alpha;
    p.weight += q.weight;
    p.samples += q.samples;
    p.absR += q.absR;
    p.absG += q.absG;
    p.absB += q.absB;
    p.absAlpha += q.absAlpha;
    p.absWeight += q.absWeight;
  }
}

void Film::SubtractLight(const Film& other) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    Pixel& p = pixels_[i];
    const Pixel& q = other.pixels_[i];
    p.r -= q.r;
    p.g -= q.g;
    p.b -= q.b;
    p.absR -= q.absR;
    p.absG -= q.absG;
    p.absB -= q.absB;
  }
}

void Film::Transfer(ByteArchive* archive) {
  for (const PixelBounds& bounds : {full_, crop_})
    for (const int edge : {bounds.x0, bounds.y0, bounds.x1, bounds.y1}) archive->Same(edge);
  for (Pixel& p : pixels_) TransferSums(archive, &p);
}

// An empty pixel takes one byte. The difference between two pictures has light without samples.
void Film::TransferSums(ByteArchive* archive, Pixel* p) {
  const bool hasLight = p->r != 0 || p->g != 0 || p->b != 0;
  const bool hasOwnLight = p->absR != 0 || p->absG != 0 || p->absB != 0;
  char isUsed = p->samples != 0 || p->weight != 0 || hasLight || hasOwnLight;
  archive->Values(&isUsed);
  if (!isUsed) return;
  archive->Values(&p->r, &p->g, &p->b, &p->alpha, &p->weight, &p->samples);
  archive->Values(&p->absR, &p->absG, &p->absB, &p->absAlpha, &p->absWeight);
}

std::int64_t Film::SampleCount(Point2i pixel) const { return pixels_[IndexOf(pixel)].samples; }

bool Film::HasSamples() const {
  return std::any_of(pixels_.begin(), pixels_.end(),
                     [](const Pixel& pixel) { return pixel.samples > 0; });
}

std::array<double, 4> Film::Pixel::Mean() const {
  if (samples == 0) return {};
  if (std::abs(weight) >= .5 * double(absWeight) && weight != 0)
    return {r / weight, g / weight, b / weight, alpha / weight};
  if (!(absWeight > 0)) return {};
  const double w = absWeight;
  return {double(absR) / w, double(absG) / w, double(absB) / w, double(absAlpha) / w};
}

Image Film::ToImage(bool premultiplyAlpha) const {
  Image image(crop_, full_, {"R", "G", "B", "A"});
  float* out = image.pixels.data();
  for (const Pixel& pixel : pixels_) {
    const std::array<double, 4> mean = pixel.Mean();
    const double alpha = std::clamp(mean[3], 0., 1.);
    const double scale = premultiplyAlpha ? alpha : 1;
    for (std::size_t c = 0; c < 3; ++c) *out++ = float(std::max(mean[c], 0.) * scale);
    *out++ = float(alpha);
  }
  return image;
}

}  // namespace exphoton
