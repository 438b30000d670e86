// SPDX-License-Identifier: BSD-2-Clause
// WriteExr: writes OpenEXR files by the library's C++ interface. AOVs are channels with a dot in
// the name, as is customary. exr_read.cpp reads OpenEXR files.
#include "core/imaging/files/exr.h"

#include <IexErrnoExc.h>
#include <IlmThreadPool.h>
#include <ImfChannelList.h>
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
    if (list.size() == 16) {
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
  for (const std::string& channel : image.channels)
    header.channels().insert(channel, Imf::Channel(asHalf ? Imf::HALF : Imf::FLOAT));
  for (const auto& [name, value] : image.attributes) InsertAttribute(name, value, &header);
  return header;
}

// Returns a frame buffer for the lines from y on. Their interleaved values begin at `values`.
template <class T>
Imf::FrameBuffer MakeFrameBuffer(const Image& image, T* values, int y, int lines) {
  Imf::FrameBuffer buffer;
  const std::size_t pixelBytes = image.channels.size() * sizeof(T);
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    buffer.insert(image.channels[c],
                  Imf::Slice::Make(sizeof(T) == 2 ? Imf::HALF : Imf::FLOAT, values + c,
                                   Imath::V2i(image.data.x0, y), image.Width(), lines, pixelBytes,
                                   pixelBytes * std::size_t(image.Width())));
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
  const std::size_t lineValues = std::size_t(image.Width()) * image.channels.size();
  std::vector<half> block(lineValues * kLinesPerBlock);
  long long clamped = 0;
  for (int y = 0; y < image.Height(); y += kLinesPerBlock) {
    const int lines = std::min(kLinesPerBlock, image.Height() - y);
    const float* from = image.pixels.data() + lineValues * std::size_t(y);
    for (std::size_t i = 0; i < lineValues * std::size_t(lines); ++i)
      block[i] = ToHalf(from[i], &clamped);
    out->setFrameBuffer(MakeFrameBuffer(image, block.data(), image.data.y0 + y, lines));
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
        // The library only reads through this pointer.
        auto* const pixels = const_cast<float*>(image.pixels.data());
        out.setFrameBuffer(MakeFrameBuffer(image, pixels, image.data.y0, image.Height()));
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
