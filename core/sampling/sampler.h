// SPDX-License-Identifier: BSD-2-Clause
// Sampler is the interface that makes the points of a camera sample. SampleLayout holds the
// requests of integrators, and CameraSamples holds the points of one sample. Every value is a
// function of (seed, pixel, sample index, request), so tiles, crops, threads and the order of
// reading never change it. Nothing is stored for a whole pixel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace exphoton {

// SampleLayout holds the requests of an integrator: arrays of 1D and 2D points, each identified by
// a handle.
class SampleLayout {
 public:
  int Request1D(int count);  // count >= 0; returns the handle
  int Request2D(int count);

  std::span<const int> Counts1D() const;
  std::span<const int> Counts2D() const;

  // Whether the lens point and the time will be read. Samplers skip values that are not needed.
  bool needsLens = true, needsTime = true;

 private:
  std::vector<int> counts1D_, counts2D_;
};

// SampleKey identifies a sample of a pixel. Pixels count from the full image's corner, whatever the
// crop.
struct SampleKey {
  std::uint64_t seed = 0;
  Point2i pixel;
  std::int64_t index = 0;  // 0 .. SamplesPerPixel - 1, or more if IsProgressive
};

class Sampler;

// CameraSamples holds the points of one camera sample. A thread reuses it for all its samples.
// Arrays are generated on their first read, so unread arrays cost nothing.
class CameraSamples {
 public:
  explicit CameraSamples(const SampleLayout& layout);

  Point2 film;    // in [0,1)^2, to be warped by the filter
  Point2 lens;    // in [0,1)^2, if needed
  Real time = 0;  // in [0,1), if needed

  // Return the points of an array. They are valid from Sampler::Generate until its next call.
  std::span<const Real> Array1D(int handle) const;
  std::span<const Point2> Array2D(int handle) const;
  int Count1D() const { return int(arrays1D_.isMade.size()); }  // number of arrays
  int Count2D() const { return int(arrays2D_.isMade.size()); }
  bool NeedsLens() const { return needsLens_; }
  bool NeedsTime() const { return needsTime_; }

 private:
  friend class Sampler;

  template <class T>
  struct Arrays {
    explicit Arrays(std::span<const int> counts);
    std::vector<std::size_t> offsets;  // of each array's first value; the last is the total
    std::vector<T> values;
    std::vector<char> isMade;
  };
  template <class T>
  std::span<const T> Read(Arrays<T>& arrays, int handle, int firstRequest) const;

  bool needsLens_, needsTime_;
  const Sampler* sampler_ = nullptr;
  std::uint64_t key_ = 0;
  std::int64_t index_ = 0;
  mutable Arrays<Real> arrays1D_;
  mutable Arrays<Point2> arrays2D_;
};

class Sampler {
 public:
  virtual ~Sampler() = default;

  virtual std::int64_t SamplesPerPixel() const = 0;
  // Returns the best array size at or above `count` (for example the next power of two).
  virtual int RoundCount(int count) const { return count; }
  // Returns whether samples beyond SamplesPerPixel make sense, so that a render may continue or
  // stop anywhere.
  virtual bool IsProgressive() const { return false; }
  // Returns a sampler like this one with another number of samples per pixel (--spp).
  virtual std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const = 0;
  // Returns the samples per pixel of WithSamplesPerPixel(count), for count >= 1.
  virtual std::int64_t RoundSamplesPerPixel(std::int64_t count) const { return count; }

  // Begins a camera sample. The sampler must outlive every read of its arrays.
  void Generate(const SampleKey& key, CameraSamples* samples) const;

 protected:
  // Fills film, and lens and time if needed. The other points do not depend on these needs. Returns
  // a key for the pixel, which Fill receives.
  virtual std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const = 0;
  // Fills an array of sample `index`. Its points are well distributed in themselves and over the
  // samples of the pixel. Requests count from 0, 1D requests before 2D requests. Calls may come in
  // any order, or not at all.
  virtual void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
                    std::span<Real> values) const = 0;
  virtual void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
                    std::span<Point2> values) const = 0;

 private:
  friend class CameraSamples;
};

}  // namespace exphoton
