// SPDX-License-Identifier: BSD-2-Clause
// These tests make certificates of pictures that are complete and of pictures that were stopped.
#include "core/app/output/picture.h"

#include <gtest/gtest.h>

#include "core/render/certificate/corrections.h"
#include "tests/support/test_scene.h"

namespace exphoton::cli {
namespace {

constexpr int kCertifiedSide = 16;

// Returns the certificate of a picture with this number of complete passes.
std::optional<Certificate> CertificateAfter(int passes, bool isComplete,
                                            const std::string& material = "\"matte\"") {
  const LoadedScene scene = LoadSceneText(
      TestHeader("\"photonmap\" \"integer causticphotons\" 0", kCertifiedSide, kCertifiedSide, 1) +
      FurnaceWorld(1, material));
  RenderCommand command;
  command.certifies = true;
  PictureFilms films(command, *scene.setup);
  for (int pass = 0; pass < passes; ++pass) {
    films.corrections->Add({1, 1}, {1, Spectrum(1), 1, 1}, 1);
    films.corrections->EndPass(pass, 1);
  }
  films.corrections->Add({2, 2}, {1, Spectrum(1), 1, 1}, 1);  // of a pass that was stopped
  PassesResult result;
  result.render.isComplete = isComplete;
  if (passes > 1) {
    result.noise = .01;
    result.levels.assign(std::size_t(3 * kCertifiedSide * kCertifiedSide), 1);
  }
  return CertificateOf(films, result, NotCovered(*scene.setup, 4));
}

// After Ctrl-C, the picture has the complete passes only.
TEST(CertificateOf, AStoppedPictureIsTheOneOfItsCompletePasses) {
  EXPECT_FALSE(CertificateAfter(1, false));
  const auto stopped = CertificateAfter(2, false), complete = CertificateAfter(2, true);
  ASSERT_TRUE(stopped && complete);
  EXPECT_EQ(stopped->corrections, 2);
  EXPECT_EQ(stopped->bias.squared, complete->bias.squared);
  EXPECT_EQ(stopped->notCovered, complete->notCovered);
}

// A picture with few samples has flatter bumps, which no correction shows.
TEST(CertificateOf, SaysThatTheBlurOfTexturesIsNotCovered) {
  const auto plain = CertificateAfter(2, true);
  const auto textured = CertificateAfter(
      2, true,
      "\"matte\" Texture \"t\" \"color\" \"checkerboard\" Material \"matte\" \"texture Kd\" \"t\"");
  ASSERT_TRUE(plain && textured);
  ASSERT_EQ(textured->notCovered.size(), plain->notCovered.size() + 1);
  EXPECT_EQ(textured->notCovered.back(),
            "the blur of textures and bumps, which are filtered for 4 samples a pixel "
            "(--footprint-spp)");
}

TEST(ReportCertificate, SaysThatPassesAreMissing) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ReportCertificate(CertificateAfter(1, false), log);
  ASSERT_EQ(log.Messages().size(), 1u);
  EXPECT_NE(log.Messages()[0].find("fewer than two independent groups of passes are complete"),
            std::string::npos);
}

}  // namespace
}  // namespace exphoton::cli
