// SPDX-License-Identifier: BSD-2-Clause
// These functions parse option values that are more than one number or word. Errors name the
// option.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/imaging/film/aovs.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"
#include "core/render/shards/shard_tiles.h"

namespace exphoton::cli {

// "0.25,0.75,0,1" for x0 x1 y0 y1, as fractions of the picture.
std::vector<Real> ParseCropWindow(const std::string& text,
                                  const std::string& option = "--cropwindow");
// "10,20,0,5": columns 10 to 19 of rows 0 to 4.
PixelBounds ParsePixelBounds(const std::string& text);
// "x,y": bounds of one pixel.
PixelBounds ParsePixel(const std::string& text, const std::string& option = "--pixel");
// "1920x1080": adds the overrides of the film's resolution.
void AddResolution(const std::string& text, std::vector<ParameterOverride>* overrides);
// "SurfaceIntegrator.maxdist=1.5".
ParameterOverride ParseOverride(const std::string& text);

// "90", "90s", "1.5m", "1h": positive duration, in seconds.
double ParseDuration(const std::string& option, const std::string& text);
// Smaller errors would need more samples than can be counted.
inline constexpr double kLeastPercentage = .001;
// "2%": a percentage from kLeastPercentage to 100, as a fraction.
double ParsePercentage(const std::string& option, const std::string& text);
// "3/16": the third of 16 shards.
Shard ParseShard(const std::string& text);
// "albedo,N,direct".
AovSet ParseAovList(const std::string& text);
std::string AllAovNames();

[[noreturn]] void FailUsage(const std::string& text, const std::string& hint = {});

}  // namespace exphoton::cli
