// SPDX-License-Identifier: BSD-2-Clause
// Picture: what one render leaves, whichever way it was decided how much to render, and the image
// that is made of it, with its layers.
#pragma once

#include <memory>

#include "core/app/options/options.h"
#include "core/imaging/film/aov_film.h"
#include "core/render/render_passes.h"

namespace exphoton::cli {

// Where a picture grows. layers and halves are there only if asked for.
struct PictureFilms {
  PictureFilms(const RenderCommand& command, const RenderSetup& setup);

  Film film;
  std::unique_ptr<AovFilm> aovs;
  std::unique_ptr<Film> halves[2];
};

// Renders as the command says: a fixed number of samples, by a stopping rule, or as two halves.
PassesResult RenderPicture(const RenderCommand& command, const RenderJob& job,
                           const RenderOptions& options,
                           std::chrono::steady_clock::time_point start, PictureFilms* films);

// The channels of the picture and of every layer; no attributes.
Image MakeImage(const PictureFilms& films, const PassesResult& result, bool premultiplyAlpha);

// Throws Error(CommandLine) for a layer that the scene's integrator does not know.
void CheckLayers(const RenderCommand& command, const RenderSetup& setup);

// "Albedo, N, half1, half2".
std::string LayerNames(const RenderCommand& command);

}  // namespace exphoton::cli
