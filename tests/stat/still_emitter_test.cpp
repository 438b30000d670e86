// SPDX-License-Identifier: BSD-2-Clause
// These tests check the light of lamps that is averaged over several places of the film: which
// pixels have several places, that the mean stays the same, and that edges become less noisy.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/render/emitters/still_emitters.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kWidth = 24, kHeight = 18;

const char* const kCosts =
    "\"exphotonmap\" \"integer indirectphotons\" 0 \"integer causticphotons\" 0 "
    "\"bool finalgather\" \"false\"";

std::string LampScene(const std::string& options, const std::string& lamp) {
  return "SurfaceIntegrator \"path\"\nFilm \"image\" \"integer xresolution\" 24 \"integer "
         "yresolution\" 18\nSampler \"random\" \"integer pixelsamples\" 64\n" +
         options + "\nWorldBegin\nAreaLightSource \"area\" \"color L\" [50 50 50]\n" + lamp +
         "\nWorldEnd\n";
}

StillEmitters EmittersOf(const LoadedScene& scene) {
  const RenderSetup& setup = *scene.setup;
  const Film film(setup.film.Full(), setup.crop);
  return StillEmitters({*setup.scene, *setup.camera, *setup.filter, film}, 0);
}

int PlacesIn(const LoadedScene& scene, Point2i pixel) { return EmittersOf(scene).PlacesIn(pixel); }

// Returns the pixels with several places, in the filter or in the box of a lamp.
std::set<int> Marked(const std::string& text) {
  const LoadedScene scene = LoadSceneText(text);
  const StillEmitters emitters = EmittersOf(scene);
  std::set<int> marked;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (emitters.PlacesIn({x, y}) > 1 || !emitters.Tiny().In({x, y}).empty())
        marked.insert(y * kWidth + x);
  return marked;
}

TEST(StillEmitters, PlacesOfASampleLieInDifferentRowsAndColumns) {
  for (const int n : {4, 16}) {
    for (const Point2 u :
         {Point2(0, 0), Point2(Real(.3), Real(.95)), Point2(Real(.999), Real(.5))}) {
      std::set<int> columns, rows;
      for (int i = 0; i < n; ++i) {
        const Point2 place = StillEmitters::Place(u, i, n);
        columns.insert(int(std::floor(place.x * Real(n))));
        rows.insert(int(std::floor(place.y * Real(n))));
      }
      EXPECT_EQ(columns.size(), std::size_t(n));
      EXPECT_EQ(rows.size(), std::size_t(n));
      EXPECT_EQ(*columns.begin(), 0);
      EXPECT_EQ(*rows.rbegin(), n - 1);
      EXPECT_EQ(StillEmitters::Place(u, 0, n).x, u.x);
      EXPECT_EQ(StillEmitters::Place(u, 0, n).y, u.y);
    }
  }
}

TEST(StillEmitters, EveryPixelThatShowsALampHasSeveralPlaces) {
  const std::string cameras[] = {"Camera \"perspective\" \"float fov\" 70",
                                 "LookAt .3 -.2 -.5  0 0 2  .2 1 0\nCamera \"perspective\" \"float "
                                 "screenwindow\" [-1 .5 -1 1]",
                                 "LookAt .3 -.2 -.5  0 0 2  0 1 0\nCamera \"orthographic\""};
  const std::string lamps[] = {
      "Translate .4 .3 2 Shape \"sphere\" \"float radius\" .2",
      "Translate -.4 -.6 3 Shape \"sphere\" \"float radius\" .02",
      "Translate -1.4 0 .1 Shape \"sphere\" \"float radius\" 1",  // reaches behind the camera
      "Translate 0 -.5 1 Rotate 80 1 0 0 Shape \"disk\" \"float radius\" 1.5"};
  for (const std::string& lamp : lamps) {
    int shown = 0;
    for (const std::string& camera : cameras) {
      const std::string text = LampScene(camera + "\nPixelFilter \"gaussian\"", lamp);
      const std::set<int> marked = Marked(text);
      const Image image = RenderSceneText(text).image;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          if (!(image.At(x, y, 0) > 0)) continue;
          ++shown;
          EXPECT_TRUE(marked.count(y * kWidth + x)) << camera << lamp << " " << x << "," << y;
        }
      }
    }
    EXPECT_GT(shown, 4) << lamp;
  }
}

TEST(StillEmitters, OtherPixelsHaveOnePlace) {
  const std::string lamp = "Translate .4 .3 2 Shape \"sphere\" \"float radius\" .2";
  const std::string box = "PixelFilter \"box\"\n";
  EXPECT_LT(Marked(LampScene(box, lamp)).size(), 40u);
  EXPECT_TRUE(
      Marked(LampScene(box, "Translate 0 0 -2 Shape \"sphere\" \"float radius\" .2")).empty());
  EXPECT_TRUE(Marked(LampScene(box, "Shape \"sphere\" \"float radius\" 3")).empty());  // round it
  EXPECT_TRUE(Marked(LampScene(box + "Camera \"environment\"", lamp)).empty());
  EXPECT_TRUE(
      Marked(LampScene(box + "Camera \"perspective\" \"float lensradius\" .1", lamp)).empty());
}

