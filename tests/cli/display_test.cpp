// SPDX-License-Identifier: BSD-2-Clause
// These tests receive the packets of --display as the viewer tev does, and check what a viewer
// would show. The reader follows tev's own list of packets and their members.
#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <map>
#include <stdexcept>
#include <thread>

#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

// Reads the members of one packet.
class Members {
 public:
  explicit Members(std::string bytes) : bytes_(std::move(bytes)) {}
  template <class Number>
  Number Next() {
    Number number;
    if (at_ + sizeof number > bytes_.size()) throw std::runtime_error("the packet is too short");
    std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  std::string NextText() {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) throw std::runtime_error("a text has no end");
    const std::string text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }
  std::size_t Left() const { return bytes_.size() - at_; }
  const char* Rest() const { return bytes_.data() + at_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

struct Shown {
  int width = 0, height = 0;
  Names channels;
  std::vector<float> pixels;  // with the channels of a pixel adjacent
};

// Viewer is a server for one connection. It keeps the pictures that the packets describe.
class Viewer {
 public:
  enum class Manner { Reads, HangsUp, NeverReads };

  explicit Viewer(Manner manner = Manner::Reads) : manner_(manner) {
    listener_ = socket(AF_INET, SOCK_STREAM, 0);
    const int small = 4096;
    setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        listen(listener_, 1) != 0)
      throw std::runtime_error("no port for the viewer");
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { Serve(); });
  }
  ~Viewer() { End(); }

  std::string Address() const { return "127.0.0.1:" + std::to_string(port_); }
  // Waits until the connection is closed. Pictures and packets may be read afterwards.
  void End() {
    if (!thread_.joinable()) return;
    shutdown(listener_, SHUT_RDWR);  // if nothing ever connected
    thread_.join();
    close(listener_);
    if (connection_ >= 0) close(connection_);
  }

  std::map<std::string, Shown> pictures;
  std::string types;  // of all packets: c(lose), n(ew), u(pdate)
  std::string fault;

 private:
  void Serve() {
    connection_ = accept(listener_, nullptr, nullptr);
    if (connection_ < 0 || manner_ == Manner::NeverReads) return;
    try {
      while (ReadPacket()) {
        if (manner_ == Manner::HangsUp && types.size() >= 3) {
          close(std::exchange(connection_, -1));
          return;
        }
      }
    } catch (const std::runtime_error& error) {
      fault = error.what();
    }
  }
  bool Read(char* to, std::size_t size) const {
    for (std::size_t done = 0; done < size;) {
      const ssize_t count = recv(connection_, to + done, size - done, 0);
      if (count <= 0) {
        if (done > 0) throw std::runtime_error("the last packet is not complete");
        return false;
      }
      done += std::size_t(count);
    }
    return true;
  }
  bool ReadPacket() {
    std::uint32_t size = 0;  // of the whole packet
    if (!Read(reinterpret_cast<char*>(&size), sizeof size)) return false;
    if (size < 5 || size > (1u << 30)) throw std::runtime_error("the length of a packet is wrong");
    std::string bytes(size - 4, '\0');
    if (!Read(bytes.data(), bytes.size())) throw std::runtime_error("a packet has no members");
    Members members(bytes);
    switch (members.Next<char>()) {
      case 2:
        Close(members);
        break;
      case 4:
        Create(members);
        break;
      case 6:
        Update(members);
        break;
      default:
        throw std::runtime_error("an unknown type of packet");
    }
    return true;
  }
  void Close(Members& members) {
    types += 'c';
    pictures.erase(members.NextText());
    if (members.Left() != 0) throw std::runtime_error("bytes after a close packet");
  }
  void Create(Members& members) {
    types += 'n';
    members.Next<char>();  // whether the viewer selects the picture
    Shown& shown = pictures[members.NextText()];
    shown.width = members.Next<std::int32_t>();
    shown.height = members.Next<std::int32_t>();
    shown.channels.resize(std::size_t(members.Next<std::int32_t>()));
    for (std::string& channel : shown.channels) channel = members.NextText();
    shown.pixels.assign(std::size_t(shown.width * shown.height) * shown.channels.size(), -1);
    if (members.Left() != 0) throw std::runtime_error("bytes after a create packet");
  }
  void Update(Members& members) {
    types += 'u';
    members.Next<char>();
    const auto found = pictures.find(members.NextText());
    if (found == pictures.end()) throw std::runtime_error("an update of no picture");
    Shown& shown = found->second;
    Names channels(std::size_t(members.Next<std::int32_t>()));
    for (std::string& channel : channels) channel = members.NextText();
    if (channels != shown.channels) throw std::runtime_error("an update of other channels");
    std::int32_t at[4];  // x, y, width, height
    for (std::int32_t& number : at) number = members.Next<std::int32_t>();
    if (at[0] < 0 || at[1] < 0 || at[2] < 1 || at[3] < 1 || at[0] + at[2] > shown.width ||
        at[1] + at[3] > shown.height)
      throw std::runtime_error("an update beyond the picture");
    std::vector<std::int64_t> offsets(channels.size()), strides(channels.size());
    for (std::int64_t& offset : offsets) offset = members.Next<std::int64_t>();
    for (std::int64_t& stride : strides) stride = members.Next<std::int64_t>();
    std::vector<float> values(members.Left() / 4);
    std::memcpy(values.data(), members.Rest(), 4 * values.size());
    for (std::int64_t i = 0; i < std::int64_t(at[2]) * at[3]; ++i) {
      const std::int64_t x = at[0] + i % at[2], y = at[1] + i / at[2];
      for (std::size_t c = 0; c < channels.size(); ++c)
        shown.pixels[std::size_t(y * shown.width + x) * channels.size() + c] =
            values.at(std::size_t(offsets[c] + i * strides[c]));
    }
  }

