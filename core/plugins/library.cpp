// SPDX-License-Identifier: BSD-2-Clause
// dlopen, with every way in which it can fail told apart. The sizes in a library's header are
// checked first, because dlopen maps a truncated file and the process then dies by a signal.
#include "core/plugins/library.h"

#include <dlfcn.h>
#include <elf.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

#include "core/base/fp_traps.h"

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

// Whether every part that a loader would map lies within the file. Other word sizes and byte orders
// are left to dlopen, which refuses them by their header.
void CheckIsWhole(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  // A lack of memory must not be taken for a short file.
  if (!file && errno == ENOMEM) throw std::bad_alloc();
  file.exceptions(std::ios::badbit);
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  Elf64_Ehdr header{};
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  if (file.gcount() < SELFMAG || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    throw PluginFileError("is not a library");
  }
  if (file.gcount() < std::streamsize(sizeof header)) throw PluginFileError("is truncated");
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_phentsize != sizeof(Elf64_Phdr)) return;
  for (int i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr part{};
    file.seekg(std::streamoff(header.e_phoff + std::uint64_t(i) * sizeof part));
    file.read(reinterpret_cast<char*>(&part), sizeof part);
    if (!file) throw PluginFileError("is truncated");
    if (part.p_filesz > size || part.p_offset > size - part.p_filesz) {
      throw PluginFileError("is truncated");
    }
  }
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
    throw PluginFileError(std::string("fails when asked what it is: ") + error.what());
  } catch (...) {
    throw PluginFileError("fails when asked what it is");
  }
  if (!descriptor) throw PluginFileError("does not say what it is");
  // The ABI number comes first, and nothing else may be read before it is known to be right.
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
    throw PluginFileError("says that its name is \"" +
                          std::string(descriptor->name ? descriptor->name : "") +
                          "\": a plugin's file must be named as it is");
  }
  return *descriptor;
}

const PluginDescriptor& LoadPluginFile(const std::string& path, const std::string& name) {
  CheckIsReadable(path);
  CheckIsWhole(path);
  // A path without a slash would be looked for where the system keeps its libraries.
  const std::string file = fs::absolute(path).string();
  const UntrappedLibraryCall guard;
  errno = 0;
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    if (errno == ENOMEM) throw std::bad_alloc();  // its words seldom say so
    const char* reason = dlerror();
    throw PluginFileError(std::string("cannot be loaded: ") +
                          (reason ? reason : "no reason given"));
  }
  void* symbol = dlsym(library, kPluginSymbol);
  if (!symbol) {
    throw PluginFileError(std::string("is a library, but no plugin: it has no symbol ") +
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
