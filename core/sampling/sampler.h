// SPDX-License-Identifier: BSD-2-Clause
// Sampler: the interface that makes the points of a camera sample; SampleLayout: what integrators
// asked for; CameraSamples: the points of one sample. Every value is a function of (seed, pixel,
// sample index, request), so tiles, crops and threads never change it, and nothing is stored for a
// whole pixel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace exphoton {

// The requests of an integrator: arrays of 1D and 2D points, each known by a handle.
class SampleLayout {
 public:
  int Request1D(int count);  // count >= 0; returns the handle
  int Request2D(int count);

  std::span<const int> Counts1D() const { return counts1D_; }
  std::span<const int> Counts2D() const { return counts2D_; }

  // Whether the points on the lens and in time will be read: nobody makes what nobody reads.
  bool needsLens = true, needsTime = true;

 private:
  std::vector<int> counts1D_, counts2D_;
};

// Which sample of which pixel. Pixels count from the full image's corner, whatever the crop.
struct SampleKey {
  std::uint64_t seed = 0;
  Point2i pixel;
  std::int64_t index = 0;  // 0 .. SamplesPerPixel - 1, and beyond where the sampler can go on
};

// The points of one camera sample; reused by a thread for all its samples.
class CameraSamples {
 public:
  explicit CameraSamples(const SampleLayout& layout);

  Point2 film;    // in [0,1)^2, to be warped by the filter
  Point2 lens;    // in [0,1)^2, if needed
  Real time = 0;  // in [0,1), if needed

  std::span<const Real> Array1D(int handle) const;
  std::span<const Point2> Array2D(int handle) const;
  std::span<Real> Array1D(int handle);
  std::span<Point2> Array2D(int handle);
  int Count1D() const { return int(offsets1D_.size()) - 1; }  // number of arrays
  int Count2D() const { return int(offsets2D_.size()) - 1; }
  bool NeedsLens() const { return needsLens_; }
  bool NeedsTime() const { return needsTime_; }

 private:
  bool needsLens_, needsTime_;
  std::vector<std::size_t> offsets1D_, offsets2D_;
  std::vector<Real> values1D_;
  std::vector<Point2> values2D_;
};

class Sampler {
 public:
  virtual ~Sampler() = default;

  virtual std::int64_t SamplesPerPixel() const = 0;
  // The best array size at or above `count` (for example the next power of two).
  virtual int RoundCount(int count) const { return count; }
  // Whether samples beyond SamplesPerPixel make sense, so that a render may go on or stop anywhere.
  virtual bool IsProgressive() const { return false; }
  // A sampler like this one with another number of samples a pixel (--spp).
  virtual std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const = 0;

  // Fills film, every array, and lens and time if needed; the others' points do not depend on these
  // needs. Each array is well distributed in itself and over the samples of its pixel.
  virtual void Generate(const SampleKey& key, CameraSamples* samples) const = 0;
};

}  // namespace exphoton
