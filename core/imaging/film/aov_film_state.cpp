// SPDX-License-Identifier: BSD-2-Clause
// AovFilm: saves and loads the sums, all at once for a stopped render or by pixel for a part.
#include "core/files/byte_archive.h"
#include "core/imaging/film/aov_film.h"

namespace exphoton {

void AovFilm::Transfer(ByteArchive* archive) {
  for (const std::size_t size :
       {weights_.size(), values_.size(), surfaceValues_.size(), surfaceWeights_.size(),
        objects_.size(), materials_.size(), moments_.size(), seconds_.size(), distances_.size(),
        reads_.size(), biases_.size()})
    archive->Same(std::uint64_t(size));
  for (IdShares* shares : {&objectShares_, &materialShares_})
    for (std::size_t pixel = 0; pixel < shares->Count(); ++pixel)
      shares->TransferPixel(archive, pixel);
  char isSplatted = isSplatted_ ? 1 : 0;
  archive->Values(&isSplatted);
  isSplatted_ = isSplatted != 0;
  for (Weights& w : weights_) archive->Values(&w.sum, &w.sumOfSquares, &w.samples, &w.absSum);
  for (Value& value : values_) archive->Values(&value.sum, &value.absSum);
  for (double& sum : surfaceValues_) archive->Values(&sum);
  for (SurfaceWeights& w : surfaceWeights_) archive->Values(&w.all, &w.hit);
  for (std::vector<Majority>* ids : {&objects_, &materials_})
    for (Majority& majority : *ids) archive->Values(&majority.id, &majority.lead);
  for (Moments& m : moments_) archive->Values(&m.wwLL, &m.wwL, &m.wL);
  for (double& seconds : seconds_) archive->Values(&seconds);
  for (double& distance : distances_) archive->Values(&distance);
  for (std::int64_t& reads : reads_) archive->Values(&reads);
  for (Bias& bias : biases_)
    archive->Values(&bias.samples, &bias.sums[0], &bias.sums[1], &bias.sums[2]);
}

void AovFilm::TransferPixel(ByteArchive* archive, Point2i pixel) {
  const std::size_t at = IndexOf(pixel);
  Weights& w = weights_[at];
  archive->Values(&w.sum, &w.sumOfSquares, &w.samples, &w.absSum);
  for (std::size_t i = 0; i < valueCount_; ++i) {
    Value& value = values_[at * valueCount_ + i];
    archive->Values(&value.sum, &value.absSum);
  }
  for (std::size_t i = 0; i < surfaceCount_; ++i)
    archive->Values(&surfaceValues_[at * surfaceCount_ + i]);
  if (!surfaceWeights_.empty()) archive->Values(&surfaceWeights_[at].all, &surfaceWeights_[at].hit);
  for (std::vector<Majority>* ids : {&objects_, &materials_})
    if (!ids->empty()) archive->Values(&(*ids)[at].id, &(*ids)[at].lead);
  objectShares_.TransferPixel(archive, at);
  materialShares_.TransferPixel(archive, at);
  for (std::size_t c = 0; c < 3 && !moments_.empty(); ++c) {
    Moments& m = moments_[at * 3 + c];
    archive->Values(&m.wwLL, &m.wwL, &m.wL);
  }
  if (!reads_.empty()) archive->Values(&distances_[at], &reads_[at]);
}

void AovFilm::TransferTime(ByteArchive* archive, Point2i pixel) {
  if (!seconds_.empty()) archive->Values(&seconds_[IndexOf(pixel)]);
}

}  // namespace exphoton
