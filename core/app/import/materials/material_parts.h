// SPDX-License-Identifier: BSD-2-Clause
// These functions convert the parameters that many materials of versions 3 and 4 share.
#pragma once

#include "core/app/import/materials/material_import.h"
#include "core/app/import/reading/later_color.h"

namespace exphoton::cli {

inline constexpr Rgb kQuarter{.25, .25, .25}, kHalf{.5, .5, .5}, kOne{1, 1, 1}, kZero{0, 0, 0};
inline constexpr Rgb kCopperEta{.200438, .924033, 1.102212};
inline constexpr Rgb kCopperK{3.912949, 2.452848, 2.142188};

// Names of the roughness parameters: version 4 writes "interface.roughness" for a coat.
struct RoughnessNames {
  std::string prefix;       // "interface." or ""
  double fallback = 0;      // the default roughness
  bool isSeparate = false;  // the material here has "uroughness" and "vroughness"
};

// Takes the roughness in all its forms and writes it as the inverse of a Blinn exponent. Returns
// whether the surface is smooth: the roughness is 0 in the scene. Then nothing is written.
bool AddRoughness(const RoughnessNames& names, LaterParams& params, const ImportContext& context,
                  DirectiveText* text);
// Returns the inverse of the Blinn exponent whose lobe has the width of this roughness.
double GlossOf(double roughness, bool isRemapped, int version);

// Takes and reports the roughness of a material that is smooth here.
void ReplaceRoughness(const RoughnessNames& names, LaterParams& params);
// Takes "bumpmap" (version 3) or "displacement" (version 4) and reports "normalmap".
void AddBump(LaterParams& params, DirectiveText* text);

// What the importers of both versions share: a directive that they begin with the head, fill from
// the parameters and end with the bump map.
class MaterialImporter {
 protected:
  MaterialImporter(const MaterialHead& head, LaterParams& params, const ImportContext& context)
      : head_(head), params_(params), context_(context) {}

  std::string End(DirectiveText* text) const {
    AddBump(params_, text);
    return text->Text();
  }

  const MaterialHead& head_;
  LaterParams& params_;
  const ImportContext& context_;
};

std::optional<std::string> ImportMaterial3(const std::string& type, const MaterialHead& head,
                                           LaterParams& params, const ImportContext& context);
std::optional<std::string> ImportMaterial4(const std::string& type, const MaterialHead& head,
                                           LaterParams& params, const ImportContext& context);
// Returns "matte" for a material that has no equivalent, with the colour of one of its parameters.
std::string ReplaceByMatte(const std::string& type, const MaterialHead& head, LaterParams& params,
                           const ImportContext& context);

}  // namespace exphoton::cli
