// SPDX-License-Identifier: BSD-2-Clause
// WriteExr: writes OpenEXR files by the library's C++ interface. AOVs are channels with a dot in
// the name, as is customary. exr_read.cpp reads OpenEXR files.
#include "core/imaging/files/exr.h"

#include <IexErrnoExc.h>
#include <IlmThreadPool.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "core/base/error.h"
#include "core/base/fp_traps.h"
#include "core/files/atomic_file.h"

namespace exphoton {
namespace {

constexpr float kMaxHalf = 65504;
constexpr int kLinesPerBlock = 16;  // of ZIP compression

Imath::Box2i ToBox(const PixelBounds& b) { return {{b.x0, b.y0}, {b.x1 - 1, b.y1 - 1}}; }

// The library writes through this stream, and errors leave it as exceptions. At the end, the
// library seeks back and writes the table of line block offsets. An entry has eight bytes; 0 marks
// a missing block. OpenEXR 3.1 treats lines that it could not compress for lack of memory as not
// yet written, and closes the file without them and without an error.
class FileStream final : public Imf::OStream {
 public:
  FileStream(AtomicFile* file, bool* isComplete, const std::string& path)
      : OStream(path.c_str()), file_(file), isComplete_(isComplete) {}
  void write(const char data[], int size) override {
    constexpr int kEntry = 8;
    static constexpr char kNone[kEntry] = {};
    for (int i = 0; isInTable_ && i + kEntry <= size; i += kEntry)
      *isComplete_ &= std::memcmp(data + i, kNone, kEntry) != 0;
    file_->Write(data, std::size_t(size));
  }
  std::uint64_t tellp() override { return file_->Tell(); }
  void seekp(std::uint64_t position) override {
    isInTable_ = true;
    file_->Seek(position);
  }

 private:
  AtomicFile* file_;
  bool* isComplete_;
  bool isInTable_ = false;
};

void InsertAttribute(const std::string& name, const ImageAttribute& value, Imf::Header* header) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    header->insert(name, Imf::StringAttribute(*text));
  } else if (const auto* number = std::get_if<float>(&value)) {
    header->insert(name, Imf::FloatAttribute(*number));
  } else if (const auto* integer = std::get_if<int>(&value)) {
    header->insert(name, Imf::IntAttribute(*integer));
  } else {
    const auto& list = std::get<std::vector<float>>(value);
    if (name == "chromaticities" && list.size() == 8) {
      const auto at = [&](std::size_t i) { return Imath::V2f(list[i], list[i + 1]); };
      header->insert(name,
                     Imf::ChromaticitiesAttribute(Imf::Chromaticities(at(0), at(2), at(4), at(6))));
    } else if (list.size() == 16) {
      Imath::M44f matrix;
      std::memcpy(matrix.getValue(), list.data(), 16 * sizeof(float));
      header->insert(name, Imf::M44fAttribute(matrix));
    } else {
      header->insert(name, Imf::FloatVectorAttribute(list));
    }
  }
}

Imf::Header MakeHeader(const Image& image, bool asHalf) {
  Imf::Header header(ToBox(image.display), ToBox(image.data));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : image.channels) {
    const bool isHalf = asHalf && !image.exactChannels.contains(channel);
    header.channels().insert(channel, Imf::Channel(isHalf ? Imf::HALF : Imf::FLOAT));
  }
  for (const auto& [name, value] : image.attributes) InsertAttribute(name, value, &header);
  return header;
}

// Lines of the picture, from y on. Channels of 16 bits are interleaved at `halves`, the others are
// those of the picture. If `halves` is null, all have 32 bits.
struct LineBlock {
  int y, count;
  half* halves;
};

Imf::FrameBuffer MakeFrameBuffer(const Image& image, const LineBlock& lines) {
  Imf::FrameBuffer buffer;
  const std::size_t channels = image.channels.size(), width = std::size_t(image.Width());
  // The library only reads through this pointer.
  auto* const floats = const_cast<float*>(image.pixels.data()) +
                       channels * width * std::size_t(lines.y - image.data.y0);
  for (std::size_t c = 0; c < channels; ++c) {
    const bool isHalf = lines.halves && !image.exactChannels.contains(image.channels[c]);
    const std::size_t pixelBytes = channels * (isHalf ? sizeof(half) : sizeof(float));
    char* const values =
        isHalf ? reinterpret_cast<char*>(lines.halves + c) : reinterpret_cast<char*>(floats + c);
    buffer.insert(image.channels[c],
                  Imf::Slice::Make(isHalf ? Imf::HALF : Imf::FLOAT, values,
                                   Imath::V2i(image.data.x0, lines.y), image.Width(), lines.count,
                                   pixelBytes, pixelBytes * width));
  }
  return buffer;
}

half ToHalf(float value, long long* clamped) {
  if (std::abs(value) > kMaxHalf) {  // false for NaN, which is kept
    ++*clamped;
    value = std::copysign(kMaxHalf, value);
  }
  return half(value);
}

// Converts one block of lines at a time, so that the half values need little memory.
long long WriteHalves(const Image& image, Imf::OutputFile* out) {
  const std::size_t channels = image.channels.size();
  const std::size_t lineValues = std::size_t(image.Width()) * channels;
  std::vector<half> block(lineValues * kLinesPerBlock);
  std::vector<bool> isExact;
  for (const std::string& channel : image.channels)
    isExact.push_back(image.exactChannels.contains(channel));
  long long clamped = 0;
  for (int y = 0; y < image.Height(); y += kLinesPerBlock) {
    const int lines = std::min(kLinesPerBlock, image.Height() - y);
    const float* from = image.pixels.data() + lineValues * std::size_t(y);
    for (std::size_t i = 0; i < lineValues * std::size_t(lines); ++i)
      if (!isExact[i % channels]) block[i] = ToHalf(from[i], &clamped);
    out->setFrameBuffer(MakeFrameBuffer(image, {image.data.y0 + y, lines, block.data()}));
    out->writePixels(lines);
  }
  return clamped;
}

}  // namespace

void CreateExrThreadPool() { IlmThread::ThreadPool::globalThreadPool(); }

ExrWriteReport WriteExr(const std::string& path, const Image& image, bool asHalf) {
  const UntrappedLibraryCall guard;
  ExrWriteReport report;
  try {
    CreateExrThreadPool();
    AtomicFile file(path);
    bool isComplete = true;
    {
      FileStream stream(&file, &isComplete, path);
      Imf::OutputFile out(stream, MakeHeader(image, asHalf), 0);
      if (asHalf) {
        report.clampedToHalf = WriteHalves(image, &out);
      } else {
        out.setFrameBuffer(MakeFrameBuffer(image, {image.data.y0, image.Height(), nullptr}));
        out.writePixels(image.Height());
      }
    }  // the destructor writes the table of line offsets
    if (!isComplete) throw std::bad_alloc();
    file.Commit();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Iex::EnomemExc&) {  // ENOMEM of the operating system while opening a file
    throw std::bad_alloc();
  } catch (const std::exception& error) {
    throw Error(ExitStatus::File, "cannot write \"" + path + "\": " + error.what());
  }
  return report;
}

}  // namespace exphoton
