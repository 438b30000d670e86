// SPDX-License-Identifier: BSD-2-Clause
// StateKeeper writes the state of a render to a file when the render is stopped and, on request, at
// intervals (--write-every). A failure to write is a warning: the render goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/app/identity/state_identity.h"
#include "core/base/log.h"
#include "core/render/state/checkpoints.h"

namespace exphoton::cli {

class StateKeeper : public Checkpoints {
 public:
  using Clock = std::chrono::steady_clock;
  // An attempt at a picture, which another one with other settings follows. Until the latter writes
  // a state, the state of the former stays, because it leads to the same settings.
  struct Attempt {
    double earlierSeconds = 0;  // as EarlierSeconds
    bool hasState = false;      // whether the state is of this render
    std::string ownPicture;     // the picture so far, if this render made the file
  };
  struct Settings {
    std::string path;                // of the state file
    bool resumes = false;            // whether the render is to continue from it
    std::optional<double> interval;  // seconds
    Clock::time_point start;         // of the render
    std::string picturePath;         // of the picture so far
    std::optional<Attempt> earlier;  // at the same picture, which now begins again
    std::function<void(const PictureSoFar&)> writePicture;  // for an interval
  };
  StateKeeper(const Settings& settings, const StateIdentity& identity, Log& log);
  ~StateKeeper() override;

  // Reads the file and checks that it belongs to this render. Throws Error. Returns null if there
  // is no file, or if the render is to begin. The result belongs to this object.
  StateFile* Resume();
  // Seconds that earlier parts of this render took.
  double EarlierSeconds() const { return earlierSeconds_; }

  bool IsDue() const override { return isDue_.load(std::memory_order_relaxed); }
  void Take(const Checkpoint& checkpoint, bool isLast) override;

  const std::string& Path() const { return settings_.path; }
  bool HasWritten() const { return hasWritten_; }
  // Returns whether the state is the one of an earlier attempt.
  bool IsOfEarlierAttempt() const { return isEarlier_; }
  Attempt ThisAttempt() const { return {earlierSeconds_, hasWritten_ || resumed_, ownPicture_}; }
  // The render is complete: removes the state that this object wrote or read, and the picture so
  // far, unless that file existed before the render.
  void Remove();

 private:
  void Watch();
  void Save(const Checkpoint& checkpoint);
  void KeepOlderState();
  void TransferRun(ByteArchive* archive);  // what follows from this run of the program

  Settings settings_;
  const StateIdentity& identity_;
  Log& log_;
  std::optional<StateFile> resumed_;
  double earlierSeconds_ = 0;
  std::string ownPicture_;  // the picture so far, if this render made the file
  bool hasWritten_ = false, hasWarned_ = false;
  bool isEarlier_ = false;  // whether the state is the one of an earlier attempt

  std::atomic<bool> isDue_{false};
  std::mutex mutex_;  // guards isOver_ and pause_
  std::condition_variable changed_;
  bool isOver_ = false;
  double pause_ = 0;  // seconds until the next checkpoint is due
  std::thread watch_;
};

}  // namespace exphoton::cli
