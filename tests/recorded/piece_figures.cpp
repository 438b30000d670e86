// SPDX-License-Identifier: BSD-2-Clause
// PieceFigures: how pictures are divided into tiles, bands and shards, estimates of bias from
// invented corrections, names of files and near names, and tails of distributions.
#include <stdexcept>

#include "core/app/checks/chi_square.h"
#include "core/base/memory.h"
#include "core/base/terminal.h"
#include "core/imaging/metrics/noise_test.h"
#include "core/params/suggestions.h"
#include "core/parser/frame_name.h"
#include "core/render/certificate/certificate.h"
#include "core/render/shards/shard_tiles.h"
#include "core/render/sharing/sharing_bands.h"
#include "core/render/tiles.h"
#include "tests/recorded/draw.h"
#include "tests/recorded/figures.h"

namespace exphoton::recorded {
namespace {

const std::vector<PixelBounds> kWindows{
    {0, 0, 40, 30}, {3, 5, 21, 90}, {17, 0, 18, 400}, {-7, -4, 65, 11}, {0, 2, 33, 34}};

std::string Bounds(const PixelBounds& b) {
  return "[" + std::to_string(b.x0) + "," + std::to_string(b.x1) + "," + std::to_string(b.y0) +
         "," + std::to_string(b.y1) + "]";
}

void AddWindows(FigureLines* lines) {
  for (const PixelBounds& window : kWindows) {
    for (const int reach : {0, 3})
      lines->Add("margin " + Bounds(window), double(reach),
                 Bounds(WithSharingMargin(window, {-10, -10, 100, 500}, reach)),
                 Bounds(WithSharingMargin(window, window, reach)));
    const PixelBounds gathered = WithSharingMargin(window, {-10, -10, 100, 500}, 1);
    for (const double memory : {1e5, 4e6, 1e9})
      for (const SharingBand& band : PlanBands(window, gathered, 4, memory))
        lines->Add("band", memory, Bounds(band.window), Bounds(band.gathered));
    for (const TileOrder order : {TileOrder::Scanline, TileOrder::Reversed, TileOrder::Scattered}) {
      RenderOptions options;
      options.tileSize = 13;
      options.tileOrder = order;
      const Tiles tiles(window, options);
      std::string text;
      for (std::int64_t i = 0; i < tiles.Count(); i += 3) text += Bounds(tiles.Get(i));
      lines->Add("tiles", double(tiles.Count()), text);
    }
    for (const Shard shard : {Shard{1, 1}, Shard{2, 3}, Shard{5, 7}}) {
      const std::vector<ShardTile> tiles = TilesOf(shard, window);
      std::string text;
      for (const ShardTile& tile : tiles) text += std::to_string(tile.number) + Bounds(tile.bounds);
      lines->Add("shard", double(CountPixels(tiles)), text);
    }
  }
}

void AddBias(const BlockBias& bias, FigureLines* lines) {
  lines->Add("bias", double(bias.blockWidth), double(bias.blocks), bias.squared, bias.lower,
             bias.upper, bias.smallest, BlockBias::Root(bias.squared));
}

void AddCertificates(FigureLines* lines) {
  for (const auto& [width, height] : {std::pair{40, 24}, {17, 9}, {64, 64}}) {
    for (const double offset : {0., .3, 1.5}) {
      std::vector<std::vector<float>> pixels(3);
      std::vector<BlockBiasEstimator::Group> groups;
      for (std::size_t g = 0; g < 3; ++g) {
        Draw draw(g + std::uint64_t(width));
        for (int i = 0; i < width * height * 3; ++i)
          pixels[g].push_back(float(double(draw.Below(1000)) / 500 - 1 + offset * (i % 3)));
        groups.push_back({pixels[g], g == 0 ? .5 : .25});
      }
      const BlockBiasEstimator all(width, height, groups);
      const BlockBiasEstimator two(width, height, std::span(groups).subspan(1));
      for (const int block : {4, 8, 16, 32}) AddBias(all.Estimate(block), lines);
      for (const double wanted : {.0001, .01, .5}) {
        AddBias(all.EstimateFor(wanted), lines);
        AddBias(two.EstimateFor(wanted), lines);
      }
      Certificate certificate;
      certificate.noise = .0004;
      certificate.bias = all.EstimateFor(.01);
      certificate.corrections = 1234;
      if (offset > 0) certificate.notCovered = {"this", "that"};
      lines->Add(ErrorText(certificate));
      for (const std::string& text : DetailTexts(certificate)) lines->Add(text);
    }
  }
}

void AddNames(FigureLines* lines) {
  for (const char* name : {"room.exr", "room%d.exr", "a%03d/b%d.exr", "%5d", "100%", "%s.exr",
                           "%%d.exr", "%0d", "x%1234d"})
    lines->Add("name", name, HasFrameNumber(name) ? "has a number" : "has none",
               FrameName(name, 42), FrameName(name, 0), NameWithoutNumber(name), FrameFormat(name));
  const std::vector<std::string> known{"sphere", "spheres", "disk", "cone", "Paraboloid", "mix"};
  for (const char* name : {"spere", "sphree", "SPHERE", "dsk", "c", "coen", "paraboloids", "max",
                           "minx", "", "xyz", "spheress", "hyperboloid"})
    lines->Add("near", name, DidYouMean(name, known), double(EditDistance(name, "sphere")),
               double(EditDistance("mix", name)));
  for (const int columns : {12, 20, 33})
    for (const int indent : {0, 5})
      lines->Add("wrapped", WrappedText("An overlongwordforthis, then  short ones and an end.",
                                        indent, columns));
  for (const double bytes : {0., 1., 1048576., 1048577., 3.5e9})
    lines->Add("bytes", bytes, Megabytes(bytes));
}

void AddTails(FigureLines* lines) {
  for (const double x : {0., .3, 2., 5., 17., 60., 300.}) {
    for (const int degrees : {1, 2, 7, 50, 400}) lines->Add("chi", x, ChiSquareTail(x, degrees));
    for (const double degrees : {1., 2.5, 9., 300.}) lines->Add("t", x, StudentTail(x, degrees));
  }
  for (const int count : {1, 2, 30, 1000}) lines->Add("sidak", SignificanceOf(.01, count));
}

}  // namespace

std::vector<std::string> PieceFigures() {
  FigureLines lines;
  AddWindows(&lines);
  AddCertificates(&lines);
  AddNames(&lines);
  AddTails(&lines);
  return lines.Take();
}

std::string FigureLines::Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::vector<std::string> Figures() {
  std::vector<std::string> figures;
  for (const auto& group : {PriceFigures(), StudyFigures(), PieceFigures()})
    for (std::string line : group) {
      for (std::size_t at; (at = line.find('\n')) != std::string::npos;) line.replace(at, 1, "|");
      figures.push_back(std::move(line));
    }
  return figures;
}

}  // namespace exphoton::recorded