TEST(StillEmitters, SmallLampsHaveMorePlaces) {
  const std::string small = "Translate 0 0 2 Shape \"sphere\" \"float radius\" .3";
  const std::string large = "Translate 0 0 2 Shape \"sphere\" \"float radius\" 1";
  const std::string box = "PixelFilter \"box\"\n";
  EXPECT_EQ(PlacesIn(LoadSceneText(LampScene(box, small)), {kWidth / 2, kHeight / 2}), 16);
  EXPECT_EQ(PlacesIn(LoadSceneText(LampScene(box, large)), {kWidth / 2, kHeight / 2}), 4);
}

// Settings of a picture of 16 x 16 pixels. They end before `WorldBegin`.
std::string SmallPicture(const std::string& integrator, const std::string& filter) {
  return "SurfaceIntegrator " + integrator +
         "\nFilm \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
         "Sampler \"random\" \"integer pixelsamples\" 4\nPixelFilter " +
         filter + "\nCamera \"perspective\" \"float fov\" 90\n";
}

std::string Lamp(double radius) {
  return "AreaLightSource \"area\" \"color L\" [50 50 50]\nMaterial \"matte\" \"color Kd\" [0 0 "
         "0]\n"
         "Shape \"sphere\" \"float radius\" " +
         std::to_string(radius) + "\n";
}

// A lamp in front of the camera.
std::string LampAhead(double radius) { return "Translate .1 .2 2 " + Lamp(radius); }

// A lamp behind the camera and a mirror in front of it.
std::string LampInAMirror(double radius) {
  return "AttributeBegin\nTranslate .2 .4 -1 " + Lamp(radius) +
         "AttributeEnd\nMaterial \"mirror\" \"color Kr\" [.9 .8 .7]\n"
         "Translate 0 0 1 Shape \"disk\" \"float radius\" 3\n";
}

// A lamp behind the surface of a glass that begins at the plane z = 1.
std::string LampInGlass(double radius) {
  return "AttributeBegin\n" + LampAhead(radius) +
         "AttributeEnd\nMaterial \"glass\"\n"
         "Translate 0 0 1 Rotate 180 0 1 0 Shape \"disk\" \"float radius\" 3\n";
}

// The pictures of a scene for many seeds.
class LampPictures {
 public:
  static constexpr int kSeeds = 80;

  explicit LampPictures(const std::string& text) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      TestRenderOptions options;
      options.seed = std::uint64_t(seed);
      pictures_.push_back(RenderSceneText(text, options).values);
    }
  }

  std::vector<double> Means() const {
    std::vector<double> means;
    for (const auto& picture : pictures_) {
      means.push_back(0);
      for (const double value : picture) means.back() += value / double(picture.size());
    }
    return means;
  }
  // Returns the variance between seeds, summed over the pixels.
  double Variance() const {
    double sum = 0;
    for (std::size_t i = 0; i < pictures_[0].size(); ++i) {
      double mean = 0, squares = 0;
      for (const auto& picture : pictures_) mean += picture[i] / kSeeds;
      for (const auto& picture : pictures_) squares += std::pow(picture[i] - mean, 2);
      sum += squares / (kSeeds - 1);
    }
    return sum;
  }

 private:
  std::vector<std::vector<double>> pictures_;
};

class LampEdgeTest : public testing::TestWithParam<const char*> {};

void ExpectSameMean(const LampPictures& averaged, const LampPictures& plain) {
  double difference = 0, squares = 0, size = 0;
  const std::vector<double> a = averaged.Means(), b = plain.Means();
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) / double(a.size());
    squares += std::pow(a[i] - b[i], 2);
    size += b[i] / double(b.size());
  }
  const double error = std::sqrt(squares) / double(a.size());
  EXPECT_LT(std::abs(difference), 4 * error);
  EXPECT_LT(error, .2 * size);
}

void ExpectLessNoise(const std::string& filter, const std::string& world, double factor) {
  const std::string end = "WorldBegin\n" + world + "WorldEnd\n";
  // `path` does not average over places, and shows the same lamp.
  const LampPictures averaged(SmallPicture(kCosts, filter) + end);
  const LampPictures plain(SmallPicture("\"path\" \"integer maxdepth\" 10", filter) + end);
  ExpectSameMean(averaged, plain);
  EXPECT_LT(averaged.Variance(), plain.Variance() / factor);
}

