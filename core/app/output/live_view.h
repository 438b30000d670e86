// SPDX-License-Identifier: BSD-2-Clause
// LiveView sends a picture to an image viewer while it is rendered, in the network protocol of tev
// (https://github.com/Tom94/tev). A thread sends, so a slow, absent or ended viewer neither delays
// nor changes the render.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/app/process/viewer_connection.h"
#include "core/base/log.h"
#include "core/render/render.h"

namespace exphoton::cli {

class LiveView : public RenderView {
 public:
  struct Picture {
    std::string name;  // as the viewer shows it
    PixelBounds crop;
    bool premultiplyAlpha = true;
  };
  LiveView(const ViewerAddress& address, const Picture& picture, Log& log);
  // Sends what is left, for at most two seconds.
  ~LiveView() override;

  void Show(const Film& film, const PixelBounds& part) override;

 private:
  using Clock = std::chrono::steady_clock;

  void Run();
  // Sends parts until the picture is complete. Returns a reason if sending failed, or "".
  std::string SendParts(ViewerConnection* connection);
  bool IsOver();

  const ViewerAddress address_;
  const Picture picture_;
  Log& log_;
  std::mutex mutex_;  // guards all that follows
  std::condition_variable changed_;
  std::vector<float> pixels_;       // R, G, B, A of the crop window
  std::vector<PixelBounds> parts_;  // not sent yet; within the full picture
  bool isOver_ = false;
  Clock::time_point end_;  // of sending; set with isOver_
  std::thread thread_;
};

// The packets of the protocol. Numbers are little-endian; a packet begins with its length in bytes.
std::string ClosePacket(const std::string& name);
std::string CreatePacket(const std::string& name, int width, int height);
// `pixels` has R, G, B and A of each pixel. `part` counts from the corner of the picture.
std::string UpdatePacket(const std::string& name, const PixelBounds& part,
                         const std::vector<float>& pixels);

}  // namespace exphoton::cli
