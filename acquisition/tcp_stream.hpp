// SPDX-License-Identifier: BSD-3-Clause
// A TCP connection that carries lines of text, with deadlines on the steady clock.
#pragma once

#include <string>
#include <string_view>

#include "acquisition/bench.hpp"

namespace gonio::acquisition {

/// Owns one socket. Every failure is an Error(device) naming host:port. After a failure in the middle of an answer the stream is out of
/// step and has to be opened anew.
class TcpStream {
 public:
  TcpStream(const Endpoint& endpoint, double timeout_s);
  ~TcpStream();
  TcpStream(const TcpStream&) = delete;
  TcpStream& operator=(const TcpStream&) = delete;

  /// Sends the text and a line feed.
  void send_line(std::string_view text, double timeout_s);
  /// The next line without its end (LF or CR LF); at most 64 KiB.
  std::string receive_line(double timeout_s);
  const std::string& peer() const { return peer_; }  ///< "host:port"

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& wanted) const;

  std::string peer_, received_;
  int socket_ = -1;
};

}  // namespace gonio::acquisition
