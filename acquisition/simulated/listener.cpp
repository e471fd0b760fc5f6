// SPDX-License-Identifier: BSD-3-Clause
// Binding, accepting and ending of TCP connections.
#include "acquisition/simulated/listener.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "brdf/error.hpp"

namespace gonio::acquisition::simulated {

Listener::Listener(const Endpoint& endpoint, std::function<void(int)> serve) : serve_(std::move(serve)) {
  const auto refuse = [&](const std::string& found) {
    if (socket_ >= 0) close(socket_);
    throw Error(ErrorKind::device, Fault{fmt::format("{}:{}", endpoint.host, endpoint.port), found, "a free port to listen on"});
  };
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(endpoint.port));
  const std::string host = endpoint.host == "localhost" ? "127.0.0.1" : endpoint.host;
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) refuse("not an IPv4 address");
  socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0) refuse(std::strerror(errno));
  const int on = 1;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof address;
  if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(socket_, SOMAXCONN) != 0 ||
      getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    refuse(std::strerror(errno));
  }
  port_ = ntohs(address.sin_port);
  acceptor_ = std::thread([this] { accept_all(); });
}

Listener::~Listener() { stop(); }

void Listener::accept_all() {
  for (;;) {
    const int s = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (s >= 0) {
      const int on = 1;
      setsockopt(s, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      add(s);
    } else if (errno != EINTR && errno != ECONNABORTED) {
      return;  // shut down
    }
  }
}

void Listener::add(int s) {
  const std::lock_guard lock(mutex_);
  std::erase_if(connections_, [](const auto& c) {
    if (c->done) c->thread.join();
    return c->done;
  });
  if (stopping_) {
    close(s);
    return;
  }
  Connection& c = *connections_.emplace_back(std::make_unique<Connection>(s));
  c.thread = std::thread([this, &c] {
    serve_(c.socket);
    const std::lock_guard closing(mutex_);
    close(c.socket);
    c.socket = -1;
    c.done = true;
  });
}

void Listener::stop() noexcept {
  std::vector<std::unique_ptr<Connection>> ending;
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    stopping_ = true;
    ::shutdown(socket_, SHUT_RDWR);
    for (const auto& c : connections_) {
      if (c->socket >= 0) ::shutdown(c->socket, SHUT_RDWR);
    }
    ending.swap(connections_);
  }
  acceptor_.join();
  for (const auto& c : ending) c->thread.join();
  close(socket_);
}

}  // namespace gonio::acquisition::simulated
