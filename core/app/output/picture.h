// SPDX-License-Identifier: BSD-2-Clause
// RenderPicture renders a picture into films. MakeImage combines the films into one image with
// AOVs.
#pragma once

#include <memory>

#include "core/app/options/options.h"
#include "core/imaging/film/aov_film.h"
#include "core/render/certificate/certificate.h"
#include "core/render/passes/render_passes.h"
#include "core/render/shards/picture_passes.h"
#include "core/render/state/checkpoints.h"

namespace exphoton::cli {

// PictureFilms holds the films of a picture. aovs, halves and corrections are null unless the
// command requests them.
struct PictureFilms {
  PictureFilms(const RenderCommand& command, const RenderSetup& setup);
  PictureFilms(const PixelBounds& full, const PixelBounds& crop, AovSet wanted, bool asTwoHalves);

  Film film;
  std::unique_ptr<AovFilm> aovs;
  std::unique_ptr<Film> halves[2];
  bool writesHalves = true;  // whether MakeImage appends the halves
  std::unique_ptr<Corrections> corrections;
};

// Renders as the command says: a fixed sample count, a stopping rule, or two halves.
PassesResult RenderPicture(const RenderCommand& command, const RenderJob& job,
                           const RenderOptions& options,
                           std::chrono::steady_clock::time_point start, PictureFilms* films);

// Returns the certificate of a picture. A picture that was stopped has the complete passes, and so
// has its certificate. Returns nullopt if the command asks for none, or if fewer than two groups of
// passes are complete.
std::optional<Certificate> CertificateOf(const PictureFilms& films, const PassesResult& result,
                                         std::vector<std::string> notCovered);

// Returns phrases for what certificates of the scene do not cover. `footprintSamples` is
// FootprintSamples of the render.
std::vector<std::string> NotCovered(const RenderSetup& setup, std::int64_t footprintSamples);

// Returns phrases for light that neither a picture for an accuracy nor its error contains.
std::vector<std::string> UnseenLight(const RenderCommand& command, const RenderSetup& setup);
void WarnOfUnseenLight(const std::vector<std::string>& lights, const std::string& integrator,
                       Log& log);

// Prints the certificate, or that there is none.
void ReportCertificate(const std::optional<Certificate>& certificate, Log& log);

// Throws Error(CommandLine) if the scene's integrator cannot do what --certify or --progressive
// asks for.
void CheckIntegrator(const RenderCommand& command, const RenderSetup& setup);

// Returns the passes of a picture that is rendered in shards.
PicturePasses PassesOf(const RenderCommand& command);

// Returns an image with the channels of the picture and of all AOVs, without attributes.
Image MakeImage(const PictureFilms& films, const PassesResult& result, bool premultiplyAlpha);

// Returns the same for a picture that is not finished.
Image MakeImage(const RenderCommand& command, const PictureSoFar& picture, bool premultiplyAlpha);

// Throws Error(CommandLine) for an AOV that the scene's integrator does not provide.
void CheckAovs(const RenderCommand& command, const RenderSetup& setup);

// "albedo, N, half1, half2".
std::string AovNames(const RenderCommand& command);

}  // namespace exphoton::cli
