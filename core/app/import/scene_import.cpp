// SPDX-License-Identifier: BSD-2-Clause
// ImportScene writes one file: included and imported files become part of it. Named materials are
// written where they are used, because MakeNamedMaterial would make the scene one of version 2.
// Only a scene with blends of named materials becomes one of version 2.
#include "core/app/import/scene_import.h"

#include <algorithm>
#include <set>

#include "core/app/import/directive_text.h"
#include "core/app/import/import_context.h"
#include "core/app/import/light_import.h"
#include "core/app/import/materials/material_import.h"
#include "core/app/import/option_import.h"
#include "core/app/import/reading/later_params.h"
#include "core/app/import/reading/later_scan.h"
#include "core/app/import/shape_import.h"
#include "core/app/import/texture_import.h"
#include "core/params/suggestions.h"

namespace exphoton::cli {
namespace {

class SceneImporter final : public LaterReader {
 public:
  SceneImporter(SceneSource& source, const LaterScan& scan, ImportContext& context, Log& log,
                const SceneLimits& limits)
      : LaterReader(source, log, limits), scan_(scan), context_(context) {}

  const std::string& Text() const { return text_; }

 protected:
  void Visit(const Directive& directive) override {
    if (VisitOption(directive) || VisitMaterial(directive) || VisitContents(directive)) return;
    VisitOther(directive);
  }

  void End(const SourceLocation&) override {
    if (isInWorld_) Write("WorldEnd\n");
  }

 private:
  bool IsOf4() const { return context_.version == 4; }
  void Write(const std::string& text) { Write(text, State().Depth()); }
  void Write(const std::string& text, std::size_t depth) {
    // Long lists keep their own line breaks.
    text_ += std::string(2 * std::min<std::size_t>(depth, 20), ' ') + text;
  }

  bool VisitOption(const Directive& directive) {
    switch (directive.spec->id) {
      case DirectiveId::Film:
      case DirectiveId::Sampler:
      case DirectiveId::PixelFilter:
      case DirectiveId::Integrator:
      case DirectiveId::Camera:
      case DirectiveId::Accelerator:
        options_.insert(directive.spec->id);
        Write(ImportOption(directive, &context_));
        return true;
      case DirectiveId::WorldBegin:
        BeginWorld(directive);
        return true;
      case DirectiveId::WorldEnd:
        Write("WorldEnd\n");
        isInWorld_ = false;
        options_.clear();
        return true;
      default:
        return false;
    }
  }

  void BeginWorld(const Directive& directive) {
    for (const DirectiveId id : {DirectiveId::Film, DirectiveId::Sampler, DirectiveId::PixelFilter,
                                 DirectiveId::Integrator}) {
      if (options_.contains(id)) continue;
      Directive option = DefaultOption(id, context_.version);
      option.params.where = directive.Where();
      Write(ImportOption(option, &context_));
    }
    Write("WorldBegin\n");
    isInWorld_ = true;
    // The default material of versions 3 and 4.
    Write(DirectiveText("Material", {"matte"}).Numbers("color Kd", {.5, .5, .5}).Text());
    if (IsOf4()) WriteDefinitions();
  }

  // Textures and named materials of version 4 do not end with a block.
  void WriteDefinitions() {
    for (const PlacedTexture& texture : scan_.Textures()) {
      const bool isPlaced = IsTextureInSpace(texture.directive) && !texture.transform.IsIdentity();
      if (isPlaced) Write("TransformBegin\n" + MatrixText(texture.transform));
      Write(ImportTexture(texture.directive, context_));
      if (isPlaced) Write("TransformEnd\n");
    }
    if (!context_.writesVersion2) return;
    for (const auto& [name, definition] : scan_.Materials()) DefineMaterial(name, definition);
  }

  static std::string MatrixText(const Transform& transform) {
    std::vector<double> numbers;
    for (std::size_t column = 0; column < 4; ++column)
      for (std::size_t row = 0; row < 4; ++row)
        numbers.push_back(transform.Matrix().m[row][column]);
    return "Transform " + NumbersText(numbers) + "\n";
  }

  std::optional<std::string> Convert(const Directive& definition, const MaterialHead& head,
                                     const std::string& type) {
    LaterParams params(definition.params,
                       head.name || definition.spec->id == DirectiveId::MakeNamedMaterial
                           ? "MakeNamedMaterial " + QuotedText(definition.strings[0])
                           : "Material " + QuotedText(type),
                       context_.report);
    return ImportMaterial(type, head, params, context_);
  }

  void DefineMaterial(const std::string& name, const Directive& definition) {
    const auto text = Convert(definition, {name}, NamedMaterialType(definition));
    if (text) Write(*text);
  }

  void UseMaterial(const std::optional<std::string>& text) {
    State().SetHidden(!text);
    if (text) Write(*text);
  }

  bool VisitMaterial(const Directive& directive) {
    switch (directive.spec->id) {
      case DirectiveId::Material:
        UseMaterial(
            Convert(State().WithAttributes(directive, "material"), {}, directive.strings[0]));
        return true;
      case DirectiveId::MakeNamedMaterial:
        if (IsOf4()) return true;  // written at the beginning, or where it is used
        State().NameMaterial(directive.strings[0], directive);
        if (context_.writesVersion2) DefineMaterial(directive.strings[0], directive);
        return true;
      case DirectiveId::NamedMaterial:
        UseNamedMaterial(directive);
        return true;
      default:
        return false;
    }
  }

