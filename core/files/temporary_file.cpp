// SPDX-License-Identifier: BSD-2-Clause
// TemporaryFile registers its file in a static table, because signals belong to the process. A
// handler can run in any thread at any moment. An entry is therefore published before its file
// exists, and signals are blocked in the thread that makes the file until the entry is complete.
#include "core/files/temporary_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <system_error>

namespace exphoton {
namespace {

constexpr std::size_t kMaxFileNameLength = 255;  // bytes, on every common file system

enum class SlotState { Free, Taken, Opening, File, Folder };

struct Slot {
  std::atomic<SlotState> state{SlotState::Free};
  int folder = -1;
  pid_t owner = 0;  // a forked child must not remove the parent's files
  dev_t device = 0;
  ino_t inode = 0;
  char name[kMaxFileNameLength + 1] = {};
};
Slot slots[64];
std::atomic<bool> isEnding{false};
static_assert(std::atomic<SlotState>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free);

int TakeSlot() {
  for (int i = 0; i < int(std::size(slots)); ++i) {
    SlotState expected = SlotState::Free;
    if (slots[i].state.compare_exchange_strong(expected, SlotState::Taken)) return i;
  }
  return -1;  // table full: a signal will not remove this file
}

void FreeSlot(int* slot) {
  if (*slot >= 0) slots[*slot].state = SlotState::Free;
  *slot = -1;
}

[[noreturn]] void WaitForTheEnd() {
  for (;;) pause();
}

void SleepMilliseconds(long milliseconds) {
  const timespec time{0, milliseconds * 1000000};
  syscall(SYS_nanosleep, &time, nullptr);  // glibc's nanosleep is a cancellation point
}

bool IsOurs(const Slot& slot) {
  struct stat status;
  return fstatat(slot.folder, slot.name, &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         status.st_dev == slot.device && status.st_ino == slot.inode;
}

// The kernel's layout of a directory entry.
struct FolderEntry {
  std::uint64_t inode;
  std::int64_t next;
  unsigned short size;
  unsigned char type;
  char name[];
};

// Removes the files of a folder. It avoids readdir, which allocates memory and must not run in a
// handler.
void EmptyFolder(int folder) {
  alignas(FolderEntry) char buffer[4096];
  lseek(folder, 0, SEEK_SET);
  for (;;) {
    const long bytes = syscall(SYS_getdents64, folder, buffer, sizeof buffer);
    if (bytes <= 0) return;
    for (long at = 0; at < bytes;) {
      const auto* const entry = reinterpret_cast<const FolderEntry*>(buffer + at);
      unlinkat(folder, entry->name, 0);  // fails for folders
      at += entry->size;
    }
  }
}

std::string PartialName(const std::string& name) {
  const std::string end = "." + RandomName() + ".partial";
  std::size_t length = std::min(name.size(), kMaxFileNameLength - end.size());
  while (length > 0 && length < name.size() && (name[length] & 0xC0) == 0x80) --length;  // UTF-8
  return name.substr(0, length) + end;
}

}  // namespace

SignalBlock::SignalBlock() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before_);
}

SignalBlock::~SignalBlock() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

std::string RandomName() {
  std::uint64_t bits = 0;
  if (getrandom(&bits, sizeof bits, 0) != ssize_t(sizeof bits)) {
    std::random_device device;
    bits = std::uint64_t(device()) << 32 | device();
  }
  std::string name;
  for (int i = 0; i < 13; ++i, bits >>= 5) name += "abcdefghijklmnopqrstuvwxyz234567"[bits & 31];
  return name;
}

TemporaryFile::TemporaryFile(int folder, const std::string& name, mode_t mode)
    : folder_(folder), slot_(TakeSlot()) {
  constexpr int kTries = 100;
  name_.reserve(kMaxFileNameLength);
  for (int i = 0; i < kTries && descriptor_ < 0; ++i) {
    name_ = PartialName(name);
    const SignalBlock block;
    Slot* const slot = slot_ >= 0 ? &slots[slot_] : nullptr;
    if (slot) {
      slot->folder = folder_;
      slot->owner = getpid();
      std::memcpy(slot->name, name_.c_str(), name_.size() + 1);
      slot->state = SlotState::Opening;
    }
    if (isEnding) {
      if (slot) slot->state = SlotState::Taken;
      WaitForTheEnd();
    }
    descriptor_ =
        openat(folder_, name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    const int reason = errno;
    struct stat status {};
    if (descriptor_ >= 0 && fstat(descriptor_, &status) == 0 && slot) {
      slot->device = status.st_dev;
      slot->inode = status.st_ino;
      slot->state = SlotState::File;
    } else if (slot) {
      slot->state = SlotState::Taken;
    }
    errno = reason;
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ >= 0) return;
  const int reason = errno;
  FreeSlot(&slot_);
  throw std::system_error(reason, std::generic_category());
}

TemporaryFile::~TemporaryFile() { Remove(); }

bool TemporaryFile::Rename(const std::string& name) {
  if (renameat(folder_, name_.c_str(), folder_, name.c_str()) != 0) return false;
  name_.clear();
  FreeSlot(&slot_);
  return true;
}

void TemporaryFile::Remove() {
  if (!name_.empty()) unlinkat(folder_, name_.c_str(), 0);
  name_.clear();
  FreeSlot(&slot_);
}

ScratchFolderGuard::ScratchFolderGuard(int folder) : slot_(TakeSlot()) {
  if (slot_ < 0) return;
  slots[slot_].folder = folder;
  slots[slot_].owner = getpid();
  slots[slot_].state = SlotState::Folder;
}

ScratchFolderGuard::~ScratchFolderGuard() { FreeSlot(&slot_); }

void RemoveTemporaryFiles() {
  constexpr int kPatience = 100;  // waits for another thread to complete its entry
  isEnding = true;
  for (Slot& slot : slots) {
    for (int i = 0; i < kPatience && slot.state == SlotState::Opening; ++i) SleepMilliseconds(10);
    const SlotState state = slot.state;
    if (state == SlotState::Free || state == SlotState::Taken || slot.owner != getpid()) continue;
    if (state == SlotState::Folder)
      EmptyFolder(slot.folder);
    else if (state == SlotState::File && IsOurs(slot))
      unlinkat(slot.folder, slot.name, 0);
  }
}

}  // namespace exphoton
