// SPDX-License-Identifier: BSD-2-Clause
// SharingBias estimates the error that shared gathers add to a picture. The windows depend on the
// choosing groups of samples only. The shares of the fits depend on products within pixels, which
// have other noise than the products here (docs/decisions/0107-shares-of-fits.md). In a pixel of a
// checking group, the difference between the fit to this group and the pixel's own gathers is the
// bias of the fit plus noise. Both count with the share of the fit. The noise of neighbouring
// pixels is independent, because they belong to different checking groups. The product of their
// differences therefore has the squared bias as its expected value, where the bias of the two
// pixels is equal.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/imaging/film/film.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/sharing_estimate.h"
#include "core/render/sharing/windows/sharing_choice.h"

namespace exphoton {

// The products of the differences in a pixel and in its neighbours, in radiance squared. They may
// be negative. They are NaN if no neighbour has a difference.
struct CheckedPixel {
  Point2i pixel;
  // With the next pixel of the row, and of the column; by channel.
  std::array<std::array<double, 3>, 2> products;
};

// PixelCheck adds up, over the fragments of a pixel, the fit to a checking group minus the pixel's
// own gathers of this group, times the share of the fit, in radiance. The expected value of the sum
// is the bias of the shared light. `samples` is the number of camera samples of a pixel.
class PixelCheck {
 public:
  PixelCheck(const GatherFragments::Pixel& gathered, double samples);
  // Adds a fragment that has records of the group, with WindowFit::Difference times the share of
  // the fit.
  void Add(std::size_t fragment, const Spectrum& difference);
  // Returns nullopt if no fragment was added.
  const std::optional<Spectrum>& Difference() const { return sum_; }

 private:
  std::vector<Spectrum> weights_;  // of the fragments' light in the pixel
  std::optional<Spectrum> sum_;
};

// The differences of the pixels of a window.
class PixelDifferences {
 public:
  explicit PixelDifferences(const PixelBounds& window)
      : window_(window), values_(std::size_t(window.Width()) * std::size_t(window.Height())) {}
  const PixelBounds& Window() const { return window_; }
  std::optional<Spectrum>& At(Point2i pixel) { return values_[IndexOf(pixel)]; }
  const std::optional<Spectrum>& At(Point2i pixel) const { return values_[IndexOf(pixel)]; }

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - window_.y0) * std::size_t(window_.Width()) +
           std::size_t(pixel.x - window_.x0);
  }
  PixelBounds window_;
  std::vector<std::optional<Spectrum>> values_;
};

// Checks a pixel with the next ones of its row and of its column. A check needs the fits of three
// pixels, so only one pixel of each square of two by two is checked. `samples` is the number of
// camera samples of a pixel.
class SharingChecker {
 public:
  // The arguments must outlive this object.
  SharingChecker(const GatherFragments& gathers, const FragmentRows& rows,
                 const SharingChoice& choice, double samples)
      : gathers_(gathers), rows_(rows), choice_(choice), samples_(samples) {}

  // Returns the group that the checked pixels of the window need of this pixel; nullopt: none.
  static std::optional<int> GroupOf(const GatherFragments& gathers, Point2i pixel,
                                    const PixelBounds& window);
  // Returns nullopt for pixels that are not checked, and where a pixel has no record of its
  // checking group. `known` has the differences for GroupOf in a window (null: none).
  std::optional<CheckedPixel> Check(Point2i pixel, const PixelDifferences* known,
                                    FitNeighbours* scratch) const;
  // Returns the difference for the checking group of a pixel. It is 0 where nothing is shared.
  Spectrum Bias(Point2i pixel, FitNeighbours* scratch) const;

 private:
  std::optional<Spectrum> Difference(Point2i pixel, int group, FitNeighbours* scratch) const;

  const GatherFragments& gathers_;
  const FragmentRows& rows_;
  const SharingChoice& choice_;
  double samples_;
};

// Returns the larger one of the estimates from rows and from columns. A bias in a line of pixels
// shows along the line only. Returns nullopt if fewer than two blocks of 16 x 16 pixels have
// products. The film has the picture.
std::optional<SharingBias> EstimateSharingBias(const std::vector<CheckedPixel>& checked,
                                               const Film& film);

}  // namespace exphoton