TEST_P(LampEdgeTest, TheMeanIsTheSameAndTheNoiseIsLess) {
  ExpectLessNoise(GetParam(), LampAhead(.06), 8);
  ExpectLessNoise(GetParam(), LampAhead(.4), 3);
}

// Returns a lamp that faces the camera, with a radius of 8 `size` pixels.
std::string FacingLamp(double size, const std::string& place) {
  return "AttributeBegin AreaLightSource \"area\" \"color L\" [50 50 50]\nTranslate " + place +
         " ReverseOrientation Shape \"disk\" \"float radius\" " + std::to_string(2 * size) +
         " AttributeEnd\n";
}

// Returns the mean over a disk of the film of the filter's values for all pixels, where the filter
// has the integral 1. It is 1 for filters whose copies add up to a constant.
double SumOfFilters(const Filter& filter, double x, double y, double radius) {
  constexpr int kSteps = 200;
  double integral = 0, sum = 0, count = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const double u = 2 * (i % kSteps + .5) / kSteps - 1, v = 2 * (i / kSteps + .5) / kSteps - 1;
    const double w = double(filter.XWidth()), h = double(filter.YWidth());
    integral += double(filter.Evaluate({Real(u * w), Real(v * h)})) * 4 * w * h / (kSteps * kSteps);
    if (i % 41 != 0 || u * u + v * v > 1) continue;  // some points of the disk
    ++count;
    for (int pixel = 0; pixel < 16 * 16; ++pixel) {
      const double dx = x + radius * u - pixel % 16 - .5, dy = y + radius * v - pixel / 16 - .5;
      if (std::abs(dx) < w && std::abs(dy) < h)
        sum += double(filter.Evaluate({Real(dx), Real(dy)}));
    }
  }
  return sum / count / integral;
}

// The sum over all pixels is the radiance times the area of the disk in pixels.
TEST_P(LampEdgeTest, TinyLampsHaveTheRightLight) {
  for (const double size : {.001, .02, .06}) {
    const std::string text = SmallPicture(kCosts, GetParam()) + "WorldBegin\n" +
                             FacingLamp(size, ".13 .21 2") + "WorldEnd\n";
    const std::vector<double> means = LampPictures(text).Means();
    double mean = 0, squares = 0;
    for (const double value : means) mean += value / double(means.size());
    for (const double value : means) squares += std::pow(value - mean, 2);
    const double scatter = std::sqrt(squares / double(means.size() - 1));
    const double filters = SumOfFilters(*LoadSceneText(text).setup->filter, 8.52, 7.16, 8 * size);
    const double truth = 50 * double(kPi) * std::pow(8 * size, 2) * filters / (16 * 16);
    EXPECT_LT(scatter, .35 * truth) << size;  // one picture of 4 samples
    EXPECT_NEAR(mean, truth, 4 * scatter / std::sqrt(double(means.size())) + 1e-4 * truth) << size;
  }
}

// A lamp in front of another has its own light only.
TEST_P(LampEdgeTest, TinyLampsHideOthers) {
  const auto lightOf = [&](const std::string& world) {
    double sum = 0;
    for (const double mean :
         LampPictures(SmallPicture(kCosts, GetParam()) + "WorldBegin\n" + world + "WorldEnd\n")
             .Means())
      sum += mean / LampPictures::kSeeds;
    return sum;
  };
  const std::string near = FacingLamp(.01, "0 0 1"), far = FacingLamp(.02, "0 0 2");
  // The farther disk looks as large as the nearer one.
  EXPECT_NEAR(lightOf(near + far), lightOf(near), .02 * lightOf(near));
  EXPECT_GT(lightOf(far), .1 * lightOf(near));
}

TEST_P(LampEdgeTest, LampsBehindSpecularSurfacesToo) {
  ExpectLessNoise(GetParam(), LampInAMirror(.2), 8);
  ExpectLessNoise(GetParam(), LampInAMirror(.4), 8);
  ExpectLessNoise(GetParam(), LampInGlass(.2), 8);
  ExpectLessNoise(GetParam(), LampInGlass(.4), 8);
}

TEST_P(LampEdgeTest, AMediumDimsTheLampsAtAllPlaces) {
  const std::string fog =
      "Volume \"homogeneous\" \"color sigma_a\" [.3 .4 .5] \"color sigma_s\" [0 0 0] "
      "\"point p0\" [-9 -9 -9] \"point p1\" [9 9 9]\n";
  ExpectLessNoise(GetParam(), fog + LampAhead(.4), 3);
  ExpectLessNoise(GetParam(), fog + LampInAMirror(.4), 8);
}