  Manner manner_;
  int listener_ = -1, connection_ = -1, port_ = 0;
  std::thread thread_;
};

class Display : public ProgramTest {
 protected:
  // Renders with a viewer. Returns the result of the program.
  ProgramResult Render(Viewer* viewer, const Names& more) {
    Names words{"scene.pbrt", "--float", "--reproducible", "--display", viewer->Address()};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
  // Expects the viewer's picture to be the one in the file.
  void ExpectShown(const Viewer& viewer) const {
    EXPECT_EQ(viewer.fault, "");
    ASSERT_EQ(viewer.pictures.size(), 1u);
    const auto& [name, shown] = *viewer.pictures.begin();
    const Image file = ReadExr(Path("out.exr"));
    EXPECT_TRUE(name.ends_with("out.exr")) << name;
    EXPECT_EQ(shown.channels, (Names{"R", "G", "B", "A"}));
    ASSERT_EQ(shown.width, file.Width());
    ASSERT_EQ(shown.height, file.Height());
    for (int y = 0; y < file.Height(); ++y)
      for (int x = 0; x < file.Width(); ++x)
        for (int c = 0; c < 4; ++c)
          EXPECT_EQ(shown.pixels[std::size_t(4 * (y * shown.width + x) + c)],
                    file.At(x, y, file.FindChannel(shown.channels[std::size_t(c)])));
  }
  static std::string Film(int width, int height) {
    return "Film \"image\" \"string filename\" \"out.exr\" \"integer xresolution\" " +
           std::to_string(width) + " \"integer yresolution\" " + std::to_string(height);
  }
};

TEST_F(Display, ShowsThePictureThatIsWritten) {
  Write("scene.pbrt", SmallScene(Film(100, 70)));
  for (const Names& more : {Names{},
                            {"--filter", "gaussian"},
                            {"--cropwindow", ".2,.9,.3,.8"},
                            {"--two-halves"},
                            {"--target-error", ".01"}}) {
    Viewer viewer;
    const ProgramResult result = Render(&viewer, more);
    EXPECT_EQ(result.status, 0) << result.err;
    viewer.End();
    EXPECT_TRUE(viewer.types.starts_with("cnu")) << viewer.types;
    ExpectShown(viewer);
  }
}

TEST_F(Display, LargePicturesComeInSeveralPackets) {
  Write("scene.pbrt", SmallScene(Film(700, 300) + " PixelFilter \"mitchell\""));
  Viewer viewer;
  EXPECT_EQ(Render(&viewer, {"--spp", "1"}).status, 0);
  viewer.End();
  EXPECT_GT(viewer.types.size(), 5u);
  ExpectShown(viewer);
}

TEST_F(Display, AnAbsentViewerGivesOneWarning) {
  Write("scene.pbrt", SmallScene());
  std::string address;
  {
    const Viewer viewer;
    address = viewer.Address();
  }
  const ProgramResult plain = Run({"scene.pbrt", "--float", "--reproducible"});
  const std::string picture = Read("out.exr");
  const ProgramResult result =
      Run({"scene.pbrt", "--float", "--reproducible", "--display", address});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(Read("out.exr"), picture);
  const std::size_t first = result.err.find("warning: the viewer at " + address);
  EXPECT_NE(first, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("the viewer at", first + 20), std::string::npos) << result.err;
}

TEST_F(Display, AViewerThatEndsOrHangsDoesNoHarm) {
  Write("scene.pbrt", SmallScene(Film(700, 500)));
  EXPECT_EQ(Run({"scene.pbrt", "--float", "--reproducible"}).status, 0);
  const std::string picture = Read("out.exr");
  for (const Viewer::Manner manner : {Viewer::Manner::HangsUp, Viewer::Manner::NeverReads}) {
    Viewer viewer(manner);
    const ProgramResult result = Render(&viewer, {});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("the render goes on"), std::string::npos) << result.err;
    EXPECT_EQ(Read("out.exr"), picture);
    EXPECT_LT(result.seconds, 30);
  }
}

TEST_F(Display, RefusesAddressesWithoutAPort) {
  Write("scene.pbrt", SmallScene());
  for (const char* wrong : {"localhost:", ":14158", "localhost:0", "localhost:70000", "host:tev"}) {
    const ProgramResult result = Run({"scene.pbrt", "--display", wrong});
    EXPECT_EQ(result.status, 1) << wrong;
    EXPECT_NE(result.err.find("--display takes HOST:PORT"), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace exphoton
