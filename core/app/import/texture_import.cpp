// SPDX-License-Identifier: BSD-2-Clause
// ImportTexture turns images upside down: t = 0 is the bottom row in versions 3 and 4 and the top
// row here. A texture that does not exist here becomes a constant.
#include "core/app/import/texture_import.h"

#include <cmath>
#include <cstdlib>

#include "core/app/import/directive_text.h"
#include "core/app/import/reading/later_color.h"

namespace exphoton::cli {
namespace {

class TextureImporter {
 public:
  TextureImporter(const Directive& directive, const ImportContext& context)
      : directive_(directive),
        context_(context),
        params_(directive.params, "Texture " + QuotedText(directive.strings[0]), context.report),
        isFloat_(directive.strings[1] == "float") {}

  std::string Run() {
    const std::string& type = directive_.strings[2];
    DirectiveText text("Texture", {directive_.strings[0], isFloat_ ? "float" : "color",
                                   IsKnown(type) ? type : "constant"});
    if (type == "constant") {
      Value("value", "value", 1, &text);
    } else if (type == "scale") {
      Scale(&text);
    } else if (type == "mix") {
      Value("tex1", "tex1", 0, &text);
      Value("tex2", "tex2", 1, &text);
      Amount(&text);
    } else if (type == "checkerboard") {
      Copy("dimension", &text);
      Mapping(false, &text);
      Value("tex1", "tex1", 1, &text);
      Value("tex2", "tex2", 0, &text);
      params_.Ignore({"aamode"});
    } else if (type == "imagemap") {
      ImageMap(&text);
    } else if (IsKnown(type)) {
      Mapping(false, &text);
      for (const char* name : {"inside", "outside", "v00", "v01", "v10", "v11", "octaves",
                               "roughness", "scale", "variation"})
        Copy(name, &text);
    } else {
      Value("value", "value", .5, &text);
      params_.Replaced("of class \"" + type + "\" is replaced by a constant");
    }
    params_.ReportRest();
    return text.Text();
  }

 private:
  static bool IsKnown(const std::string& type) {
    for (const char* name : {"constant", "scale", "mix", "checkerboard", "imagemap", "bilerp",
                             "dots", "fbm", "wrinkled", "windy", "marble"})
      if (type == name) return true;
    return false;
  }

  void Copy(const std::string& name, DirectiveText* text) {
    if (const ParsedParam* param = params_.Take(name)) text->Copy(*param, name);
  }

  // Takes a value, which may be a texture.
  void Value(const std::string& from, const char* to, double fallback, DirectiveText* text) {
    if (!isFloat_)
      return AddColor({from.c_str(), to, {fallback, fallback, fallback}}, params_, context_, text);
    if (const ParsedParam* param = params_.Take(from)) {
      text->Copy(*param, to);
    } else {
      text->Number(std::string("float ") + to, fallback);
    }
  }

  void Amount(DirectiveText* text) {
    if (const ParsedParam* amount = params_.Take("amount")) text->Copy(*amount, "amount");
  }

  // Version 4 multiplies the texture "tex" by the number or float texture "scale".
  void Scale(DirectiveText* text) {
    const bool isOf4 = params_.Has("tex") || params_.Has("scale");
    Value(isOf4 ? "tex" : "tex1", "tex1", 1, text);
    if (!isOf4) return Value("tex2", "tex2", 1, text);
    const ParsedParam* scale = params_.Take("scale");
    if (scale && scale->type == "texture" && !isFloat_) {
      params_.Replaced(*scale, "is a float texture: 1 takes its place");
      text->Numbers("color tex2", {1, 1, 1});
    } else if (scale && scale->type == "texture") {
      text->Copy(*scale, "tex2");
    } else {
      const double factor = scale && scale->numbers.size() == 1 ? scale->numbers[0] : 1;
      text->Numbers(
          isFloat_ ? "float tex2" : "color tex2",
          isFloat_ ? std::vector<double>{factor} : std::vector<double>{factor, factor, factor});
    }
  }

  // `isFlipped` turns t to 1 - t.
  void Mapping(bool isFlipped, DirectiveText* text) {
    const std::string mapping = params_.TakeString("mapping", "uv");
    if (mapping != "uv") text->String("string mapping", mapping);
    if (isFlipped && mapping != "uv" && mapping != "planar")
      params_.Replaced("of mapping \"" + mapping + "\" has its image upside down");
    Copy("uscale", text);
    Copy("udelta", text);
    Copy("v1", text);
    const double sign = isFlipped ? -1 : 1;
    const double scale = params_.TakeNumber("vscale", 1), delta = params_.TakeNumber("vdelta", 0);
    if (isFlipped || scale != 1) text->Number("float vscale", sign * scale);
    if (isFlipped || delta != 0) text->Number("float vdelta", isFlipped ? 1 - delta : delta);
    std::vector<double> v2{0, 1, 0};
    if (const ParsedParam* given = params_.Take("v2")) v2 = given->numbers;
    for (double& value : v2) value *= sign;
    if (mapping == "planar") text->Numbers("vector v2", v2);
  }

  void ImageMap(DirectiveText* text) {
    const std::string file = params_.TakeString("filename", "");
    text->String("string filename", FileNameFor(file, params_.Where(), context_));
    Mapping(true, text);
    const std::string wrap = params_.TakeString("wrap", "repeat");
    if (wrap == "octahedralsphere") {
      params_.Replaced("wraps its image by \"repeat\"");
    } else {
      text->String("string wrap", wrap);
    }
    Copy("maxanisotropy", text);
    Copy("trilinear", text);
    params_.Ignore({"filter"});
    // Here the scale comes before the exponent.
    const double gamma = Gamma(file), scale = params_.TakeNumber("scale", 1);
    if (gamma > 0) text->Number("float gamma", gamma);
    if (scale != 1) text->Number("float scale", gamma > 0 ? std::pow(scale, 1 / gamma) : scale);
  }

  // Returns the exponent, or 0 for the default. Files with 8 bits are decoded from sRGB by default,
  // in versions 3 and 4 and here in version 1.
  double Gamma(const std::string& file) {
    const auto ends = [&](const char* ending) { return file.ends_with(ending); };
    const std::string encoding = params_.TakeString("encoding", "sRGB");
    const bool isDecoded = params_.TakeBool("gamma", true);
    if (ends(".exr") || ends(".pfm") || ends(".hdr")) return 0;
    if (!isDecoded || encoding == "linear") return 1;
    if (encoding.starts_with("gamma ")) return std::strtod(encoding.c_str() + 6, nullptr);
    if (!context_.writesVersion2) return 0;
    params_.Replaced("is decoded by the exponent 2.2 instead of sRGB");
    return 2.2;
  }

  const Directive& directive_;
  const ImportContext& context_;
  LaterParams params_;
  bool isFloat_;
};

}  // namespace

std::string ImportTexture(const Directive& directive, const ImportContext& context) {
  return TextureImporter(directive, context).Run();
}

bool IsTextureInSpace(const Directive& directive) {
  const ParsedParam* mapping = directive.params.Find("mapping");
  const ParsedParam* dimension = directive.params.Find("dimension");
  for (const char* name : {"fbm", "wrinkled", "windy", "marble"})
    if (directive.strings[2] == name) return true;
  return (mapping && mapping->strings != std::vector<std::string>{"uv"}) ||
         (dimension && dimension->numbers == std::vector<double>{3});
}

}  // namespace exphoton::cli
