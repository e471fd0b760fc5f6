// SPDX-License-Identifier: BSD-3-Clause
// A man in the middle of a Modbus TCP connection, who may lie, be late, refuse or hang up.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "acquisition/simulated/listener.hpp"

namespace gonio::acquisition::test {

using Frame = std::vector<std::uint8_t>;

/// Fields of a request or an answer (MBAP header of 7 bytes, then the PDU).
inline int unit_of(const Frame& f) { return f[6]; }
inline int function_of(const Frame& f) { return f[7]; }
inline int address_of(const Frame& f) { return f[8] << 8 | f[9]; }
/// A register in the answer to function 3.
inline std::uint16_t answered(const Frame& f, int index) {
  const auto k = static_cast<std::size_t>(9 + 2 * index);
  return static_cast<std::uint16_t>(f[k] << 8 | f[k + 1]);
}
inline void set_answered(Frame& f, int index, int value) {
  const auto k = static_cast<std::size_t>(9 + 2 * index);
  f[k] = static_cast<std::uint8_t>(value >> 8);
  f[k + 1] = static_cast<std::uint8_t>(value);
}
inline Frame exception_to(const Frame& request, int code) {
  return {request[0], request[1], 0, 0, 0, 3, request[6], static_cast<std::uint8_t>(request[7] | 0x80), static_cast<std::uint8_t>(code)};
}

/// Sits between a client and the server on `target_port` and asks `behave` about every request: the answer to send (an empty frame
/// stays silent), or none to hang up. `forward` passes a request on to the server and gives its answer.
class ModbusProxy {
 public:
  using Forward = std::function<Frame(const Frame&)>;
  using Behaviour = std::function<std::optional<Frame>(const Frame& request, const Forward& forward)>;

  explicit ModbusProxy(int target_port) : target_port_(target_port), listener_({"127.0.0.1", 0}, [this](int client) { serve(client); }) {}
  int port() const { return listener_.port(); }

  void behave(Behaviour behaviour) {
    const std::lock_guard lock(mutex_);
    behaviour_ = std::move(behaviour);
  }
  void behave_well() { behave(nullptr); }

 private:
  static bool receive(int socket, std::uint8_t* bytes, std::size_t count) {
    return recv(socket, bytes, count, MSG_WAITALL) == static_cast<ssize_t>(count);
  }
  static Frame receive_frame(int socket) {
    Frame f(6);
    if (!receive(socket, f.data(), 6)) return {};
    const auto rest = static_cast<std::size_t>(f[4] << 8 | f[5]);
    f.resize(6 + rest);
    if (!receive(socket, f.data() + 6, rest)) return {};
    return f;
  }
  static bool send_frame(int socket, const Frame& f) {
    return send(socket, f.data(), f.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(f.size());
  }

  void serve(int client) {
    const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(target_port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const Forward forward = [server](const Frame& request) { return send_frame(server, request) ? receive_frame(server) : Frame{}; };
    if (connect(server, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
      for (Frame request = receive_frame(client); !request.empty(); request = receive_frame(client)) {
        std::optional<Frame> answer;
        {
          const std::lock_guard lock(mutex_);
          answer = behaviour_ ? behaviour_(request, forward) : forward(request);
        }
        if (!answer || !send_frame(client, *answer)) break;
      }
    }
    close(server);
  }

  int target_port_;
  std::mutex mutex_;
  Behaviour behaviour_;
  simulated::Listener listener_;  // last: its threads use everything above
};

}  // namespace gonio::acquisition::test
