// SPDX-License-Identifier: BSD-2-Clause
// ViewerConnection sends bytes to a program over TCP. Every call ends within a given time, whether
// the other side reads or not.
#pragma once

#include <functional>
#include <string>

namespace exphoton::cli {

struct ViewerAddress {
  std::string host, port;
  std::string Text() const { return host + ":" + port; }
};

// "localhost:14158", "[::1]:14158", or a host alone, which gets tev's port. Throws
// Error(CommandLine).
ViewerAddress ParseViewerAddress(const std::string& text);

class ViewerConnection {
 public:
  // Calls give up when this returns true.
  using GivesUp = std::function<bool()>;

  ViewerConnection() = default;
  ~ViewerConnection();
  ViewerConnection(const ViewerConnection&) = delete;
  ViewerConnection& operator=(const ViewerConnection&) = delete;

  // Returns a reason if there is no connection after three seconds, or "".
  std::string Connect(const ViewerAddress& address, const GivesUp& givesUp);
  // Returns a reason if not all bytes were sent, or "".
  std::string Send(const std::string& bytes, const GivesUp& givesUp);

 private:
  std::string WaitUntilWritable(int socket, const GivesUp& givesUp) const;

  int socket_ = -1;
};

}  // namespace exphoton::cli
