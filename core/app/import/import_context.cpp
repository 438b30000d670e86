// SPDX-License-Identifier: BSD-2-Clause
// FileNameFor searches a file as the renderer does, and then relates it to the new scene.
#include "core/app/import/import_context.h"

#include <filesystem>

#include "core/params/scene_path.h"

namespace exphoton::cli {

namespace fs = std::filesystem;

std::string FileNameFor(const std::string& name, const SourceLocation& where,
                        const ImportContext& context) {
  const fs::path path = ResolveScenePath(name, where);
  std::error_code error;
  if (!fs::exists(path, error))
    context.report.LeftOut("the file \"" + name + "\" does not exist", where);
  if (fs::path(name).is_absolute()) return name;
  const fs::path from = fs::absolute(path, error).lexically_normal();
  const fs::path folder = fs::absolute(context.outputFile, error).lexically_normal().parent_path();
  return from.lexically_proximate(folder).string();
}

}  // namespace exphoton::cli
