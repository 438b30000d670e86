// SPDX-License-Identifier: BSD-2-Clause
// MergeShards: the tiles of all parts come in place of rendering. The rest of a pass is the code
// that renders use (PassBuffers).
#include "core/render/shards/merge_shards.h"

#include <optional>

#include "core/render/pass_buffers.h"
#include "core/render/passes/pass_parts.h"
#include "core/render/shards/merged_accuracy.h"
#include "core/render/shards/shard_statistics.h"
#include "core/render/state/checkpoints.h"

namespace exphoton {
namespace {

class Merger {
 public:
  Merger(const ShardMerge& merge, const MergedFilms& films, const SummaryTarget& summary,
         ThreadPool* threads)
      : merge_(merge), films_(films), summary_(summary), threads_(threads) {}

  PassesResult Run() {
    SetCounters(0);
    if (merge_.passes.kind == PicturePasses::Kind::Single) {
      AddPass(0, films_.film, films_.aovs);
      result_.passes = 1;
      result_.samplesPerPixel = merge_.layout.samplesPerPixel;
    } else {
      AddPasses();
    }
    TakeCounts(result_.passes - 1);
    result_.render = Summarize(summary_, totals_, nonFinite_);
    return std::move(result_);
  }

 private:
  const StateFile& PartOf(const ShardTile& tile) const {
    return *merge_.parts[std::size_t(tile.ShardOf(int(merge_.parts.size())) - 1)];
  }

  // Loads one section of each of these tiles. One file is open at a time.
  template <class Use>
  void ForTiles(int pass, const char* what, std::vector<ShardTile> tiles, const Use& use) const {
    const auto count = int(merge_.parts.size());
    std::stable_sort(tiles.begin(), tiles.end(), [count](const ShardTile& a, const ShardTile& b) {
      return a.ShardOf(count) < b.ShardOf(count);
    });
    const StateFile* open = nullptr;
    for (const ShardTile& tile : tiles) {
      const StateFile& part = PartOf(tile);
      if (open && open != &part) open->Close();
      open = &part;
      part.Read(TileSection(pass, what, tile), [&](ByteArchive* archive) { use(tile, archive); });
    }
    if (open) open->Close();
  }

  void LoadSplats(int pass, SplatBuffer* splats) const {
    const PixelBounds& crop = films_.film->Crop();
    for (const StateFile* part : merge_.parts) {
      for (int y = crop.y0; y < crop.y1; ++y)
        part->Read(PassSection(pass, "splats of row " + std::to_string(y)),
                   [&](ByteArchive* archive) { splats->AddRow(archive, y); });
      part->Close();
    }
  }

  // Adds the shared light band by band. A band reads the gathers of its rows and of a margin.
  void AddSharedLight(int pass, const std::vector<ShardTile>& tiles, PassBuffers* buffers) {
    SharingBands* const bands = buffers->Bands();
    int loaded = tiles.front().bounds.y0;  // the gathers of rows above are there
    for (; !bands->IsAtEnd(); bands->GoToNext()) {
      const int end = bands->Current().gathered.y1;
      std::vector<ShardTile> open = tiles;
      std::erase_if(open, [&](const ShardTile& tile) {
        return tile.bounds.y1 <= loaded || tile.bounds.y0 >= end;
      });
      ForTiles(pass, kGatherSection, std::move(open),
               [&](const ShardTile& tile, ByteArchive* archive) {
                 TransferTileGathers(archive, tile, buffers->Gathers());
               });
      loaded = end;
      buffers->AddSharedLight(true, threads_, &summary_.statistics);
    }
  }

