// SPDX-License-Identifier: BSD-2-Clause
// TurnDial chooses integrator, samples and photons for an accuracy (--accuracy). Choices follow
// from pilots and counted operations, so they depend on scene, options and seed only.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/app/options/options.h"
#include "core/parser/syntax/source.h"

namespace exphoton::cli {

struct Candidate;
class PilotRenderer;

// Writes the chosen settings to the command, and logs them. Returns the pilots, which may have the
// photons of the first pass. Throws Error if no integrator reaches the accuracy.
std::shared_ptr<PilotRenderer> TurnDial(RenderCommand* command, const std::string& scene,
                                        FileSource::Streams* streams, Log& log);

// Takes over the later choice of a stopped render, which the pilots do not repeat. Returns whether
// the command has changed.
bool ContinueChoice(const LaterChoice& stopped, RenderCommand* command, Log& log);

// Returns the samples per pixel that cost as much as the expected ones and the photons that the
// picture would have in addition, if a rival is expected to cost far less; nullopt: there is no
// such rival, or the dial may not do so.
std::optional<double> TooManySamples(const RenderCommand& command);

// Multiplies the photons after a render whose bias is too large for the accuracy, if the dial may
// do so. looks: at that render and earlier ones. Returns whether they became more.
bool RaisePhotons(int looks, RenderCommand* command, Log& log);

// Returns the number of groups of passes, at least 2, that should reach the accuracy.
double GroupsOf(const Candidate& chosen);

// Throws Error(CommandLine) for an integrator without an estimate of its error.
void CheckDialIntegrator(const std::string& integrator);

}  // namespace exphoton::cli
