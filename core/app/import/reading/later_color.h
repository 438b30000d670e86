// SPDX-License-Identifier: BSD-2-Clause
// Colours of versions 3 and 4 become RGB: names and files of spectra, temperatures and XYZ.
#pragma once

#include <array>
#include <string>

#include "core/app/import/directive_text.h"
#include "core/app/import/import_context.h"
#include "core/app/import/reading/later_params.h"

namespace exphoton::cli {

using Rgb = std::array<double, 3>;

// Version 4 scales the spectrum of a light so that its luminance is 1, but not one given as RGB.
enum class ColorUse { Material, Light };

// Returns the colour of a parameter that is no texture. Reports a spectrum that is not known, and
// returns `fallback` for it.
Rgb ReadRgb(const ParsedParam& param, const Rgb& fallback, ColorUse use,
            const ImportContext& context);
// Returns the number of a parameter such as the index of refraction, which version 4 may give by
// the name of a spectrum. Takes `fallback` for an unknown name, and for a texture; reports both.
double ReadIndex(const ParsedParam& param, double fallback, const LaterParams& params,
                 const ImportContext& context);

struct ColorNames {
  const char *from, *to;  // names of the parameter in the scene and in the converted scene
  Rgb fallback;
};

// Takes the parameter `names.from` and writes it as `names.to`: a texture by its name, a colour as
// RGB. Writes the fallback if the parameter is absent.
void AddColor(const ColorNames& names, LaterParams& params, const ImportContext& context,
              DirectiveText* text);
std::vector<double> NumbersOf(const Rgb& color);

}  // namespace exphoton::cli
