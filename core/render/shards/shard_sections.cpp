// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/shards/shard_sections.h"

#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

template <class Use>
void ForPixels(const PixelBounds& bounds, const PixelBounds& within, const Use& use) {
  for (int y = std::max(bounds.y0, within.y0); y < std::min(bounds.y1, within.y1); ++y)
    for (int x = std::max(bounds.x0, within.x0); x < std::min(bounds.x1, within.x1); ++x)
      use(Point2i{x, y});
}

void TransferBounds(ByteArchive* archive, PixelBounds* bounds) {
  archive->Values(&bounds->x0, &bounds->y0, &bounds->x1, &bounds->y1);
}

// Films of this size exist; larger numbers are damage.
bool IsPossible(const PixelBounds& full, const PixelBounds& crop) {
  return full.x0 == 0 && full.y0 == 0 && full.x1 > 0 && full.y1 > 0 && crop.x0 >= 0 &&
         crop.y0 >= 0 && crop.x1 <= full.x1 && crop.y1 <= full.y1 && !crop.IsEmpty() &&
         std::int64_t(full.x1) * full.y1 <= std::int64_t(1) << 40;
}

}  // namespace

void ShardLayout::Transfer(ByteArchive* archive) {
  archive->Values(&shard.index, &shard.count);
  TransferBounds(archive, &full);
  TransferBounds(archive, &crop);
  std::uint32_t bits = 0;
  for (const Aov aov : aovs.List()) bits |= 1u << int(aov);
  char shared = isShared ? 1 : 0, splatted = isSplatted ? 1 : 0;
  archive->Values(&bits, &samplesPerPixel, &passes, &shared, &splatted);
  if (!archive->IsLoading()) return;
  isShared = shared != 0;
  isSplatted = splatted != 0;
  aovs = {};
  for (int i = 0; i < kAovCount; ++i)
    if (bits >> i & 1u) aovs.Add(Aov(i));
  if (bits >> kAovCount != 0 || shard.count < 1 || shard.count > Shard::kMaxCount ||
      shard.index < 1 || shard.index > shard.count || !IsPossible(full, crop) ||
      samplesPerPixel < 1 || passes < 1)
    throw ArchiveError("its numbers contradict each other");
}

std::string PassSection(int pass, const std::string& what) {
  return "pass " + std::to_string(pass) + " " + what;
}

std::string TileSection(int pass, const std::string& what, const ShardTile& tile) {
  return PassSection(pass, what + " " + std::to_string(tile.number));
}

void TransferTileFilm(ByteArchive* archive, const ShardTile& tile, Film* film, AovFilm* aovs) {
  ForPixels(tile.bounds, film->Crop(), [&](Point2i pixel) {
    film->TransferPixel(archive, pixel);
    if (aovs) aovs->TransferPixel(archive, pixel);
  });
}

void TransferTileCorrections(ByteArchive* archive, const ShardTile& tile,
                             Corrections* corrections) {
  ForPixels(tile.bounds, corrections->Crop(),
            [&](Point2i pixel) { corrections->TransferPixel(archive, pixel); });
}

void TransferTileTimes(ByteArchive* archive, const ShardTile& tile, AovFilm* aovs) {
  ForPixels(tile.bounds, aovs->Crop(), [&](Point2i pixel) { aovs->TransferTime(archive, pixel); });
}

void TransferTileGathers(ByteArchive* archive, const ShardTile& tile, GatherFragments* gathers) {
  GatherFragments::Pixel dropped;
  ForPixels(tile.bounds, tile.bounds, [&](Point2i pixel) {
    const bool isInside = gathers->Bounds().Contains(pixel.x, pixel.y);
    (isInside ? gathers->At(pixel) : dropped).Transfer(archive);
  });
}

}  // namespace exphoton
