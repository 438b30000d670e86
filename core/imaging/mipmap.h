// SPDX-License-Identifier: BSD-2-Clause
// MipMap stores an image at decreasing resolutions, for filtered lookups of bounded cost. Images
// may have any size: levels are halved by area, which keeps the mean exactly. T is Real or
// Spectrum. Sources: Williams 1983 (pyramids); Heckbert 1989, "Fundamentals of Texture Mapping"
// (EWA).
#pragma once

#include <vector>

#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

enum class WrapMode { Repeat, Black, Clamp };  // the value outside [0,1]^2

template <class T>
class MipMap {
 public:
  // `texels` holds width * height texels, at least one, row by row from t = 0.
  MipMap(int width, int height, std::vector<T> texels, WrapMode wrap);

  // Bilinear lookup in the finest level.
  T Lookup(Point2 st) const { return Bilinear(0, Reduce(st)); }
  // Blends two levels whose texels are about as wide as the longest side of the footprint.
  T Trilinear(Point2 st, Point2 dstdx, Point2 dstdy) const;
  // Elliptical Gaussian over the footprint. The minor axis is widened to at least the major axis
  // divided by maxAnisotropy. This bounds the number of texels read to about (4 maxAnisotropy +
  // 5)^2.
  T Ewa(Point2 st, Point2 dstdx, Point2 dstdy, Real maxAnisotropy) const;

  int LevelCount() const { return int(levels_.size()); }
  int Width(int level = 0) const { return levels_[std::size_t(level)].width; }
  int Height(int level = 0) const { return levels_[std::size_t(level)].height; }
  // Coordinates outside the level follow the wrap mode.
  T Texel(int level, int x, int y) const;

 private:
  struct Level {
    int width, height;
    std::vector<T> texels;
  };
  // A footprint in texels of the finest level: {v : v' M^-1 v < 1}, M = [xx xy; xy yy].
  struct Footprint {
    Real xx, xy, yy;
  };

  static Level Halved(const Level& fine);
  Point2 Reduce(Point2 st) const;
  T Bilinear(int level, Point2 st) const;
  T EwaLevel(int level, Point2 st, const Footprint& footprint) const;
  // Blends two levels. lod is in octaves.
  template <class F>
  T Blend(Real lod, F&& atLevel) const;

  std::vector<Level> levels_;
  WrapMode wrap_;
};

extern template class MipMap<Real>;
extern template class MipMap<Spectrum>;

}  // namespace exphoton