  void AddPass(int pass, Film* film, AovFilm* aovs) {
    const ShardLayout& layout = merge_.layout;
    const PassBuffers::Layout inner{layout.isSplatted ? merge_.splatWeights : nullptr,
                                    layout.isShared,
                                    layout.samplesPerPixel,
                                    merge_.sharingMemory,
                                    nullptr,
                                    films_.corrections};
    PassBuffers buffers(inner, film, aovs);
    const std::vector<ShardTile> tiles = ShardTiles(PassBuffers::Rendered(inner, *film));
    ForTiles(pass, kTileSection, tiles, [&](const ShardTile& tile, ByteArchive* archive) {
      TransferTileFilm(archive, tile, film, aovs);
    });
    if (aovs && aovs->NeedsTime())
      ForTiles(pass, kTimeSection, tiles, [&](const ShardTile& tile, ByteArchive* archive) {
        TransferTileTimes(archive, tile, aovs);
      });
    if (films_.corrections)
      ForTiles(pass, kCorrectionSection, tiles, [&](const ShardTile& tile, ByteArchive* archive) {
        TransferTileCorrections(archive, tile, films_.corrections);
      });
    if (buffers.Splats()) LoadSplats(pass, buffers.Splats());
    if (buffers.Bands()) AddSharedLight(pass, tiles, &buffers);
    if (const auto bias = buffers.Finish(threads_, &summary_.statistics))
      totals_.AddSharingBias(*bias, layout.samplesPerPixel);
    totals_.AddLight(*film, layout.samplesPerPixel);
  }

  // Returns why the passes so far are the whole picture; nullopt: they are not. A result comes
  // before a limit.
  static std::optional<StopReason> ReasonOf(const PassSum& sum,
                                            const std::optional<MergedAccuracy>& accuracy) {
    const auto reached = accuracy ? accuracy->Reason() : std::nullopt;
    return reached ? reached : sum.Reason();
  }

  // Adds pass after pass, and stops where a render on one machine would stop.
  void AddPasses() {
    const PicturePasses& passes = merge_.passes;
    const std::int64_t samples = merge_.layout.samplesPerPixel;
    Film& film = *films_.film;
    std::optional<Film> one;
    if (passes.HasRule()) one.emplace(film.Full(), film.Crop());
    std::unique_ptr<AovFilm> aovs;
    if (films_.aovs) aovs = std::make_unique<AovFilm>(film.Crop(), films_.aovs->Wanted());
    PassSum::Limits limits{{}, passes.count * samples};
    if (passes.kind == PicturePasses::Kind::TargetError) limits.targetError = passes.targetError;
    PassSum sum(&film, limits);
    std::optional<MergedAccuracy> accuracy;
    if (passes.kind == PicturePasses::Kind::Accuracy)
      accuracy.emplace(passes.accuracy, films_.corrections);
    for (std::optional<StopReason> reason; !reason; reason = ReasonOf(sum, accuracy)) {
      const int pass = sum.Passes();
      Film* const passFilm = passes.HasRule() ? &*one : films_.halves[pass];
      passFilm->Clear();
      if (aovs) aovs->Clear();
      AddPass(pass, passFilm, aovs.get());
      sum.Add(*passFilm, samples, pass);
      if (accuracy) accuracy->EndPass(sum, totals_, samples, summary_.log);
      if (aovs) films_.aovs->Add(*aovs);
    }
    result_.reason = *ReasonOf(sum, accuracy);
    if (accuracy) accuracy->Describe(sum, &result_);
    sum.Describe(films_.aovs && films_.aovs->Wanted().Has(Aov::Variance), &result_);
  }

  ShardStatistics StatisticsOf(const StateFile& part, int pass) const {
    ShardStatistics statistics;
    LoadSection(PassSection(pass, "statistics").c_str(), &statistics, part);
    return statistics;
  }
  void SetCounters(int pass) {
    StatisticsOf(*merge_.parts.front(), pass).SetCounters(&summary_.statistics);
  }

  // Takes the counts up to a pass.
  void TakeCounts(int pass) {
    SetCounters(pass);
    StatisticsOf(*merge_.parts.front(), pass).AddRays(&summary_.statistics);
    for (const StateFile* part : merge_.parts) {
      RenderTotals totals;
      LoadSection(PassSection(pass, "totals").c_str(), &totals, *part);
      totals_.Add(totals);
      LoadSection(PassSection(pass, "non-finite samples").c_str(), &nonFinite_, *part);
      StatisticsOf(*part, pass).AddTimes(&summary_.statistics);
      part->Close();
    }
  }

  const ShardMerge& merge_;
  const MergedFilms& films_;
  const SummaryTarget& summary_;
  ThreadPool* threads_;
  PassesResult result_;
  RenderTotals totals_;
  NonFiniteLog nonFinite_;
};

}  // namespace

PassesResult MergeShards(const ShardMerge& merge, const MergedFilms& films,
                         const SummaryTarget& summary, ThreadPool* threads) {
  return Merger(merge, films, summary, threads).Run();
}

}  // namespace exphoton
