// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/shards/part_writer.h"

#include <sys/stat.h>

#include "core/app/output/picture.h"
#include "core/app/shards/part_record.h"
#include "core/base/error.h"
#include "core/base/format.h"
#include "core/render/shards/shard_writer.h"
#include "core/render/state/checkpoints.h"

namespace exphoton::cli {
namespace {

bool PartFileExists(const std::string& path) {
  struct stat status;
  return lstat(path.c_str(), &status) == 0;
}

constexpr const char* kElsewhere = "remove it, or name another folder with -o";

// Throws DamagedState for a part that may be replaced, and Error for any other file.
StateFile OpenPart(const std::string& path) {
  try {
    return StateFile(path, StateUse::Part);
  } catch (const DamagedState&) {
    throw;
  } catch (const Error& error) {
    throw Error(error.Status(), error.what(), {}, kElsewhere);
  }
}

// Returns whether the file is this part. Throws Error if it is a file that must not be replaced.
bool HasPart(const PartJob& part) {
  if (!PartFileExists(part.path)) return false;
  try {
    const StateFile file = OpenPart(part.path);
    if (!file.Has(kShardSection))
      throw Error(ExitStatus::File, "\"" + part.path + "\" is not a part of a picture", {},
                  kElsewhere);
    ShardLayout layout;
    LoadSection(kShardSection, &layout, file);
    const std::string differences = part.identity.Differences(StateIdentity::Of(file));
    if (!differences.empty())
      throw Error(ExitStatus::CommandLine,
                  "\"" + part.path + "\" is a part of another picture: " + differences, {},
                  kElsewhere);
    return layout.shard.index == part.command.shard->index &&
           layout.shard.count == part.command.shard->count;
  } catch (const DamagedState& error) {
    // The part keeps the messages of part.log, and the new part has no damage.
    Log(Log::Level::Quiet).Warning(std::string(error.what()) + "; it is rendered again");
    return false;
  }
}

}  // namespace

bool WritePart(const PartJob& part, const std::function<void()>& mustFinish) {
  if (HasPart(part)) {
    part.log.Notice("\"" + part.path + "\" exists and is whole: nothing to render");
    return false;
  }
  const PicturePasses passes = PassesOf(part.command);
  StateWriter file(part.path);
  part.identity.Save(&file);
  ShardWriter writer(*part.command.shard, passes.count, &file);
  RenderOptions options = part.options;
  options.shard = &writer;
  const RenderResult result = RenderShard(part.job, options, passes);
  if (!result.isComplete) {
    part.log.Notice("interrupted; no part is written");
    return false;
  }
  mustFinish();
  PartRecord record(part.command, part.setup, part.log);
  SaveSection(kPartSection, record, &file);
  file.Commit();
  part.log.Notice("wrote \"" + part.path + "\"");
  return true;
}

}  // namespace exphoton::cli
