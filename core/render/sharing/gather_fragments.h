// SPDX-License-Identifier: BSD-2-Clause
// GatherFragments stores the gathers of a picture. The records of a pixel that lie on one surface
// form a fragment. The camera samples are divided into four groups with independent gathers. The
// first two groups choose how far gathers are shared, and the other two check the choice. All
// groups show how much of the light is shared.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/imaging/image.h"
#include "core/transport/gather_record.h"

namespace exphoton {

class ByteArchive;

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

constexpr int kGatherGroups = 4;
constexpr std::array<int, 2> kChoosingGroups{0, 1}, kCheckingGroups{2, 3};

// Returns the group of a camera sample. Of two samples in a pixel, both choose or both check, in
// squares of four pixels like the fields of a chessboard. Each pixel has both choosing groups, but
// only one of the checking groups: low-discrepancy samples of one pixel are not independent of each
// other, while those of different pixels are.
inline int GatherGroup(Point2i pixel, std::int64_t sample) {
  const std::int64_t pair = ((sample >> 1) + (pixel.x >> 2) + (pixel.y >> 2)) & 1;
  const std::int64_t parity = (pixel.x + pixel.y) & 1;
  return int(pair == 0 ? (sample + parity) & 1 : 2 + parity);
}

// What a camera sample contributes to the fragments of its pixel.
struct GatherShare {
  int group;
  Real records = 1;  // the part of a record that each of its gathers counts for
};

struct GatherFragment {
  Point2 film;  // mean position, in pixels
  Point3 p;     // mean
  Normal3 n, ng;
  int depth = 0;
  std::array<Real, kGatherGroups> count{};       // of records, by group; parts count as parts
  std::array<Spectrum, kGatherGroups> lights{};  // their sums, by group

  Real Count() const { return (count[0] + count[1]) + (count[2] + count[3]); }
  Spectrum Light() const { return (lights[0] + lights[1]) + (lights[2] + lights[3]); }
  Spectrum Mean(int group) const {
    return HasGroup(group) ? lights[std::size_t(group)] / count[std::size_t(group)] : Spectrum();
  }
  bool HasGroup(int group) const { return count[std::size_t(group)] > 0; }
};

// A record as it is kept until its shared light is known.
struct GatherSample {
  Point2 film;
  Normal3 n;
  Spectrum light, weight;
  Real sampleWeight;  // of the camera sample in the mean of its pixel, or its share if splatted
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
    void Add(const GatherRecords& records, Point2 film, Real sampleWeight, GatherShare share);
    void Finish();  // turns sums into means
    // Adds the records of another pass; both are finished. JoinFragments leaves out its samples,
    // and returns the place of each of its fragments.
    void Join(const Pixel& other);
    std::vector<std::uint32_t> JoinFragments(const Pixel& other);
    void Transfer(ByteArchive* archive);  // saves or loads
  };

  // Throws Error(Resource) if memory is insufficient for this number of samples a pixel.
  GatherFragments(const PixelBounds& bounds, std::int64_t samplesPerPixel);

  // Returns the memory of a pixel, including FragmentRows and FragmentFits. A pixel on an edge
  // takes more, because each part of a divided sample takes the place of a sample.
  static double BytesPerPixel(std::int64_t samplesPerPixel);

  // Moves the bounds down, to rows y0 to y1 - 1. Rows that stay within the bounds keep their
  // gathers, and the others are empty.
  void MoveDown(int y0, int y1);

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
