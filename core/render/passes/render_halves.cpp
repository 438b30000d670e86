// SPDX-License-Identifier: BSD-2-Clause
// RenderTwoHalves: two passes, each of which fills a film of its own.
#include "core/render/passes/render_halves.h"

#include <algorithm>
#include <array>

#include "core/render/certificate/corrections.h"
#include "core/render/passes/pass_parts.h"

namespace exphoton {
namespace {

class Halves {
 public:
  Halves(const RenderJob& job, const RenderOptions& options, std::array<Film*, 2> films)
      : job_(job),
        films_(films),
        parts_(job, options, [this](const Checkpoint& inner) { return WrapCheckpoint(inner); }),
        options_(parts_.Options()),
        renderer_(job_, options_),
        noise_(job.film.Crop(), 2) {
    const std::int64_t count = std::max<std::int64_t>((job.sampler.SamplesPerPixel() + 1) / 2, 1);
    sampler_ = job.sampler.WithSamplesPerPixel(count);
  }

  PassesResult Run() {
    if (options_.resumed) Resume();
    while (result_.passes < 2 && RunHalf()) {
    }
    result_.render = renderer_.Finish();
    if (result_.passes < 2) result_.reason = StopReason::Signal;
    if (result_.passes == 2) {
      result_.noise = noise_.RelativeVariance();
      if (parts_.NeedsVariances()) result_.variances = noise_.Variances();
    }
    return std::move(result_);
  }

 private:
  // Returns false if stopped.
  bool RunHalf() {
    Film* const half = films_[std::size_t(result_.passes)];
    const std::uint64_t seed = HashKey({options_.seed, kPassSeed, std::uint64_t(result_.passes)});
    const bool isWhole =
        renderer_.Run({seed, seed, 0, sampler_->SamplesPerPixel()}, *sampler_, half);
    parts_.TakeAovs();
    if (isWhole) return TakeHalf(*half), true;
    job_.film.Add(*half);
    return false;
  }

  void TakeHalf(const Film& half) {
    job_.film.Add(half);
    parts_.Show(job_.film);
    if (options_.corrections)
      options_.corrections->EndPass(result_.passes, sampler_->SamplesPerPixel());
    noise_.Add(result_.passes++, half, sampler_->SamplesPerPixel());
    result_.samplesPerPixel += sampler_->SamplesPerPixel();
  }

  Checkpoint WrapCheckpoint(const Checkpoint& inner) {
    Checkpoint outer;
    outer.hasWork = inner.hasWork || result_.passes > 0;
    outer.save = [this, inner](StateWriter* writer) {
      inner.save(writer);
      if (result_.passes == 0) return;
      SaveSection("first half", *films_[0], writer);
      parts_.SaveAovs(writer);
    };
    if (!inner.picture) return outer;
    outer.picture = [this, inner] {
      PictureSoFar picture = inner.picture();
      picture.halves = {*films_[0], *films_[1]};
      picture.halves[std::size_t(result_.passes)] = picture.film;
      if (result_.passes == 0) return picture;
      picture.film = job_.film;
      picture.film.Add(picture.halves[1]);
      parts_.AddAovs(&picture);
      return picture;
    };
    return outer;
  }

  void Resume() {
    const StateFile& file = *options_.resumed;
    if (!file.Has("first half")) return;
    LoadSection("first half", films_[0], file);
    parts_.LoadAovs(file);
    TakeHalf(*films_[0]);
    job_.log.Notice("continuing \"" + file.Path() + "\" after the first half");
  }

  const RenderJob& job_;
  std::array<Film*, 2> films_;
  PassParts parts_;
  const RenderOptions& options_;  // of one pass
  PassRenderer renderer_;
  PassNoise noise_;
  std::unique_ptr<Sampler> sampler_;
  PassesResult result_;
};

}  // namespace

PassesResult RenderTwoHalves(const RenderJob& job, const RenderOptions& options, Film* first,
                             Film* second) {
  return Halves(job, options, {first, second}).Run();
}

}  // namespace exphoton
