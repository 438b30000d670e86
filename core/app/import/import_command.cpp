// SPDX-License-Identifier: BSD-2-Clause
// RunImport writes the maps of skies first, so that the scene never names a map that is missing.
#include "core/app/import/import_command.h"

#include <cmath>
#include <filesystem>

#include "core/app/import/scene_import.h"
#include "core/app/import/sky_map.h"
#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/output_files.h"
#include "core/app/output/run_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/base/log.h"
#include "core/imaging/files/exr.h"

namespace exphoton::cli {
namespace {

struct ImportOptions {
  ImportTask task;
  std::string dialect = "auto", limits;
  bool isQuiet = false;
};

ImportOptions ParseImportOptions(const std::vector<std::string>& arguments) {
  ImportOptions options;
  OptionParser app(
      "Converts a scene of pbrt version 3 or 4. Everything without an equivalent is listed with "
      "its place, and in the head of the new scene. The exit status is then 6.",
      "exphoton import");
  app.Add("scene", options.task.sceneFile, "the scene of version 3 or 4").Required();
  app.Add("-o,--outfile", options.task.outputFile, "the converted scene: NAME.pbrt")
      .TypeName("NEW.pbrt")
      .Required();
  app.Add("--dialect", options.dialect, "version of the scene; auto: by its directives")
      .OneOf({"auto", "v3", "v4"})
      .DefaultText("auto");
  AddLimitsOption(app, &options.limits);
  app.AddFlag("--quiet", options.isQuiet, "warnings and errors only");
  app.Parse(arguments);
  if (options.dialect == "v3") options.task.version = 3;
  if (options.dialect == "v4") options.task.version = 4;
  if (!options.task.outputFile.ends_with(".pbrt"))
    FailUsage("\"" + options.task.outputFile + "\" does not end in .pbrt");
  return options;
}

std::string MapPath(const std::string& scene, const std::string& name) {
  return (std::filesystem::path(scene).parent_path() / name).string();
}

void WriteSkyMap(const std::string& source, const std::string& path) {
  const Image image = ReadImage(source);
  const bool isColor =
      image.FindChannel("R") >= 0 && image.FindChannel("G") >= 0 && image.FindChannel("B") >= 0;
  if (!isColor || image.Width() != image.Height())
    throw Error(ExitStatus::File,
                "the map \"" + source + "\" of an infinite light " +
                    (isColor ? "is not square, as version 4 needs" : "has no channels R, G and B"));
  WriteExr(path, LatitudeMapOf(image), false);
}

void CheckImportFiles(const ImportTask& task, const ImportedScene& scene, const SceneSource& source,
                      Log& log) {
  RunFiles files;
  std::set<std::string> inputs = source.FilesRead();
  for (const auto& [map, name] : scene.skyMaps) inputs.insert(map);
  files.AddScene(task.sceneFile, inputs);
  files.AddOutput("scene", {task.outputFile, "the converted scene", "-o FILE names another file"});
  for (const auto& [map, name] : scene.skyMaps)
    files.AddOutput(name, {MapPath(task.outputFile, name), "a map of the converted scene",
                           "-o FILE names another scene, and with it the map"});
  files.Check(log);
}

int Import(ImportOptions options) {
  const Limits limits = ParseLimits(options.limits);
  options.task.limits = limits.scene;
  LimitMemory(limits);
  Log log(options.isQuiet ? Log::Level::Quiet : Log::Level::Normal);
  const InterruptWatch watch(limits.seconds);
  FileSource source;
  ImportReport report(log);
  const ImportedScene scene = ImportScene(source, options.task, report, log);
  CheckImportFiles(options.task, scene, source, log);
  for (const auto& [map, name] : scene.skyMaps)
    WriteSkyMap(map, MapPath(options.task.outputFile, name));
  WriteTextFile(options.task.outputFile, scene.text);
  log.Summarize();
  const std::string written = "wrote \"" + options.task.outputFile + "\", converted from version " +
                              std::to_string(scene.version) + ": ";
  log.Notice(written + (report.IsExact() ? "everything has its equivalent" : report.Summary()));
  return report.IsExact() ? 0 : kImportIsInexact;
}

}  // namespace

int RunImport(const std::vector<std::string>& arguments) {
  int result = 0;
  const int status = Guarded([&] { result = Import(ParseImportOptions(arguments)); });
  return status ? status : result;
}

}  // namespace exphoton::cli
