// SPDX-License-Identifier: BSD-2-Clause
// These tests quote a scene from the command line, and render what was quoted.
#include <bit>
#include <iterator>
#include <regex>
#include <sstream>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class QuoteTest : public ProgramTest {
 protected:
  QuoteTest() { Write("room.pbrt", SmallRoom()); }
};

TEST_F(QuoteTest, PrintsCommandsThatRenderThePicture) {
  const ProgramResult quote = Run({"quote", "room.pbrt", "--accuracies", "40,20%", "--pilot-time",
                                   "1s", "--integrators", "exphotonmap,path", "--quiet"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  EXPECT_NE(quote.out.find("24 x 16 pixels"), std::string::npos) << quote.out;
  EXPECT_NE(quote.out.find("error 40 %"), std::string::npos) << quote.out;
  EXPECT_NE(quote.out.find("error 20 %"), std::string::npos) << quote.out;
  const std::regex command("exphoton (room.pbrt --integrator path --spp [0-9]+)");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(quote.out, found, command)) << quote.out;
  std::istringstream words(found[1]);
  Names arguments{std::istream_iterator<std::string>(words), {}};
  arguments.insert(arguments.end(), {"-o", "room.exr"});
  const ProgramResult render = Run(arguments);
  EXPECT_EQ(render.status, 0);
  EXPECT_TRUE(Exists("room.exr"));
  ExpectNotIn("instead of", render.err);
}

TEST_F(QuoteTest, NeedsMoreTimeForLessError) {
  const ProgramResult quote = Run({"quote", "room.pbrt", "--accuracies", "2,.5%", "--pilot-time",
                                   "1s", "--integrators", "path", "--quiet"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  std::vector<int> samples;
  const std::regex spp("--spp ([0-9]+)");
  for (std::sregex_iterator i(quote.out.begin(), quote.out.end(), spp), end; i != end; ++i)
    samples.push_back(std::stoi((*i)[1]));
  ASSERT_EQ(samples.size(), 2u) << quote.out;
  EXPECT_GT(samples[1], 4 * samples[0]);
}

// The sampler of the scene takes powers of two.
TEST_F(QuoteTest, PrintsTheSamplesThatTheSamplerTakes) {
  const ProgramResult quote = Run({"quote", "room.pbrt", "--accuracies", "13,11,9,7,5,3%",
                                   "--pilot-time", "1s", "--integrators", "path", "--quiet"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  const std::regex spp("--spp ([0-9]+)");
  int count = 0;
  for (std::sregex_iterator i(quote.out.begin(), quote.out.end(), spp), end; i != end; ++i, ++count)
    EXPECT_TRUE(std::has_single_bit(std::stoul((*i)[1]))) << quote.out;
  EXPECT_EQ(count, 6);
}

// Only the first pilot shoots photons.
TEST_F(QuoteTest, ShowsItsPilotsWhichShareTheirPhotons) {
  const ProgramResult quote = Run({"quote", "room.pbrt", "--accuracies", "40%", "--pilot-time",
                                   "1s", "--integrators", "exphotonmap", "--verbose"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  EXPECT_NE(quote.err.find("pilot of exphotonmap, 2 samples a pixel"), std::string::npos);
  EXPECT_NE(quote.err.find(", bias "), std::string::npos) << quote.err;
  const std::regex price("price of maps ([0-9.e+]+)");
  std::vector<double> prices;
  for (std::sregex_iterator i(quote.err.begin(), quote.err.end(), price), end; i != end; ++i)
    prices.push_back(std::stod((*i)[1]));
  ASSERT_GE(prices.size(), 3u) << quote.err;
  EXPECT_GT(prices.front(), 0);
  for (std::size_t i = 1; i < prices.size(); ++i) EXPECT_EQ(prices[i], 0) << quote.err;
}

TEST_F(QuoteTest, ShowsWarningsAboutTheSceneAndErrorsThatItDoesNotKnow) {
  Write("glas.pbrt", SmallScene("", "Material \"glas\""));
  const ProgramResult quote = Run({"quote", "glas.pbrt", "--accuracies", "40%", "--pilot-time",
                                   "1s", "--integrators", "path,directlighting"});
  ASSERT_EQ(quote.status, 0) << quote.err;
  ExpectIn("there is no material \"glas\"", quote.err);
  ExpectIn("directlighting: the bias leaves out all that this integrator lacks", quote.out);
  ExpectNotIn("path: the bias leaves out", quote.out);
  const ProgramResult cut = Run({"quote", "room.pbrt", "--accuracies", "40%", "--pilot-time", "1s",
                                 "--integrators", "path", "--set", "SurfaceIntegrator.maxdepth=1"});
  ASSERT_EQ(cut.status, 0) << cut.err;
  ExpectIn("warning: integrator \"path\": the depth limit \"maxdepth\" cut about", cut.err);
}

TEST_F(QuoteTest, SaysWhatIsWrong) {
  const auto refused = [&](const Names& more, int status) {
    Names words{"quote", "room.pbrt", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, status) << result.err;
    return result.err;
  };
  EXPECT_NE(refused({"--accuracies", "0.05"}, 1).find("percentages"), std::string::npos);
  EXPECT_NE(refused({"--accuracies", "-3%"}, 1).find("percentages"), std::string::npos);
  EXPECT_NE(refused({"--accuracies", "5,1e-9%"}, 1).find("from 0.001"), std::string::npos);
  refused({"--integrators", "pth"}, 2);
  refused({"--pilot-time", "soon"}, 1);
  EXPECT_EQ(Run({"quote", "none.pbrt"}).status, 3);
}

}  // namespace
}  // namespace exphoton
