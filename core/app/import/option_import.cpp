// SPDX-License-Identifier: BSD-2-Clause
// ImportOption writes out the defaults of versions 3 and 4, because those of version 1 differ.
#include "core/app/import/option_import.h"

#include <algorithm>
#include <cmath>

#include "core/app/import/directive_text.h"
#include "core/app/import/reading/later_params.h"

namespace exphoton::cli {
namespace {

class OptionImporter {
 public:
  OptionImporter(const Directive& directive, ImportContext* context)
      : type_(directive.strings[0]),
        context_(*context),
        params_(directive.params, std::string(directive.spec->name) + " " + QuotedText(type_),
                context->report) {}

  std::string Run(DirectiveId id) {
    const std::string text = Convert(id);
    params_.ReportRest();
    return text;
  }

 private:
  std::string Convert(DirectiveId id) {
    switch (id) {
      case DirectiveId::Film:
        return Film();
      case DirectiveId::Sampler:
        return Sampler();
      case DirectiveId::PixelFilter:
        return Filter();
      case DirectiveId::Integrator:
        return Integrator();
      case DirectiveId::Camera:
        return Camera();
      default:
        return Accelerator();
    }
  }

  void Copy(const char* name, DirectiveText* text) {
    if (const ParsedParam* param = params_.Take(name)) text->Copy(*param, name);
  }

  std::string Film() {
    DirectiveText text("Film", {"image"});
    text.String("string filename", params_.TakeString("filename", "pbrt.exr"));
    text.Number("integer xresolution", params_.TakeNumber("xresolution", 1280));
    text.Number("integer yresolution", params_.TakeNumber("yresolution", 720));
    Copy("cropwindow", &text);
    params_.Ignore({"diagonal", "savefp16"});
    if (context_.version == 3) {
      context_.lightFactor = params_.TakeNumber("scale", 1);
    } else {
      Exposure();
      if (type_ == "gbuffer") params_.Note("becomes \"image\": --aov writes its channels");
    }
    if (context_.lightFactor != 1)
      params_.Note("multiplies all lights by " + ExactText(context_.lightFactor) +
                   ", which is the factor of its pixels");
    return text.Text();
  }

  // Version 4 multiplies the pixels by the exposure time and the sensitivity.
  void Exposure() {
    const double seconds = params_.TakeNumber("exposuretime", 1);
    const double iso = params_.TakeNumber("iso", 100);
    context_.lightFactor = seconds * iso / 100;
    if (const ParsedParam* sensor = params_.Take("sensor");
        sensor && sensor->strings != std::vector<std::string>{"cie1931"})
      params_.Replaced(*sensor, "is replaced by \"cie1931\"");
    if (params_.TakeNumber("whitebalance", 0) != 0)
      params_.LeftOut(*params_.Take("whitebalance"), "colours are not balanced");
  }

  std::string Sampler() {
    const double samples =
        params_.TakeNumber("pixelsamples", context_.version == 3 && type_ == "random" ? 4 : 16);
    params_.Ignore({"dimensions", "seed", "randomization", "samplepixelcenter"});
    if (type_ == "stratified") {
      DirectiveText text("Sampler", {type_});
      text.Number("integer xsamples", params_.TakeNumber("xsamples", 4));
      text.Number("integer ysamples", params_.TakeNumber("ysamples", 4));
      Copy("jitter", &text);
      return text.Text();
    }
    const bool isRandom = type_ == "random" || type_ == "independent";
    const std::string name = isRandom ? "random" : type_ == "halton" ? "halton" : "lowdiscrepancy";
    DirectiveText text("Sampler", {name});
    text.Number("integer pixelsamples", samples);
    if (name != type_) params_.Note("becomes \"" + name + "\": only the noise differs");
    return text.Text();
  }

  std::string Filter() {
    if (type_ == "sinc") return Sinc();
    if (!IsFilter()) {
      params_.Replaced("is replaced by \"box\"");
      return DirectiveText("PixelFilter", {"box"}).Text();
    }
    const bool isOf3 = context_.version == 3;
    const double radius = type_ == "box" ? .5 : !isOf3 && type_ == "gaussian" ? 1.5 : 2;
    DirectiveText text("PixelFilter", {type_});
    text.Number("float xwidth", Width('x', radius)).Number("float ywidth", Width('y', radius));
    if (type_ == "gaussian") {
      const double sigma = params_.TakeNumber("sigma", .5);
      text.Number("float alpha", isOf3 ? params_.TakeNumber("alpha", 2) : 1 / (2 * sigma * sigma));
    }
    Copy("B", &text);
    Copy("C", &text);
    return text.Text();
  }
  // In versions 3 and 4 the filter is sinc(x) sinc(x / tau), cut at the radius. Here it is
  // sinc(x tau / width) sinc(x / width), cut at the width.
  std::string Sinc() {
    const double tau = params_.TakeNumber("tau", 3);
    const double xRadius = Width('x', 4), yRadius = Width('y', 4);
    if (xRadius != tau || yRadius != tau)
      params_.Replaced("ends at its \"tau\" of " + ExactText(tau) +
                       " pixels, and not at its radius of " + ExactText(xRadius) + " and " +
                       ExactText(yRadius));
    DirectiveText text("PixelFilter", {type_});
    text.Number("float xwidth", tau).Number("float ywidth", tau).Number("float tau", tau);
    return text.Text();
  }
  bool IsFilter() const {
    for (const char* name : {"box", "triangle", "gaussian", "mitchell"})
      if (type_ == name) return true;
    return false;
  }
  // Version 3 calls the radius a width.
  double Width(char axis, double fallback) {
    return params_.TakeNumber(std::string(1, axis) + (context_.version == 3 ? "width" : "radius"),
                              fallback);
  }

