// SPDX-License-Identifier: BSD-2-Clause
// LiveView keeps a copy of the picture. Threads that render write into it, and the sending thread
// reads the parts that changed.
#include "core/app/output/live_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

namespace exphoton::cli {
namespace {

constexpr int kChannels = 4;
constexpr const char* kChannelNames[kChannels] = {"R", "G", "B", "A"};
constexpr std::size_t kMaxParts = 4096;  // more are sent as the whole picture
constexpr std::int64_t kPacketPixels = 1 << 16;
constexpr std::chrono::seconds kLastTime(2);  // for sending after the end of the render

// Types of packets. Update is the version with offsets and strides.
enum PacketType : char { kClose = 2, kCreate = 4, kUpdate = 6 };

class Packet {
 public:
  explicit Packet(PacketType type) : bytes_(4, '\0') { bytes_ += char(type); }
  void Flag(bool value) { bytes_ += char(value ? 1 : 0); }
  void Text(const std::string& text) { bytes_ += text.substr(0, text.find('\0')) + '\0'; }
  template <class Number>
  void Value(Number number) {
    static_assert(std::endian::native == std::endian::little);
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void Values(const std::vector<float>& values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), 4 * values.size());
  }
  std::string Finish() {
    const auto size = std::uint32_t(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string ClosePacket(const std::string& name) {
  Packet packet(kClose);
  packet.Text(name);
  return packet.Finish();
}

std::string CreatePacket(const std::string& name, int width, int height) {
  Packet packet(kCreate);
  packet.Flag(true);  // select the picture
  packet.Text(name);
  for (const std::int32_t number : {width, height, kChannels}) packet.Value(number);
  for (const char* channel : kChannelNames) packet.Text(channel);
  return packet.Finish();
}

std::string UpdatePacket(const std::string& name, const PixelBounds& part,
                         const std::vector<float>& pixels) {
  Packet packet(kUpdate);
  packet.Flag(false);
  packet.Text(name);
  packet.Value(std::int32_t(kChannels));
  for (const char* channel : kChannelNames) packet.Text(channel);
  for (const std::int32_t number : {part.x0, part.y0, part.Width(), part.Height()})
    packet.Value(number);
  // The first value of each channel, and the distance between two of its values.
  for (int c = 0; c < kChannels; ++c) packet.Value(std::int64_t(c));
  for (int c = 0; c < kChannels; ++c) packet.Value(std::int64_t(kChannels));
  packet.Values(pixels);
  return packet.Finish();
}

LiveView::LiveView(const ViewerAddress& address, const Picture& picture, Log& log)
    : address_(address),
      picture_(picture),
      log_(log),
      pixels_(std::size_t(picture.crop.Width()) * std::size_t(picture.crop.Height()) * kChannels) {
  try {
    thread_ = std::thread([this] { Run(); });
  } catch (const std::system_error&) {
    log_.Warning("--display has no effect: no thread could be started");
  }
}

LiveView::~LiveView() {
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
    end_ = Clock::now() + kLastTime;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void LiveView::Show(const Film& film, const PixelBounds& part) {
  std::vector<float> values;
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) {
      const std::array<double, 4> mean = film.MeanOf({x, y});
      const double alpha = std::clamp(mean[3], 0., 1.);
      const double scale = picture_.premultiplyAlpha ? alpha : 1;
      for (std::size_t c = 0; c < 3; ++c) values.push_back(float(std::max(mean[c], 0.) * scale));
      values.push_back(float(alpha));
    }
  }
  const PixelBounds& crop = picture_.crop;
  const std::size_t rowSize = std::size_t(part.Width()) * kChannels;
  {
    const std::lock_guard lock(mutex_);
    for (int y = part.y0; y < part.y1; ++y) {
      const std::size_t at =
          std::size_t(y - crop.y0) * std::size_t(crop.Width()) + std::size_t(part.x0 - crop.x0);
      std::copy_n(values.begin() + std::ptrdiff_t(rowSize * std::size_t(y - part.y0)), rowSize,
                  pixels_.begin() + std::ptrdiff_t(at * kChannels));
    }
    if (parts_.size() >= kMaxParts) parts_.assign(1, crop);
    parts_.push_back(part);
  }
  changed_.notify_one();
}

bool LiveView::IsOver() {
  const std::lock_guard lock(mutex_);
  return isOver_ && Clock::now() > end_;
}

void LiveView::Run() {
  ViewerConnection connection;
  const auto givesUp = [this] { return IsOver(); };
  std::string reason = connection.Connect(address_, givesUp);
  // A viewer may still show the picture of an earlier render.
  const PixelBounds& crop = picture_.crop;
  for (const std::string& packet :
       {ClosePacket(picture_.name), CreatePacket(picture_.name, crop.Width(), crop.Height())})
    if (reason.empty()) reason = connection.Send(packet, givesUp);
  if (reason.empty()) reason = SendParts(&connection);
  if (!reason.empty())
    log_.Warning("the viewer at " + address_.Text() + " is not updated: " + reason +
                 "; the render goes on");
}

std::string LiveView::SendParts(ViewerConnection* connection) {
  const PixelBounds& crop = picture_.crop;
  for (;;) {
    std::vector<float> values;
    PixelBounds part;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return isOver_ || !parts_.empty(); });
      if (parts_.empty()) return "";
      // A large part is sent in several packets.
      part = parts_.back();
      const std::int64_t most = std::max<std::int64_t>(kPacketPixels / part.Width(), 1);
      const int rows = int(std::min<std::int64_t>(most, part.Height()));
      parts_.back().y0 += rows;
      part.y1 = part.y0 + rows;
      if (parts_.back().IsEmpty()) parts_.pop_back();
      for (int y = part.y0; y < part.y1; ++y) {
        const auto row = pixels_.begin() +
                         std::ptrdiff_t(kChannels) *
                             (std::ptrdiff_t(y - crop.y0) * crop.Width() + (part.x0 - crop.x0));
        values.insert(values.end(), row, row + std::ptrdiff_t(kChannels) * part.Width());
      }
    }
    const PixelBounds place{part.x0 - crop.x0, part.y0 - crop.y0, part.x1 - crop.x0,
                            part.y1 - crop.y0};
    const std::string reason =
        connection->Send(UpdatePacket(picture_.name, place, values), [this] { return IsOver(); });
    if (!reason.empty()) return reason;
  }
}

}  // namespace exphoton::cli
