// SPDX-License-Identifier: BSD-2-Clause
// These commands print information about pictures or convert their format.
#include "core/app/commands/image_commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/app/commands/photons_command.h"
#include "core/app/options/errors.h"
#include "core/app/options/limits.h"
#include "core/app/options/option_parser.h"
#include "core/app/options/values.h"
#include "core/app/output/exr_output.h"
#include "core/app/output/output_files.h"
#include "core/app/output/png_output.h"
#include "core/app/output/run_files.h"
#include "core/app/process/interrupt_watch.h"
#include "core/base/error.h"
#include "core/base/format.h"
#include "core/base/log.h"
#include "core/imaging/image.h"
#include "core/params/suggestions.h"

namespace exphoton::cli {
namespace {

std::string WindowText(const char* name, const PixelBounds& window) {
  return Format("%-16s %d x %d at (%d, %d)\n", name, window.Width(), window.Height(), window.x0,
                window.y0);
}

// Prints minimum, mean and maximum of the finite values.
std::string ChannelText(const Image& image, int channel) {
  double sum = 0;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  long long finite = 0, nonFinite = 0;
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      const float value = image.At(x, y, channel);
      if (!std::isfinite(value)) {
        ++nonFinite;
        continue;
      }
      ++finite;
      sum += double(value);
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  std::string text = Format("  %-14s ", image.channels[std::size_t(channel)].c_str());
  text += finite > 0 ? Format("min %-12.6g mean %-12.6g max %-12.6g", double(low),
                              sum / double(finite), double(high))
                     : std::string("no finite value");
  if (nonFinite > 0) text += Format(" (%lld not finite)", nonFinite);
  return text + "\n";
}

std::string AttributeText(const ImageAttribute& attribute) {
  if (const auto* text = std::get_if<std::string>(&attribute)) {
    std::string indented;
    std::string_view rest = *text;
    while (rest.ends_with('\n')) rest.remove_suffix(1);
    for (const char c : rest)
      indented += c == '\n' ? std::string("\n") + std::string(17, ' ') : std::string(1, c);
    return indented;
  }
  if (const auto* number = std::get_if<float>(&attribute)) return Format("%.9g", double(*number));
  if (const auto* integer = std::get_if<int>(&attribute)) return std::to_string(*integer);
  std::string list;
  for (const float value : std::get<std::vector<float>>(attribute))
    list += Format(list.empty() ? "%.9g" : " %.9g", double(value));
  return list;
}

std::string InfoText(const std::string& path, const Image& image) {
  std::string text = path + "\n" + WindowText("data window", image.data) +
                     WindowText("display window", image.display) + "channels\n";
  for (int c = 0; c < image.ChannelCount(); ++c) text += ChannelText(image, c);
  if (!image.attributes.empty()) text += "attributes\n";
  for (const auto& [name, value] : image.attributes)
    text += Format("  %-14s ", name.c_str()) + AttributeText(value) + "\n";
  return text;
}

// Returns the names of the layers: the parts of channel names before the last dot, and Z.
std::vector<std::string> LayerNames(const Image& image) {
  std::vector<std::string> names;
  for (const std::string& channel : image.channels) {
    const std::string name = channel.substr(0, channel.rfind('.'));
    if (channel.rfind('.') == std::string::npos && channel != "Z") continue;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

// Returns a picture with the channels R, G, B of a layer. A layer of one channel becomes grey, and
// one of two channels has no blue. The channels of an exact layer stay exact.
Image LayerOf(const Image& image, const std::string& layer, const std::string& path) {
  std::vector<int> from;
  for (int c = 0; c < image.ChannelCount(); ++c)
    if (image.channels[std::size_t(c)].starts_with(layer + ".") ||
        (layer == "Z" && image.channels[std::size_t(c)] == layer))
      from.push_back(c);
  const auto channel = [&](const char* name) { return image.FindChannel(layer + "." + name); };
  for (const auto& names : {std::array{"R", "G", "B"}, std::array{"X", "Y", "Z"}}) {
    const std::vector<int> three{channel(names[0]), channel(names[1]), channel(names[2])};
    if (std::find(three.begin(), three.end(), -1) == three.end()) from = three;
  }
  if (from.empty() || from.size() > 3) {
    std::string list;
    for (const std::string& name : LayerNames(image)) list += (list.empty() ? "" : ", ") + name;
    throw Error(ExitStatus::CommandLine,
                "\"" + path + "\" has no layer \"" + layer + "\"; " +
                    (list.empty() ? "it has no layers" : "its layers are " + list),
                {}, DidYouMean(layer, LayerNames(image)));
  }
  Image result(image.data, image.display, {"R", "G", "B"});
  result.attributes = image.attributes;
  for (const int c : from)
    if (image.exactChannels.contains(image.channels[std::size_t(c)]))
      result.exactChannels = {"R", "G", "B"};
  if (from.size() == 1) from.assign(3, from[0]);
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      for (std::size_t c = 0; c < from.size(); ++c)
        result.At(x, y, int(c)) = image.At(x, y, from[c]);
  return result;
}

}  // namespace

int RunInfo(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    const auto isPhotons = [](const std::string& a) { return a.starts_with("--photons-at"); };
    if (std::any_of(arguments.begin(), arguments.end(), isPhotons))
      return PrintPhotonsAt(arguments);
    OptionParser app(
        "Prints windows, channels, attributes and ranges of pictures; with --photons-at x,y SCENE "
        "the photons around what a pixel shows (see its --help).",
        "exphoton info");
    std::vector<std::string> files;
    std::string limitsText;
    app.Add("files", files, "EXR or PNG files").Required();
    AddLimitsOption(app, &limitsText);
    app.Parse(arguments);
    const Limits limits = ParseLimits(limitsText);
    LimitMemory(limits);
    const InterruptWatch watch(limits.seconds);
    for (const std::string& file : files) PrintOut(InfoText(file, ReadImage(file)));
  });
}

int RunConvert(const std::vector<std::string>& arguments) {
  return Guarded([&] {
    OptionParser app("Converts between EXR (linear) and PNG (sRGB), by the names' endings.",
                     "exphoton convert");
    std::string from, to, layer, limitsText;
    PngOptions png;
    bool asFloat = false;
    app.Add("from", from, "picture to read").Required();
    app.Add("to", to, "picture to write: NAME.exr or NAME.png").Required();
    app.Add("--layer", layer, "take only this layer, such as albedo, direct or half1")
        .TypeName("NAME");
    AddPngOptions(app, &png);
    app.AddFlag("--float", asFloat, "for EXR: 32-bit channels");
    AddLimitsOption(app, &limitsText);
    app.Parse(arguments);
    CheckPngOptions(png);
    const bool isPng = IsPngName(to);
    if (!isPng && !IsExrName(to)) FailUsage("\"" + to + "\" ends neither in .exr nor .png");
    if (!isPng && png.IsGiven())
      FailUsage("--exposure and --tone-curve are for PNG: an EXR stays linear");
    if (isPng && asFloat) FailUsage("--float is for EXR: a PNG has 8 bits");
    RunFiles files;
    files.AddInput(from, "this command");
    files.AddOutput("to", {to, "the picture", "another name keeps both pictures"});
    Log log;
    files.Check(log);
    const Limits limits = ParseLimits(limitsText);
    LimitMemory(limits);
    const InterruptWatch watch(limits.seconds);
    Image image = ReadImage(from);
    if (!layer.empty()) image = LayerOf(image, layer, from);
    if (isPng)
      WritePngPicture(to, image, png, log);
    else
      WriteExrPicture(to, image, !asFloat, log);
  });
}

}  // namespace exphoton::cli