  // Versions 3 and 4 count surfaces, and version 1 counts the bounces after the first surface.
  double Depth() { return std::max(0., params_.TakeNumber("maxdepth", 5) - 1); }

  std::string Integrator() {
    params_.Ignore({"rrthreshold", "lightsamplestrategy", "lightsampler", "regularize",
                    "visualizestrategies", "visualizeweights", "imagewritefrequency"});
    if (type_ == "bdpt") return WithDepth("bidirectional");
    if (type_ == "sppm") return PhotonMap();
    if (type_ == "whitted") return WithDepth("whitted");
    if (type_ == "directlighting") {
      params_.Ignore({"strategy"});
      return WithDepth("directlighting");
    }
    if (type_ == "ao" || type_ == "ambientocclusion") return Occlusion();
    if (type_ == "volpath" || type_ == "simplevolpath")
      params_.Note("becomes \"path\": media are reported where the scene defines them");
    else if (type_ != "path" && type_ != "simplepath")
      params_.Note("becomes \"path\": only the noise differs");
    if (type_ == "mlt")
      params_.Ignore(
          {"bootstrapsamples", "chains", "mutationsperpixel", "largestepprobability", "sigma"});
    params_.Ignore({"samplelights", "samplebsdf"});
    return WithDepth("path");
  }

  std::string WithDepth(const std::string& name) {
    DirectiveText text("SurfaceIntegrator", {name});
    text.Number("integer maxdepth", Depth());
    return text.Text();
  }

  std::string PhotonMap() {
    DirectiveText text("SurfaceIntegrator", {"exphotonmap"});
    params_.Ignore({"iterations", "numiterations", "photonsperiteration", "imagewritefrequency",
                    "radius", "seed"});
    const double depth = params_.TakeNumber("maxdepth", 5);
    params_.Replaced("is replaced by \"exphotonmap\", which follows light over more than " +
                     ExactText(depth) + " surfaces");
    return text.Text();
  }

  std::string Occlusion() {
    DirectiveText text("SurfaceIntegrator", {"ambientocclusion"});
    if (const double samples = params_.TakeNumber("nsamples", 64); context_.version == 3)
      text.Number("integer nsamples", samples);
    if (const ParsedParam* distance = params_.Take("maxdistance")) text.Copy(*distance, "maxdist");
    params_.Ignore({"cossample"});
    return text.Text();
  }

  std::string Camera() {
    std::string name = type_;
    if (type_ == "spherical") {
      name = "environment";
      if (params_.TakeString("mapping", "equalarea") != "equirectangular")
        params_.Replaced("shows latitude and longitude instead of equal areas");
    } else if (type_ != "perspective" && type_ != "orthographic" && type_ != "environment") {
      name = "perspective";
      params_.Replaced("is replaced by \"perspective\" without a lens");
    }
    DirectiveText text("Camera", {name});
    for (const char* param : {"frameaspectratio", "screenwindow", "lensradius", "focaldistance",
                              "shutteropen", "shutterclose"})
      Copy(param, &text);
    if (name == "perspective") {
      Copy("fov", &text);
      Copy("halffov", &text);
    }
    return text.Text();
  }

  std::string Accelerator() {
    params_.Ignore({"maxnodeprims", "splitmethod", "intersectcost", "traversalcost", "emptybonus",
                    "maxprims", "maxdepth"});
    return DirectiveText("Accelerator", {type_ == "kdtree" ? "kdtree" : "bvh"}).Text();
  }

  const std::string& type_;
  ImportContext& context_;
  LaterParams params_;
};

}  // namespace

std::string ImportOption(const Directive& directive, ImportContext* context) {
  return OptionImporter(directive, context).Run(directive.spec->id);
}

Directive DefaultOption(DirectiveId id, int version) {
  const bool isOf3 = version == 3;
  Directive directive;
  const auto make = [&](const char* name, const char* plugin) {
    directive.spec = FindDirective(name, SceneGrammar::Later);
    directive.strings = {plugin};
  };
  switch (id) {
    case DirectiveId::Film:
      make("Film", isOf3 ? "image" : "rgb");
      break;
    case DirectiveId::Sampler:
      make("Sampler", isOf3 ? "halton" : "zsobol");
      break;
    case DirectiveId::PixelFilter:
      make("PixelFilter", isOf3 ? "box" : "gaussian");
      break;
    default:
      make("Integrator", isOf3 ? "path" : "volpath");
  }
  return directive;
}

}  // namespace exphoton::cli