// The pixels that have several places for reflections are found while the picture is rendered.
TEST_P(LampEdgeTest, ThreadsTilesAndCropsChangeNothing) {
  const auto render = [&](const std::string& crop, int threads, int tileSize) {
    const std::string text = SmallPicture(kCosts, std::string(GetParam()) + crop) + "WorldBegin\n" +
                             FacingLamp(.02, ".1 .3 .9") + LampInAMirror(.2) + "WorldEnd\n";
    TestRenderOptions options;
    options.threads = threads;
    options.tileSize = tileSize;
    return RenderSceneText(text, options);
  };
  const TestRender whole = render("", 1, 16), other = render("", 7, 3);
  EXPECT_EQ(whole.values, other.values);
  EXPECT_EQ(whole.rays.counts, other.rays.counts);
  const TestRender part = render(
      "\nFilm \"image\" \"integer xresolution\" 16 \"integer "
      "yresolution\" 16 \"float cropwindow\" [.25 .75 .125 .625]",
      2, 5);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(part.image.At(x, y, 0), whole.image.At(x + 4, y + 2, 0)) << x << "," << y;
}

// The parts of the light add up to the picture, also where a lamp and its reflection are averaged.
TEST(StillEmitters, PartsOfTheLightAddUp) {
  const std::string world = "WorldBegin\nAttributeBegin\nTranslate -.3 0 .6 " + Lamp(.1) +
                            "AttributeEnd\n" + LampInAMirror(.3) + "WorldEnd\n";
  TestRenderOptions options;
  options.load.samplesPerPixel = 3;
  options.aovs = kLightAovs;
  const Image image = RenderSceneText(SmallPicture(kCosts, "\"gaussian\"") + world, options).image;
  EXPECT_GT(MeanChannel(image, "emission.R"), .01);
  EXPECT_GT(MeanChannel(image, "specular.R"), .01);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      double sum = 0;
      for (const char* part : {"emission.R", "direct.R", "caustic.R", "indirect.R", "specular.R"})
        sum += double(image.At(x, y, image.FindChannel(part)));
      EXPECT_NEAR(sum, double(image.At(x, y, 0)), 1e-5 * (1 + sum)) << x << "," << y;
    }
}

// The light of a lamp that moves is averaged over times and not over places.
TEST(StillEmitters, ALampMayPassInFrontOfAnother) {
  const std::string end = "ActiveTransform EndTime Translate 1.5 0 0 ActiveTransform All\n";
  const std::string world = "WorldBegin\nAttributeBegin\n" + LampAhead(.4) +
                            "AttributeEnd\nAttributeBegin\n" + end + "Translate -.8 .1 1.2 " +
                            Lamp(.12) + "AttributeEnd\nWorldEnd\n";
  const LampPictures averaged(SmallPicture(kCosts, "\"box\"") + world);
  const LampPictures plain(SmallPicture("\"path\"", "\"box\"") + world);
  ExpectSameMean(averaged, plain);
}

INSTANTIATE_TEST_SUITE_P(Filters, LampEdgeTest,
                         testing::Values("\"box\"", "\"gaussian\"",
                                         "\"triangle\" \"float xwidth\" 1.5"));

// Rays through the lens hardly ever meet such a lamp. A disk of blur has the light of the lamp in
// focus, because a point of the lens shows the lamp in the same size.
TEST(StillEmitters, TinyLampsOutOfFocusKeepTheirLight) {
  const auto lightOf = [](const std::string& camera, const std::string& lens,
                          const std::string& filter) {
    std::string scene =
        LampScene("Camera \"" + camera + "\" " + lens + "PixelFilter " + filter,
                  "Translate .3 .2 2 Rotate 180 0 1 0 Shape \"disk\" \"float radius\" .02");
    scene.replace(scene.find("\"path\""), 6, kCosts);
    scene.replace(scene.find(" 64\n"), 3, " 512");
    std::pair<double, int> sum{};  // and the number of values above 0, three for a pixel
    for (const double value : RenderSceneText(scene).values) {
      sum.first += value / 3;
      sum.second += value > 0;
    }
    return sum;
  };
  const std::string box = "\"box\"", wide = "\"gaussian\" \"float xwidth\" 1 \"float ywidth\" 1";
  const std::string lens = "\"float lensradius\" .2 \"float focaldistance\" .5 ";
  for (const std::string camera : {"perspective", "orthographic"}) {
    const auto [sharp, few] = lightOf(camera, "", box);
    const auto [blurred, many] = lightOf(camera, lens, box);
    EXPECT_LE(few, 3 * 4) << camera;
    EXPECT_GE(many, 3 * 12) << camera;
    EXPECT_NEAR(blurred / sharp, 1, .03) << camera;
    EXPECT_NEAR(lightOf(camera, lens, wide).first / sharp, 1, .03) << camera;
    const double pixel = 2. / kHeight;  // of the orthographic camera
    if (camera == "orthographic")
      EXPECT_NEAR(sharp, 50 * 3.14159 * .02 * .02 / (pixel * pixel), .03 * sharp);
  }
}

}  // namespace
}  // namespace exphoton
