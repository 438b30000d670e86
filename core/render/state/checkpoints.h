// SPDX-License-Identifier: BSD-2-Clause
// Checkpoints is the interface through which a render hands over its state, so that another process
// can continue it. A render pauses between pixels when a checkpoint is due, and gives its last one
// when it is stopped.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/files/state_file.h"
#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"

namespace exphoton {

// Copies of the films of a picture that is not finished.
struct PictureSoFar {
  Film film;
  std::unique_ptr<AovFilm> aovs;  // null: no AOVs
  std::vector<Film> halves;       // with --two-halves: those that have begun
};

struct Checkpoint {
  bool hasWork = false;  // false: nothing is done yet that a later render could use
  std::function<void(StateWriter*)> save;
  std::function<PictureSoFar()> picture;  // valid only during Take
};

class Checkpoints {
 public:
  virtual ~Checkpoints() = default;
  // Whether the render is to pause and call Take. Callable from any thread, for each pixel.
  virtual bool IsDue() const = 0;
  // No thread renders meanwhile. `isLast`: the render was stopped and returns afterwards.
  virtual void Take(const Checkpoint& checkpoint, bool isLast) = 0;
};

// Adds the state of a render that consists of several passes to the state of its current pass.
class OuterCheckpoints : public Checkpoints {
 public:
  // `inner` is the checkpoint of the current pass. The function returns the one of the whole.
  using Wrap = std::function<Checkpoint(const Checkpoint& inner)>;
  OuterCheckpoints(Checkpoints* all, Wrap wrap) : all_(all), wrap_(std::move(wrap)) {}

  bool IsDue() const override { return all_->IsDue(); }
  void Take(const Checkpoint& inner, bool isLast) override { all_->Take(wrap_(inner), isLast); }

 private:
  Checkpoints* all_;
  Wrap wrap_;
};

// Saves an object that has a function Transfer(ByteArchive*).
template <class Object>
void SaveSection(const char* name, Object& object, StateWriter* writer) {
  writer->AddArchive(name, [&](ByteArchive* archive) { object.Transfer(archive); });
}
template <class Object>
void LoadSection(const char* name, Object* object, const StateFile& file) {
  file.Read(name, [&](ByteArchive* archive) { object->Transfer(archive); });
}

}  // namespace exphoton
