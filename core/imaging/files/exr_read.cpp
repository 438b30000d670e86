// SPDX-License-Identifier: BSD-2-Clause
// ReadExr: reads scanline and tiled OpenEXR files with any number of channels of any type, as
// float. It reads the first part of a multi-part file. It refuses deep and subsampled data. Sizes
// are checked on the header alone, before any allocation in proportion to the picture.
#include <IexErrnoExc.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "core/base/error.h"
#include "core/base/fp_traps.h"
#include "core/base/memory.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/files/exr_sizes.h"
#include "core/imaging/film/aovs.h"

namespace exphoton {
namespace {

struct Window {
  PixelBounds bounds;
  std::int64_t pixels;
};

Window CheckWindow(const Imath::Box2i& box) {
  constexpr std::int64_t kFarthest = 1 << 30;
  const auto inRange = [](int v) { return v > -kFarthest && v < kFarthest; };
  const std::int64_t width = std::int64_t(box.max.x) - box.min.x + 1;
  const std::int64_t height = std::int64_t(box.max.y) - box.min.y + 1;
  if (width <= 0 || height <= 0) throw ImageError("an empty window");
  if (!inRange(box.min.x) || !inRange(box.min.y) || !inRange(box.max.x) || !inRange(box.max.y))
    throw ImageError("a window too far from the origin");
  return {{box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}, width * height};
}

// Returns R, G, B, A first, in this order. The other channels follow in the order of the file,
// which is sorted.
std::vector<std::string> ChannelNames(const Imf::ChannelList& list) {
  std::vector<std::string> names;
  for (const char* name : {"R", "G", "B", "A"})
    if (list.findChannel(name)) names.push_back(name);
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw ImageError(std::string("channel \"") + channel.name() + "\" is subsampled");
    if (std::find(names.begin(), names.end(), channel.name()) == names.end())
      names.push_back(channel.name());
    if (names.size() > kMaxImageChannels)
      throw ImageError("more than " + std::to_string(kMaxImageChannels) + " channels");
  }
  if (names.empty()) throw ImageError("no channels");
  return names;
}

Image DescribeImage(const Imf::Header& header) {
  if (header.hasType() && Imf::isDeepData(header.type())) throw ImageError("deep data");
  const Window data = CheckWindow(header.dataWindow());
  if (data.pixels > kMaxImagePixels) throw ImageError("more than 2^28 pixels");
  Image image;
  image.channels = ChannelNames(header.channels());
  image.data = data.bounds;
  image.display = CheckWindow(header.displayWindow()).bounds;
  return image;
}

// Reads the first header alone and rewinds the stream.
Image CheckHeader(Imf::IStream* stream) {
  char bytes[8];
  stream->read(bytes, 8);
  int version = 0;
  for (int i = 3; i >= 0; --i) version = version << 8 | static_cast<unsigned char>(bytes[4 + i]);
  if (Imf::isNonImage(version)) throw ImageError("deep data");
  Imf::Header header;
  header.readFrom(*stream, version);
  Image image = DescribeImage(header);
  stream->seekg(0);
  return image;
}

std::map<std::string, ImageAttribute> ReadAttributes(const Imf::Header& header) {
  std::map<std::string, ImageAttribute> attributes;
  for (auto entry = header.begin(); entry != header.end(); ++entry) {
    const std::string name = entry.name();
    if (name == "pixelAspectRatio" || name == "screenWindowWidth") continue;  // in every file
    const Imf::Attribute& value = entry.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&value)) {
      attributes[name] = text->value();
    } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&value)) {
      attributes[name] = number->value();
    } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&value)) {
      attributes[name] = integer->value();
    } else if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&value)) {
      const float* m = matrix->value().getValue();
      attributes[name] = std::vector<float>(m, m + 16);
    } else if (const auto* primaries = dynamic_cast<const Imf::ChromaticitiesAttribute*>(&value)) {
      const Imf::Chromaticities& c = primaries->value();
      attributes[name] = std::vector<float>{c.red.x,  c.red.y,  c.green.x, c.green.y,
                                            c.blue.x, c.blue.y, c.white.x, c.white.y};
    }
  }
  return attributes;
}

// Returns the names of the Cryptomatte layers. By the specification, "View.CryptoAsset" has
// channels such as "View.CryptoAsset00.r", and the attribute "cryptomatte/KEY/name" states the
// name.
std::vector<std::string> CryptomatteLayers(
    const std::map<std::string, ImageAttribute>& attributes) {
  std::vector<std::string> layers;
  for (const auto& [name, value] : attributes) {
    const auto* layer = std::get_if<std::string>(&value);
    if (layer && !layer->empty() && name.starts_with("cryptomatte/") && name.ends_with("/name"))
      layers.push_back(*layer);
  }
  return layers;
}