  const Directive* FindMaterial(const std::string& name) const {
    if (!IsOf4()) return State().FindMaterial(name);
    for (const auto& [known, definition] : scan_.Materials())
      if (known == name) return &definition;
    return nullptr;
  }

  void UseNamedMaterial(const Directive& directive) {
    const std::string& name = directive.strings[0];
    const Directive* definition = FindMaterial(name);
    if (!definition) {
      std::vector<std::string> names = State().MaterialNames();
      for (const auto& material : scan_.Materials()) names.push_back(material.first);
      throw Error(ExitStatus::Scene, "there is no material of the name \"" + name + "\"",
                  directive.Where(), DidYouMean(name, names));
    }
    const auto text = Convert(*definition, {}, NamedMaterialType(*definition));
    UseMaterial(text && context_.writesVersion2 ? DirectiveText("NamedMaterial", {name}).Text()
                                                : text);
  }

  bool VisitContents(const Directive& directive) {
    switch (directive.spec->id) {
      case DirectiveId::Texture:
        if (!IsOf4()) Write(ImportTexture(directive, context_));
        return true;
      case DirectiveId::LightSource:
        if (const auto text = ImportLight(State().WithAttributes(directive, "light"), context_);
            !text.empty())
          Write(text);
        return true;
      case DirectiveId::AreaLightSource: {
        const auto text = ImportAreaLight(State().WithAttributes(directive, "light"), context_);
        State().SetEmits(!text.empty());
        if (!text.empty()) Write(text);
        return true;
      }
      case DirectiveId::Shape:
        VisitShape(directive);
        return true;
      default:
        return false;
    }
  }

  void VisitShape(const Directive& directive) {
    const std::string subject = "Shape " + QuotedText(directive.strings[0]);
    if (State().IsHidden() && !State().Emits()) {
      context_.report.Note(subject + " is invisible: it only bounds media", directive.Where());
      return;
    }
    if (State().IsHidden()) {
      context_.report.Replaced(subject + " shines and is black: it was invisible otherwise",
                               directive.Where());
      Write(DirectiveText("Material", {"matte"}).Numbers("color Kd", {0, 0, 0}).Text());
    }
    const std::string text =
        ImportShape(State().WithAttributes(directive, "shape"), State().Emits(), context_);
    if (!text.empty()) Write(text);
  }

  void VisitOther(const Directive& directive) {
    const std::string name(directive.spec->name);
    switch (directive.spec->id) {
      case DirectiveId::Attribute:
        return;  // its parameters are in the directives that follow
      case DirectiveId::Option:
        for (const ParsedParam& param : directive.params.All())
          context_.report.LeftOut("Option \"" + param.name + "\" is left out", param.where);
        return;
      case DirectiveId::ColorSpace:
        if (directive.strings[0] != "srgb")
          context_.report.Replaced("ColorSpace " + QuotedText(directive.strings[0]) +
                                       " is replaced by \"srgb\" with the same numbers",
                                   directive.Where());
        return;
      case DirectiveId::MakeNamedMedium:
      case DirectiveId::MediumInterface:
        if (directive.strings == std::vector<std::string>{"", ""}) return;
        context_.report.LeftOut(name + " " + QuotedText(directive.strings[0]) +
                                    " is left out: a Volume in a box can take its place",
                                directive.Where());
        return;
      case DirectiveId::AttributeBegin:
      case DirectiveId::TransformBegin:
      case DirectiveId::ObjectBegin:
        return Write(PlainText(directive), State().Depth() - 1);
      default:
        return Write(PlainText(directive));
    }
  }

  // Returns a directive that versions 1 and 2 have, too.
  std::string PlainText(const Directive& directive) const {
    std::string text(directive.spec->name);
    // LookAt mirrors the view in later versions, but not in version 1.
    if (directive.spec->id == DirectiveId::LookAt && !context_.writesVersion2)
      text = "Scale -1 1 1\n" + text;
    for (const std::string& word : directive.strings)
      text += " " + (directive.spec->hasWord ? word : QuotedText(word));
    for (const double number : directive.numbers) text += " " + ExactText(number);
    return text + "\n";
  }

  const LaterScan& scan_;
  ImportContext& context_;
  std::set<DirectiveId> options_;
  bool isInWorld_ = false;
  std::string text_;
};

std::string HeadText(const ImportTask& task, const ImportContext& context) {
  std::string text = "# Converted by exphoton import from " + task.sceneFile +
                     ", a scene of version " + std::to_string(context.version) + ".\n";
  const std::string list = context.report.Comments();
  text += list.empty() ? "# Everything has its equivalent.\n"
                       : "# These parts are expressed otherwise:\n" + list;
  if (context.writesVersion2) text += "Renderer \"sampler\"  # a scene of version 2\n";
  return text + "\n";
}

}  // namespace

ImportedScene ImportScene(SceneSource& source, const ImportTask& task, ImportReport& report,
                          Log& log) {
  ImportedScene scene;
  LaterScan scan(source, log, task.limits);
  scan.Read(task.sceneFile);
  scene.version = task.version.value_or(scan.Version());
  ImportContext context{.version = scene.version,
                        .writesVersion2 = scan.HasMix(),
                        .outputFile = task.outputFile,
                        .skyMaps = scene.skyMaps,
                        .report = report};
  SceneImporter importer(source, scan, context, log, task.limits);
  importer.Read(task.sceneFile);
  scene.text = HeadText(task, context) + importer.Text();
  return scene;
}

}  // namespace exphoton::cli
