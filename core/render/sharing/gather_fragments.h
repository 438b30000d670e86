// SPDX-License-Identifier: BSD-2-Clause
// GatherFragments stores the gathers of a picture. The records of a pixel that lie on one surface
// form a fragment. The camera samples are divided into two halves, so that the gathers of one half
// can be judged against those of the other half.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/imaging/image.h"
#include "core/transport/gather_record.h"

namespace exphoton {

// Two points lie on one smooth surface if the cosine of their normals is at least this, and if the
// line between them makes at most this sine, squared, with both tangent planes (26 and 6 degrees).
constexpr Real kSurfaceMinCosine = Real(.9), kSurfaceMaxSlope2 = Real(.01);
inline bool LieOnOneSurface(const Point3& p, const Normal3& pn, const Point3& q,
                            const Normal3& qn) {
  if (!(Dot(pn, qn) >= kSurfaceMinCosine)) return false;
  const Vector3 d = q - p;
  const Real limit = kSurfaceMaxSlope2 * LengthSquared(d);
  return Square(Dot(d, pn)) <= limit && Square(Dot(d, qn)) <= limit;
}

struct GatherFragment {
  Point2 film;  // mean position, in pixels
  Point3 p;     // mean
  Normal3 n, ng;
  int depth = 0;
  std::array<Real, 2> count{};       // of records, by half
  std::array<Spectrum, 2> lights{};  // their sums, by half

  Spectrum Mean(int half) const {
    return lights[std::size_t(half)] / std::max(count[std::size_t(half)], Real(1));
  }
  bool HasBothHalves() const { return count[0] > 0 && count[1] > 0; }
};

// A record as it is kept until its shared light is known.
struct GatherSample {
  Point2 film;
  Normal3 n;
  Spectrum light, weight;
  Real filterWeight;
  std::uint32_t fragment;  // index in its pixel
  int depth;
};

class GatherFragments {
 public:
  // The gathers of one pixel. Different threads may fill different pixels at once.
  struct Pixel {
    std::vector<GatherFragment> fragments;
    std::vector<GatherSample> samples;

    // Adds the records of one camera sample.
    void Add(const GatherRecords& records, Point2 film, Real filterWeight, int half);
    void Finish();  // turns sums into means
  };

  // Throws Error(Resource) if memory is insufficient for this number of samples a pixel.
  GatherFragments(const PixelBounds& bounds, std::int64_t samplesPerPixel);

  const PixelBounds& Bounds() const { return bounds_; }
  Pixel& At(Point2i pixel) { return pixels_[IndexOf(pixel)]; }
  const Pixel& At(Point2i pixel) const { return pixels_[IndexOf(pixel)]; }

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - bounds_.y0) * std::size_t(bounds_.Width()) +
           std::size_t(pixel.x - bounds_.x0);
  }
  PixelBounds bounds_;
  std::vector<Pixel> pixels_;
};

}  // namespace exphoton
