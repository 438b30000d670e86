// SPDX-License-Identifier: BSD-2-Clause
// RenderTwoHalves: two passes, each of which fills a film of its own.
#include "core/render/passes/render_halves.h"

#include <algorithm>
#include <array>

#include "core/render/passes/accuracy/error_watch.h"
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
        sum_(&job.film, {}),
        error_({job, &parts_, &sum_, &renderer_}, std::nullopt, GroupSamples::Independent) {
    const std::int64_t count = std::max<std::int64_t>((job.sampler.SamplesPerPixel() + 1) / 2, 1);
    sampler_ = job.sampler.WithSamplesPerPixel(count);
  }

  PassesResult Run() {
    if (options_.resumed) Resume();
    while (sum_.Passes() < 2 && RunHalf()) {
    }
    PassesResult result;
    result.render = renderer_.Finish();
    error_.Describe(&result);
    result.reason = sum_.Passes() < 2 ? StopReason::Signal : StopReason::Samples;
    sum_.Describe(parts_.NeedsVariances(), &result);
    return result;
  }

 private:
  // Returns false if stopped.
  bool RunHalf() {
    Film* const half = films_[std::size_t(sum_.Passes())];
    const std::uint64_t seed = HashKey({options_.seed, kPassSeed, std::uint64_t(sum_.Passes())});
    job_.progress.BeginPicture(sum_.Passes(), 2);
    const bool isWhole =
        renderer_.Run({seed, seed, 0, sampler_->SamplesPerPixel()}, *sampler_, half);
    parts_.TakeAovs(true);
    if (isWhole) {
      TakeHalf(*half);
      error_.Add(*half, sampler_->SamplesPerPixel(), sum_.Passes() - 1);
      return true;
    }
    job_.film.Add(*half);
    return false;
  }

  void TakeHalf(const Film& half) {
    sum_.Add(half, sampler_->SamplesPerPixel(), sum_.Passes());
    parts_.Show(job_.film);
  }

  Checkpoint WrapCheckpoint(const Checkpoint& inner) {
    Checkpoint outer;
    outer.hasWork = inner.hasWork || sum_.Passes() > 0;
    outer.save = [this, inner](StateWriter* writer) {
      inner.save(writer);
      error_.Save(writer);
      if (sum_.Passes() == 0) return;
      SaveSection("first half", *films_[0], writer);
      parts_.SaveAovs(writer);
    };
    if (!inner.picture) return outer;
    outer.picture = [this, inner] {
      PictureSoFar picture = inner.picture();
      picture.halves = {*films_[0], *films_[1]};
      picture.halves[std::size_t(sum_.Passes())] = picture.film;
      if (sum_.Passes() == 0) return picture;
      picture.film = job_.film;
      picture.film.Add(picture.halves[1]);
      parts_.AddAovs(&picture);
      return picture;
    };
    return outer;
  }

  void Resume() {
    const StateFile& file = *options_.resumed;
    if (file.Has("first half")) {
      LoadSection("first half", films_[0], file);
      parts_.LoadAovs(file);
      TakeHalf(*films_[0]);
      job_.log.Notice("continuing \"" + file.Path() + "\" after the first half");
    }
    error_.Load(file);
  }

  const RenderJob& job_;
  std::array<Film*, 2> films_;
  PassParts parts_;
  const RenderOptions& options_;  // of one pass
  PassRenderer renderer_;
  PassSum sum_;
  ErrorWatch error_;
  std::unique_ptr<Sampler> sampler_;
};

}  // namespace

PassesResult RenderTwoHalves(const RenderJob& job, const RenderOptions& options, Film* first,
                             Film* second) {
  return Halves(job, options, {first, second}).Run();
}

}  // namespace exphoton