// Returns the channels that exr.h describes at ReadExr. A file with channels of both sizes has been
// written by a program that chose the type of each. In a file of 32 bits, only names distinguish
// the layers that need them from colours.
std::set<std::string> ExactChannels(const Imf::ChannelList& list,
                                    const std::vector<std::string>& cryptomatte) {
  bool hasHalf = false;
  for (auto channel = list.begin(); channel != list.end(); ++channel)
    hasHalf |= channel.channel().type == Imf::HALF;
  std::set<std::string> exact;
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    const std::string name = channel.name();
    const auto isOfLayer = [&](const std::string& layer) { return name.starts_with(layer); };
    const Imf::PixelType type = channel.channel().type;
    if (type != Imf::HALF && (hasHalf || type == Imf::UINT || IsExactChannel(name) ||
                              std::any_of(cryptomatte.begin(), cryptomatte.end(), isOfLayer)))
      exact.insert(name);
  }
  return exact;
}

// Converts a luminance picture to R, G, B.
Image ExpandLuminance(const Image& image) {
  std::vector<std::string> names = {"R", "G", "B"};
  const int alpha = image.FindChannel("A");
  if (alpha >= 0) names.push_back("A");
  Image result(image.data, image.display, names);
  result.attributes = image.attributes;
  if (image.exactChannels.contains("Y")) result.exactChannels = {"R", "G", "B"};
  if (image.exactChannels.contains("A")) result.exactChannels.insert("A");
  const int y = image.FindChannel("Y");
  for (int row = 0; row < image.Height(); ++row) {
    for (int column = 0; column < image.Width(); ++column) {
      for (int c = 0; c < 3; ++c) result.At(column, row, c) = image.At(column, row, y);
      if (alpha >= 0) result.At(column, row, 3) = image.At(column, row, alpha);
    }
  }
  return result;
}

bool IsLuminance(const Image& image) {
  return image.FindChannel("Y") >= 0 &&
         image.ChannelCount() == (image.FindChannel("A") >= 0 ? 2 : 1);
}

Image Read(const std::string& path) {
  CheckImageFile(path);
  Imf::StdIFStream stream(path.c_str());
  CheckExrHeaders(path);
  Image image = CheckHeader(&stream);
  const double bytes =
      double(image.Width()) * image.Height() * image.ChannelCount() * sizeof(float);
  CheckExrPixels(path, bytes);
  if (bytes > PhysicalMemory()) throw std::bad_alloc();
  Imf::InputFile file(stream, 0);
  image.attributes = ReadAttributes(file.header());
  image.exactChannels =
      ExactChannels(file.header().channels(), CryptomatteLayers(image.attributes));
  image.pixels.resize(std::size_t(image.Width()) * std::size_t(image.Height()) *
                      image.channels.size());
  Imf::FrameBuffer buffer;
  const std::size_t pixelBytes = image.channels.size() * sizeof(float);
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    buffer.insert(image.channels[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c,
                                                      Imath::V2i(image.data.x0, image.data.y0),
                                                      image.Width(), image.Height(), pixelBytes,
                                                      pixelBytes * std::size_t(image.Width())));
  }
  file.setFrameBuffer(buffer);
  CreateExrThreadPool();
  file.readPixels(image.data.y0, image.data.y1 - 1);
  return IsLuminance(image) ? ExpandLuminance(image) : image;
}

[[noreturn]] void FailByMemory(const std::string& path) {
  throw Error(ExitStatus::Resource,
              "not enough memory for the picture \"" + path + "\"; " + MemoryLimit());
}

}  // namespace

std::string ExrSoftware(const std::string& path) {
  const UntrappedLibraryCall guard;
  try {
    CheckImageFile(path);
    CheckExrHeaders(path);
    Imf::StdIFStream stream(path.c_str());
    char bytes[8];
    stream.read(bytes, 8);
    int version = 0;
    for (int i = 3; i >= 0; --i) version = version << 8 | static_cast<unsigned char>(bytes[4 + i]);
    Imf::Header header;
    header.readFrom(stream, version);
    const auto* const text = header.findTypedAttribute<Imf::StringAttribute>("software");
    return text ? text->value() : "";
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return "";
  }
}

Image ReadExr(const std::string& path) {
  const UntrappedLibraryCall guard;
  try {
    return Read(path);
  } catch (const std::bad_alloc&) {
    FailByMemory(path);
  } catch (const Iex::EnomemExc&) {
    FailByMemory(path);
  } catch (const std::exception& error) {
    const std::string text = error.what();
    throw ImageError(text.find(path) == std::string::npos ? path + ": " + text : text);
  }
}

}  // namespace exphoton
