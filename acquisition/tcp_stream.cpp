// SPDX-License-Identifier: BSD-3-Clause
// A non-blocking POSIX socket, waited for with poll().
#include "acquisition/tcp_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "brdf/error.hpp"

namespace gonio::acquisition {
namespace {

using Steady = std::chrono::steady_clock;
constexpr std::size_t longest_line = 65536;

Steady::time_point deadline_after(double timeout_s) {
  return Steady::now() + std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(timeout_s));
}

/// False if the deadline passed first.
bool wait_for(int socket, short events, Steady::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Steady::now()).count();
    pollfd p{socket, events, 0};
    const int ready = poll(&p, 1, left > 0 ? static_cast<int>(left) : 0);
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

}  // namespace

TcpStream::TcpStream(const Endpoint& endpoint, double timeout_s) : peer_(fmt::format("{}:{}", endpoint.host, endpoint.port)) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (const int code = getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(), &hints, &found); code != 0) {
    fail(gai_strerror(code), "a host that can be found");
  }
  const auto deadline = deadline_after(timeout_s);
  int error = ECONNREFUSED;
  for (const addrinfo* a = found; a != nullptr && socket_ < 0; a = a->ai_next) {
    const int s = socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol);
    if (s < 0) {
      error = errno;
      continue;
    }
    error = connect(s, a->ai_addr, a->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
      socklen_t size = sizeof error;
      if (!wait_for(s, POLLOUT, deadline)) {
        error = ETIMEDOUT;
      } else if (getsockopt(s, SOL_SOCKET, SO_ERROR, &error, &size) != 0) {
        error = errno;
      }
    }
    if (error == 0) {
      socket_ = s;
    } else {
      close(s);
    }
  }
  freeaddrinfo(found);
  if (socket_ < 0) fail(std::strerror(error), "a TCP server that answers");
  const int on = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

TcpStream::~TcpStream() {
  if (socket_ >= 0) close(socket_);
}

void TcpStream::fail(const std::string& found, const std::string& wanted) const {
  throw Error(ErrorKind::device, Fault{peer_, found, wanted});
}

void TcpStream::send_line(std::string_view text, double timeout_s) {
  const auto deadline = deadline_after(timeout_s);
  const std::string line = std::string(text) + '\n';
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t n = send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN || errno == EINTR) {
      if (!wait_for(socket_, POLLOUT, deadline))
        fail(fmt::format("no room to send '{}' within {} s", text, timeout_s), "a peer that reads");
    } else {
      fail(fmt::format("{} on sending '{}'", std::strerror(errno), text), "an open connection");
    }
  }
}

std::string TcpStream::receive_line(double timeout_s) {
  const auto deadline = deadline_after(timeout_s);
  for (;;) {
    if (const auto end = received_.find('\n'); end != std::string::npos) {
      std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
    if (received_.size() > longest_line) fail(fmt::format("{} bytes without a line end", received_.size()), "a line of text");
    std::array<char, 4096> buffer{};
    const ssize_t n = recv(socket_, buffer.data(), buffer.size(), 0);
    if (n > 0) {
      received_.append(buffer.data(), static_cast<std::size_t>(n));
    } else if (n == 0) {
      fail("the connection was closed", "an answer");
    } else if (errno == EAGAIN || errno == EINTR) {
      if (!wait_for(socket_, POLLIN, deadline)) fail(fmt::format("no answer within {} s", timeout_s), "an answer");
    } else {
      fail(std::strerror(errno), "an answer");
    }
  }
}

}  // namespace gonio::acquisition
