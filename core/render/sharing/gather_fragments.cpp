// SPDX-License-Identifier: BSD-2-Clause
// GatherFragments: records of a pixel are assigned to the first fragment on their surface.
#include "core/render/sharing/gather_fragments.h"

#include <algorithm>
#include <new>
#include <string>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

// Before Finish, positions are sums over all records; ng is the normal of the first record.
Point3 MeanPosition(const GatherFragment& fragment) { return fragment.p / fragment.Count(); }

// Adds a finished fragment of the same surface to a finished fragment.
void AddTo(GatherFragment* fragment, const GatherFragment& added) {
  const Real share = added.Count() / (fragment->Count() + added.Count());
  fragment->film = fragment->film + (added.film - fragment->film) * share;
  fragment->p += (added.p - fragment->p) * share;
  fragment->n += (added.n - fragment->n) * share;
  for (std::size_t group = 0; group < kGatherGroups; ++group) {
    fragment->count[group] += added.count[group];
    fragment->lights[group] += added.lights[group];
  }
}

}  // namespace

// A fragment is kept in its pixel and in the columns of FragmentRows, and its fit takes about as
// much (fragment_fits.cpp). Most pixels have one.
double GatherFragments::BytesPerPixel(std::int64_t samplesPerPixel) {
  return double(sizeof(Pixel) + 3 * sizeof(GatherFragment)) +
         double(samplesPerPixel) * double(sizeof(GatherSample));
}

GatherFragments::GatherFragments(const PixelBounds& bounds, std::int64_t samplesPerPixel)
    : bounds_(bounds) {
  const double need = double(bounds.Width()) * bounds.Height() * BytesPerPixel(samplesPerPixel);
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

void GatherFragments::MoveDown(int y0, int y1) {
  const auto width = std::size_t(bounds_.Width());
  const auto dropped = std::size_t(std::clamp(y0 - bounds_.y0, 0, bounds_.Height())) * width;
  // The pixels of dropped rows are used again below, with the memory that they hold.
  std::rotate(pixels_.begin(), pixels_.begin() + std::ptrdiff_t(dropped), pixels_.end());
  for (std::size_t i = pixels_.size() - dropped; i < pixels_.size(); ++i) {
    pixels_[i].fragments.clear();
    pixels_[i].samples.clear();
  }
  bounds_.y0 = y0;
  bounds_.y1 = y1;
  pixels_.resize(width * std::size_t(bounds_.Height()));
}

void GatherFragments::Pixel::Add(const GatherRecords& records, Point2 film, Real sampleWeight,
                                 GatherShare share) {
  constexpr std::size_t kUsualSamples = 4;  // of a pixel, at least, where gathers are shared
  if (samples.empty()) samples.reserve(kUsualSamples);
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
    const auto group = std::size_t(share.group);
    fragment->film = fragment->film + film * share.records;
    fragment->p += record.p * share.records;
    fragment->n += record.n * share.records;
    fragment->lights[group] += record.light * share.records;
    fragment->count[group] += share.records;
    samples.push_back({film, record.n, record.light, record.weight, sampleWeight,
                       std::uint32_t(fragment - fragments.begin()), record.depth});
  }
}

std::vector<std::uint32_t> GatherFragments::Pixel::JoinFragments(const Pixel& other) {
  std::vector<std::uint32_t> places;
  for (const GatherFragment& added : other.fragments) {
    const auto isOnSurface = [&](const GatherFragment& fragment) {
      return fragment.depth == added.depth &&
             LieOnOneSurface(fragment.p, fragment.ng, added.p, added.ng);
    };
    const auto fragment = std::find_if(fragments.begin(), fragments.end(), isOnSurface);
    places.push_back(std::uint32_t(fragment - fragments.begin()));
    if (fragment == fragments.end())
      fragments.push_back(added);
    else
      AddTo(&*fragment, added);
  }
  return places;
}

void GatherFragments::Pixel::Join(const Pixel& other) {
  const std::vector<std::uint32_t> places = JoinFragments(other);
  samples.reserve(samples.size() + other.samples.size());
  for (const GatherSample& sample : other.samples) {
    samples.push_back(sample);
    samples.back().fragment = places[sample.fragment];
  }
}

void GatherFragments::Pixel::Transfer(ByteArchive* archive) {
  const auto vector = [archive](auto* v) { archive->Values(&v->x, &v->y, &v->z); };
  const auto color = [archive](Spectrum* s) { archive->Values(&s->r, &s->g, &s->b); };
  fragments.resize(archive->Count(fragments.size(), 27 * sizeof(Real)));
  for (GatherFragment& fragment : fragments) {
    archive->Values(&fragment.film.x, &fragment.film.y, &fragment.depth);
    vector(&fragment.p), vector(&fragment.n), vector(&fragment.ng);
    for (std::size_t group = 0; group < kGatherGroups; ++group) {
      archive->Values(&fragment.count[group]);
      color(&fragment.lights[group]);
    }
  }
  samples.resize(archive->Count(samples.size(), 12 * sizeof(Real)));
  for (GatherSample& sample : samples) {
    archive->Values(&sample.film.x, &sample.film.y, &sample.sampleWeight, &sample.fragment,
                    &sample.depth);
    vector(&sample.n), color(&sample.light), color(&sample.weight);
    if (sample.fragment >= fragments.size()) throw ArchiveError("a gather has no fragment");
  }
}

void GatherFragments::Pixel::Finish() {
  for (GatherFragment& fragment : fragments) {
    const Real scale = 1 / fragment.Count();
    fragment.film = fragment.film * scale;
    fragment.p = fragment.p * scale;
    fragment.n = fragment.n * scale;
  }
}

}  // namespace exphoton
