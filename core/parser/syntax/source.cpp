// SPDX-License-Identifier: BSD-2-Clause
// FileSource and MemorySource read whole scene files into memory, with limits on their size.
#include "core/parser/syntax/source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>

#include "core/files/input_file.h"
#include "core/files/open_file.h"

namespace exphoton {
namespace {

constexpr std::size_t kMaxTextBytes = std::size_t(8) << 30;    // of one file, decompressed
constexpr std::size_t kMaxStreamBytes = std::size_t(1) << 28;  // of a pipe or device
constexpr std::size_t kMaxInflation = 1100;                    // expansion; deflate: at most 1032

// The scene on the command line can be a pipe; an included file cannot.
int OpenSource(const std::string& path, bool isIncluded) {
  try {
    if (isIncluded) return OpenRegularFile(path);
  } catch (const InputFileError& error) {
    throw SourceError(error.what());
  }
  const int file = open(path.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC);
  if (file < 0) throw SourceError(errno == ENOENT ? "no such file" : std::strerror(errno));
  return file;
}

std::string ReadDescriptor(int file, std::size_t expected, std::size_t limit) {
  std::string text(expected + 1, '\0');  // spare byte: read() reports the end without a resize
  std::size_t size = 0;
  for (;;) {
    if (size == text.size()) text.resize(text.size() + text.size() / 2 + (1 << 16));
    const ssize_t count = read(file, text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw SourceError(std::strerror(errno));
    if (count == 0) break;
    size += std::size_t(count);
    if (size > limit)
      throw SourceError("is longer than the limit of " + std::to_string(limit >> 20) + " MiB");
  }
  text.resize(size);
  return text;
}

}  // namespace

std::string FileSource::Read(const std::string& path, bool isIncluded) {
  const bool isStandardInput = path == "-" && !isIncluded;
  if (streams_->contains(path)) return streams_->at(path);
  const Descriptor opened(isStandardInput ? -1 : OpenSource(path, isIncluded));
  const int file = isStandardInput ? STDIN_FILENO : opened.Get();
  struct stat status;
  if (fstat(file, &status) != 0)
    throw SourceError(isStandardInput ? "standard input is closed" : std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw SourceError("is a directory");
  const bool isRegular = S_ISREG(status.st_mode);
  const std::size_t limit = isRegular ? kMaxTextBytes : kMaxStreamBytes;
  const auto expected = isRegular ? std::size_t(status.st_size) : std::size_t(0);
  if (expected > limit)
    throw SourceError("is longer than the limit of " + std::to_string(limit >> 20) + " MiB");
  if (!isStandardInput) filesRead_.insert(path);
  std::string text = ReadDescriptor(file, expected, limit);
  if (IsGzip(text)) text = Gunzip(text);
  if (!isRegular || isStandardInput) streams_->emplace(path, text);
  return text;
}

bool FileSource::Has(const std::string& path) const {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

std::string FileSource::Identity(const std::string& path) const {
  std::error_code error;
  const auto canonical = std::filesystem::canonical(path, error);
  return error ? path : canonical.string();
}

std::string MemorySource::Read(const std::string& path, bool) {
  const auto found = files_.find(path);
  if (found == files_.end()) throw SourceError("no such file");
  return IsGzip(found->second) ? Gunzip(found->second) : found->second;
}

bool IsGzip(std::string_view bytes) {
  return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
}

std::string Gunzip(std::string_view bytes) {
  z_stream stream{};
  constexpr int kGzipOnly = 15 + 16;
  if (inflateInit2(&stream, kGzipOnly) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
  std::string text;
  const std::size_t limit = std::min(kMaxTextBytes, bytes.size() * kMaxInflation + (1 << 16));
  std::size_t consumed = 0, size = 0;
  int result = Z_OK;
  while (consumed < bytes.size() || result == Z_OK) {
    if (result == Z_STREAM_END) {                  // another gzip member follows
      if (!IsGzip(bytes.substr(consumed))) break;  // padding after the last member
      inflateReset(&stream);
    }
    if (size == text.size()) text.resize(std::max<std::size_t>(text.size() * 2, 1 << 16));
    constexpr std::size_t kMaxChunk = 1 << 30;
    const std::size_t input = std::min(bytes.size() - consumed, kMaxChunk);
    const std::size_t output = std::min(text.size() - size, kMaxChunk);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + consumed));
    stream.avail_in = uInt(input);
    stream.next_out = reinterpret_cast<Bytef*>(text.data() + size);
    stream.avail_out = uInt(output);
    result = inflate(&stream, Z_NO_FLUSH);
    consumed += input - stream.avail_in;
    size += output - stream.avail_out;
    if (result == Z_BUF_ERROR && consumed == bytes.size())
      throw SourceError("ends in the middle of its gzip data");
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
      throw SourceError("is damaged: its gzip data cannot be decompressed");
    if (size > limit)
      throw SourceError("is longer than the limit of " + std::to_string(limit >> 20) + " MiB");
  }
  text.resize(size);
  return text;
}

}  // namespace exphoton
