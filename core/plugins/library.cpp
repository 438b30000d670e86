// SPDX-License-Identifier: BSD-2-Clause
// Loads plugins by dlopen, with a message for every possible failure. The file is checked first.
// dlopen would run the constructors of any library, and a truncated library would end the process.
#include "core/plugins/library.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>

#include "core/base/fp_traps.h"
#include "core/files/file_identity.h"
#include "core/files/open_file.h"
#include "core/plugins/elf_file.h"
#include "core/plugins/load_guard.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

std::vector<PluginEntry>& MutableStaticPlugins() {
  static std::vector<PluginEntry> entries;
  return entries;
}

void CheckIsReadable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw PluginFileError("does not exist");
  if (fs::is_directory(status)) throw PluginFileError("is a directory, not a plugin");
  if (!fs::is_regular_file(status)) throw PluginFileError("is not a regular file");
  if (access(path.c_str(), R_OK) != 0) {
    throw PluginFileError(std::string("cannot be read: ") + std::strerror(errno));
  }
}

int OpenFile(const std::string& path, int flags) {
  const int file = open(path.c_str(), flags | O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (file >= 0) return file;
  if (errno == ENOMEM) throw std::bad_alloc();
  throw PluginFileError(std::string("cannot be read: ") + std::strerror(errno));
}

void CheckWriters(int file, const char* what) {
  struct stat status;
  if (fstat(file, &status) != 0)
    throw PluginFileError(std::string("cannot be read: ") + std::strerror(errno));
  const bool isSticky = S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX);
  if (status.st_uid != geteuid() && status.st_uid != 0)
    throw PluginFileError(std::string(what) + "belongs to another user, and a scene names it");
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) && !isSticky)
    throw PluginFileError(std::string(what) +
                          "can be changed by other users (chmod go-w), and a scene names it");
}

// Returns the name to pass to dlopen. The name of an open descriptor always means the file that was
// checked, even if the folder changes meanwhile.
std::string NameForLoader(const PluginFile& file, int descriptor) {
  // dlopen would search the system's library folders for a path without a slash.
  if (file.trust == PluginTrust::Chosen) return fs::absolute(file.path).string();
  const Descriptor folder(OpenFile(FolderOf(file.path), O_DIRECTORY));
  CheckWriters(folder.Get(), "lies in a folder that ");
  CheckWriters(descriptor, "");
  return "/proc/self/fd/" + std::to_string(descriptor);
}

// dlopen identifies loaded libraries by name. The number of a descriptor under which a library was
// loaded must therefore not be reused, so the descriptor stays open.
void* OpenLibrary(const PluginFile& file) {
  Descriptor descriptor(OpenFile(file.path, 0));
  if (const auto fault = FaultOfLibrary(descriptor.Get(), kPluginSymbol)) {
    if (fault->isForeign) throw ForeignLibraryError(fault->text);
    throw PluginFileError(fault->text);
  }
  const std::string name = NameForLoader(file, descriptor.Get());
  errno = 0;
  void* const library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library && file.trust != PluginTrust::Chosen) descriptor.Release();
  if (library) return library;
  if (errno == ENOMEM) throw std::bad_alloc();  // dlerror rarely mentions it
  const char* reason = dlerror();
  throw PluginFileError(std::string("cannot be loaded: ") + (reason ? reason : "no reason given"));
}

}  // namespace

bool RegisterStaticPlugin(PluginEntry entry) {
  MutableStaticPlugins().push_back(entry);
  return true;
}

const std::vector<PluginEntry>& StaticPlugins() { return MutableStaticPlugins(); }

const char* CoreBuildTag() { return EXPHOTON_BUILD_TAG; }

const PluginDescriptor& CheckedDescriptor(PluginEntry entry, const std::string& name) {
  const PluginDescriptor* descriptor = nullptr;
  try {
    descriptor = entry();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw PluginFileError(
        std::string("throws an exception when the program asks for its description: ") +
        error.what());
  } catch (...) {
    throw PluginFileError("throws an exception when the program asks for its description");
  }
  if (!descriptor) throw PluginFileError("returns no description of itself");
  // The ABI number is the first member. No other member may be read before it is checked.
  if (descriptor->abi != kPluginAbi) {
    throw PluginFileError("is built for plugin interface " + std::to_string(descriptor->abi) +
                          ", and this program has " + std::to_string(kPluginAbi) +
                          ": build it again");
  }
  if (!descriptor->buildTag || std::strcmp(descriptor->buildTag, CoreBuildTag()) != 0) {
    throw PluginFileError("is built by \"" +
                          std::string(descriptor->buildTag ? descriptor->buildTag : "") +
                          "\", and this program by \"" + CoreBuildTag() + "\": build it again");
  }
  if (!descriptor->name || descriptor->name != name) {
    throw PluginFileError("names itself \"" +
                          std::string(descriptor->name ? descriptor->name : "") +
                          "\": the file must have the name of the plugin");
  }
  return *descriptor;
}

const PluginDescriptor& LoadPluginFile(const PluginFile& file, const std::string& name) {
  CheckIsReadable(file.path);
  const UntrappedLibraryCall guard;
  const LoadGuard loadGuard(file.path);
  void* const library = OpenLibrary(file);
  void* symbol = dlsym(library, kPluginSymbol);
  if (!symbol) {
    throw PluginFileError(std::string("is a library, but not a plugin: it has no symbol ") +
                          kPluginSymbol);
  }
  return CheckedDescriptor(reinterpret_cast<PluginEntry>(symbol), name);
}

std::string CoreFile() {
  Dl_info info{};
  const int found = dladdr(reinterpret_cast<void*>(&CoreFile), &info);
  return found && info.dli_fname ? info.dli_fname : "";
}

}  // namespace exphoton
