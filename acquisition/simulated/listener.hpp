// SPDX-License-Identifier: BSD-3-Clause
// A loopback TCP server: accepts connections and runs each on a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "acquisition/bench.hpp"

namespace gonio::acquisition::simulated {

/// `serve(socket)` runs once per connection and returns when the peer is gone; the listener closes the socket.
class Listener {
 public:
  /// Port 0: any free one. Error(device) naming host and port if it cannot be bound.
  Listener(const Endpoint& endpoint, std::function<void(int socket)> serve);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return port_; }
  /// Ends every connection and joins every thread.
  void stop() noexcept;

 private:
  struct Connection {
    explicit Connection(int accepted) : socket(accepted) {}
    int socket;
    bool done = false;
    std::thread thread;
  };
  void accept_all();
  void add(int socket);

  std::function<void(int)> serve_;
  int socket_ = -1, port_ = 0;
  std::mutex mutex_;
  bool stopping_ = false;
  std::vector<std::unique_ptr<Connection>> connections_;
  std::thread acceptor_;
};

}  // namespace gonio::acquisition::simulated
