// SPDX-License-Identifier: BSD-2-Clause
// StateKeeper: a thread says when a checkpoint is due, and the render's own thread writes it.
#include "core/app/output/state_keeper.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <system_error>

#include "core/base/error.h"

namespace exphoton::cli {
namespace {

constexpr double kLargestShare = .1;  // of the time for writing

bool FileExists(const std::string& path) {
  struct stat status;
  return lstat(path.c_str(), &status) == 0;
}

// Returns the name under which an older state is kept: "out.exr.state.old", "out.exr.state.old-2"
// for the second one, and so on.
std::string OlderName(const std::string& path, int number) {
  return path + ".old" + (number > 1 ? "-" + std::to_string(number) : "");
}

// Returns the options that continue from the state, and from the oldest one that was kept.
std::string ResumeHint(const std::string& path) {
  const std::string older = OlderName(path, 1);
  return "--resume continues it" +
         (IsStateFile(older) ? "; --resume --state \"" + older + "\" continues an older one" : "");
}

}  // namespace

StateKeeper::StateKeeper(const Settings& settings, const StateIdentity& identity, Log& log)
    : settings_(settings), identity_(identity), log_(log), pause_(settings.interval.value_or(0)) {
  if (!FileExists(settings.picturePath)) ownPicture_ = settings.picturePath;
  if (settings.earlier) {
    earlierSeconds_ = settings.earlier->earlierSeconds;
    hasWritten_ = isEarlier_ = settings.earlier->hasState;
    ownPicture_ = settings.earlier->ownPicture;
  }
  if (!settings.interval) return;
  try {
    watch_ = std::thread([this] { Watch(); });
  } catch (const std::system_error&) {
    log_.Warning("--write-every has no effect: no thread could be started");
  }
}

StateKeeper::~StateKeeper() {
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
  }
  changed_.notify_all();
  if (watch_.joinable()) watch_.join();
}

void StateKeeper::Watch() {
  std::unique_lock lock(mutex_);
  while (!isOver_) {
    const Clock::time_point next =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(std::min(pause_, 1e8)));
    if (changed_.wait_until(lock, next, [this] { return isOver_; })) return;
    isDue_ = true;
    changed_.wait(lock, [this] { return isOver_ || !isDue_; });
  }
}

StateFile* StateKeeper::Resume() {
  if (settings_.earlier) return nullptr;
  if (!settings_.resumes) {
    if (IsStateFile(settings_.path))
      log_.Warning("\"" + settings_.path +
                       "\" is the state of a stopped render, which this command does not continue",
                   {}, ResumeHint(settings_.path));
    return nullptr;
  }
  if (!FileExists(settings_.path)) {
    log_.Notice("there is no state \"" + settings_.path + "\": rendering from the start");
    return nullptr;
  }
  resumed_.emplace(settings_.path);
  identity_.Check(*resumed_);
  resumed_->Read("run", [this](ByteArchive* archive) { TransferRun(archive); });
  return &*resumed_;
}

void StateKeeper::TransferRun(ByteArchive* archive) {
  const std::chrono::duration<double> now = Clock::now() - settings_.start;
  double seconds = earlierSeconds_ + now.count();
  archive->Values(&seconds);
  archive->Text(&ownPicture_);
  if (!archive->IsLoading()) return;
  if (!(seconds >= 0)) throw ArchiveError("its time is negative");
  earlierSeconds_ = seconds;
  if (ownPicture_ != settings_.picturePath) ownPicture_.clear();
}

void StateKeeper::Save(const Checkpoint& checkpoint) {
  if (FileExists(settings_.path) && !IsStateFile(settings_.path))
    throw Error(ExitStatus::File, "\"" + settings_.path + "\" exists and is not a state");
  if (!hasWritten_ && !resumed_) KeepOlderState();
  StateWriter writer(settings_.path);
  identity_.Save(&writer);
  writer.AddArchive("run", [this](ByteArchive* archive) { TransferRun(archive); });
  checkpoint.save(&writer);
  writer.Commit();
  hasWritten_ = true;
  isEarlier_ = false;
}

// The state of a render that is not continued may be hours of work, and so may the ones before it.
void StateKeeper::KeepOlderState() {
  if (!FileExists(settings_.path)) return;
  int number = 1;
  while (FileExists(OlderName(settings_.path, number))) ++number;
  const std::string name = OlderName(settings_.path, number);
  if (std::rename(settings_.path.c_str(), name.c_str()) != 0)
    throw Error(ExitStatus::File, "cannot rename \"" + settings_.path + "\"");
  log_.Notice("the older state is kept as \"" + name + "\"");
}

void StateKeeper::Take(const Checkpoint& checkpoint, bool isLast) {
  const Clock::time_point start = Clock::now();
  try {
    if (checkpoint.hasWork) {
      Save(checkpoint);
      if (!isLast && checkpoint.picture) settings_.writePicture(checkpoint.picture());
    }
  } catch (const std::bad_alloc&) {
    if (!hasWarned_) log_.Warning("too little memory to write the state of this render");
    hasWarned_ = true;
  } catch (const Error& error) {
    if (!hasWarned_)
      log_.Warning(std::string("the state of this render is not written: ") + error.what());
    hasWarned_ = true;
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  {
    const std::lock_guard lock(mutex_);
    pause_ = std::max(settings_.interval.value_or(0), seconds * (1 / kLargestShare - 1));
    isDue_ = false;
  }
  changed_.notify_all();
}

void StateKeeper::Remove() {
  const bool isOurs = hasWritten_ || resumed_;
  if (isOurs && IsStateFile(settings_.path)) unlink(settings_.path.c_str());
  if (!ownPicture_.empty()) unlink(ownPicture_.c_str());
}

}  // namespace exphoton::cli
