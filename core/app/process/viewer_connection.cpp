// SPDX-License-Identifier: BSD-2-Clause
// ViewerConnection: a socket that never blocks, and poll with short waits.
#include "core/app/process/viewer_connection.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <memory>

#include "core/base/error.h"
#include "core/files/open_file.h"

namespace exphoton::cli {
namespace {

constexpr const char* kTevPort = "14158";
constexpr int kPollMilliseconds = 50;
constexpr std::chrono::seconds kConnectTime(3);

}  // namespace

ViewerAddress ParseViewerAddress(const std::string& text) {
  ViewerAddress address{text, kTevPort};
  const std::size_t colon = text.rfind(':'), bracket = text.rfind(']');
  const bool hasPort =
      colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
  if (hasPort) address = {text.substr(0, colon), text.substr(colon + 1)};
  std::string& host = address.host;
  if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    host = host.substr(1, host.size() - 2);
  int port = 0;
  const char* const end = address.port.data() + address.port.size();
  const auto [next, error] = std::from_chars(address.port.data(), end, port);
  if (host.empty() || error != std::errc() || next != end || port < 1 || port > 65535)
    throw Error(ExitStatus::CommandLine,
                "--display takes HOST:PORT with a port from 1 to 65535, not \"" + text + "\"", {},
                "for example --display localhost:14158");
  return address;
}

std::string ViewerConnection::WaitUntilWritable(int socket, const GivesUp& givesUp) const {
  for (;;) {
    pollfd wait{socket, POLLOUT, 0};
    const int ready = poll(&wait, 1, kPollMilliseconds);
    if (ready > 0) return "";
    if (ready < 0 && errno != EINTR) return std::strerror(errno);
    if (givesUp()) return "it does not answer";
  }
}

std::string ViewerConnection::Connect(const ViewerAddress& address, const GivesUp& givesUp) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int failure = getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &list);
  if (failure != 0) return gai_strerror(failure);
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(list, freeaddrinfo);
  const auto end = std::chrono::steady_clock::now() + kConnectTime;
  const GivesUp isLate = [&] { return givesUp() || std::chrono::steady_clock::now() > end; };
  std::string reason = "no address";
  for (const addrinfo* each = list; each; each = each->ai_next) {
    Descriptor socket(::socket(each->ai_family, each->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                               each->ai_protocol));
    if (!socket.IsOpen()) continue;
    int error = connect(socket.Get(), each->ai_addr, each->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
      reason = WaitUntilWritable(socket.Get(), isLate);
      if (!reason.empty()) continue;
      socklen_t size = sizeof error;
      getsockopt(socket.Get(), SOL_SOCKET, SO_ERROR, &error, &size);
    }
    reason = error == 0 ? "" : std::strerror(error);
    if (error != 0) continue;
    socket_ = socket.Release();
    return "";
  }
  return reason;
}

std::string ViewerConnection::Send(const std::string& bytes, const GivesUp& givesUp) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count >= 0) {
      done += std::size_t(count);
      continue;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) return std::strerror(errno);
    const std::string reason = WaitUntilWritable(socket_, givesUp);
    if (!reason.empty()) return reason;
  }
  return "";
}

ViewerConnection::~ViewerConnection() {
  if (socket_ >= 0) close(socket_);
}

}  // namespace exphoton::cli
