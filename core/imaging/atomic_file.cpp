// SPDX-License-Identifier: BSD-2-Clause
// AtomicFile by POSIX: write beside the target, fsync, rename.
#include "core/imaging/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <new>

#include "core/base/error.h"

namespace exphoton {
namespace {

// A link is followed, so that the file it names is replaced and not the link.
std::string Resolve(const std::string& path) {
  char* const resolved = realpath(path.c_str(), nullptr);
  if (!resolved && errno == ENOMEM) throw std::bad_alloc();
  if (!resolved) return path;
  std::string result = resolved;
  std::free(resolved);
  return result;
}

// Names of unfinished files where a signal handler may read them: they belong to the process, like
// the signals. A file that finds no slot is merely not removed.
enum class SlotState { Free, Taken, Used };
struct Slot {
  std::atomic<SlotState> state{SlotState::Free};
  char path[4096];
};
Slot slots[8];
static_assert(std::atomic<SlotState>::is_always_lock_free);

int TakeSlot(const std::string& path) {
  if (path.size() >= sizeof(Slot::path)) return -1;
  for (int i = 0; i < int(std::size(slots)); ++i) {
    SlotState expected = SlotState::Free;
    if (!slots[i].state.compare_exchange_strong(expected, SlotState::Taken)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state = SlotState::Used;
    return i;
  }
  return -1;
}

void FreeSlot(int slot) {
  if (slot >= 0) slots[slot].state = SlotState::Free;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : target_(Resolve(path)) {
  struct stat status;
  if (stat(target_.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw Error(ExitStatus::File,
                "cannot write \"" + path + "\": " +
                    (S_ISDIR(status.st_mode) ? "it is a directory" : "it is not an ordinary file"));
  }
  partial_ = target_ + "." + std::to_string(getpid()) + ".partial";
  unlink(partial_.c_str());
  slot_ = TakeSlot(partial_);
  const int descriptor = open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    FreeSlot(slot_);
    Fail("cannot create");
  }
  stream_ = fdopen(descriptor, "wb");
  if (!stream_) {
    close(descriptor);
    RemovePartial();
    Fail("cannot create");
  }
}

AtomicFile::~AtomicFile() {
  if (!stream_) return;
  std::fclose(stream_);
  RemovePartial();
}

void AtomicFile::RemovePartial() {
  unlink(partial_.c_str());
  FreeSlot(slot_);
}

void AtomicFile::Fail(const std::string& what) {
  if (failure_ == 0) failure_ = errno;
  if (failure_ == ENOMEM) throw std::bad_alloc();
  throw Error(ExitStatus::File, what + " \"" + target_ + "\": " + std::strerror(failure_));
}

void AtomicFile::Write(const void* data, std::size_t size) {
  if (std::fwrite(data, 1, size, stream_) != size) Fail("cannot write");
}

std::uint64_t AtomicFile::Tell() {
  const off_t position = ftello(stream_);
  if (position < 0) Fail("cannot write");
  return std::uint64_t(position);
}

void AtomicFile::Seek(std::uint64_t position) {
  if (fseeko(stream_, off_t(position), SEEK_SET) != 0) Fail("cannot write");
}

void AtomicFile::Commit() {
  if (failure_ != 0 || std::fflush(stream_) != 0 || std::ferror(stream_)) Fail("cannot write");
  if (fsync(fileno(stream_)) != 0 && errno != EINVAL) Fail("cannot write");
  std::FILE* const stream = stream_;
  stream_ = nullptr;
  if (std::fclose(stream) != 0 || std::rename(partial_.c_str(), target_.c_str()) != 0) {
    const int reason = errno;
    RemovePartial();
    errno = reason;
    Fail("cannot write");
  }
  FreeSlot(slot_);
}

void RemovePartialFiles() {
  for (const Slot& slot : slots)
    if (slot.state == SlotState::Used) unlink(slot.path);
}

}  // namespace exphoton
