// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/process/temporary_folder.h"

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"

namespace exphoton::cli {

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
  std::string name =
      (std::filesystem::temp_directory_path() / ("exphoton-" + purpose + "-XXXXXX")).string();
  if (!mkdtemp(name.data())) throw Error(ExitStatus::File, "cannot make \"" + name + '"');
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  if (isKept_) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace exphoton::cli
