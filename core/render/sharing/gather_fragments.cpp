// SPDX-License-Identifier: BSD-2-Clause
// GatherFragments: records of a pixel are assigned to the first fragment on their surface.
#include "core/render/sharing/gather_fragments.h"

#include <algorithm>
#include <new>
#include <string>

#include "core/base/error.h"
#include "core/base/memory.h"

namespace exphoton {
namespace {

// Before Finish, positions are sums over all records; ng is the normal of the first record.
Point3 MeanPosition(const GatherFragment& fragment) {
  return fragment.p / (fragment.count[0] + fragment.count[1]);
}

}  // namespace

GatherFragments::GatherFragments(const PixelBounds& bounds, std::int64_t samplesPerPixel)
    : bounds_(bounds) {
  // A fragment is kept in its pixel and in the columns of FragmentRows. Most pixels have one.
  const double perPixel = double(sizeof(Pixel) + 2 * sizeof(GatherFragment)) +
                          double(samplesPerPixel) * double(sizeof(GatherSample));
  const double need = double(bounds.Width()) * bounds.Height() * perPixel;
  const std::string text = "shared gathers of " + std::to_string(bounds.Width()) + " x " +
                           std::to_string(bounds.Height()) + " pixels need " + Megabytes(need);
  const std::string hint = "render parts of the picture, or set \"sharedgather\" to false";
  if (need > PhysicalMemory())
    throw Error(ExitStatus::Resource, text + "; " + MemoryLimit() + "; " + hint);
  try {
    pixels_.resize(std::size_t(bounds.Width()) * std::size_t(bounds.Height()));
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::Resource, text + "; " + MemoryLimit() + "; " + hint);
  }
}

void GatherFragments::Pixel::Add(const GatherRecords& records, Point2 film, Real filterWeight,
                                 int half) {
  for (const GatherRecord& record : records) {
    const auto isOnSurface = [&](const GatherFragment& fragment) {
      return fragment.depth == record.depth &&
             LieOnOneSurface(MeanPosition(fragment), fragment.ng, record.p, record.ng);
    };
    auto fragment = std::find_if(fragments.begin(), fragments.end(), isOnSurface);
    if (fragment == fragments.end()) {
      fragments.emplace_back();
      fragment = fragments.end() - 1;
      fragment->ng = record.ng;
      fragment->depth = record.depth;
    }
    fragment->film = fragment->film + film;
    fragment->p += record.p;
    fragment->n += record.n;
    fragment->lights[std::size_t(half)] += record.light;
    fragment->count[std::size_t(half)] += 1;
    samples.push_back({film, record.n, record.light, record.weight, filterWeight,
                       std::uint32_t(fragment - fragments.begin()), record.depth});
  }
}

void GatherFragments::Pixel::Finish() {
  for (GatherFragment& fragment : fragments) {
    const Real scale = 1 / (fragment.count[0] + fragment.count[1]);
    fragment.film = fragment.film * scale;
    fragment.p = fragment.p * scale;
    fragment.n = fragment.n * scale;
  }
}

}  // namespace exphoton
