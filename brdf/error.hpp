// SPDX-License-Identifier: BSD-3-Clause
// The one exception type of gonio: what kind of failure it is and every fault that was found.
#pragma once

#include <exception>
#include <string>
#include <vector>

namespace gonio {

/// What went wrong, as the caller has to treat it. The command line maps each kind to one exit code (docs/conventions.md).
enum class ErrorKind { usage, input, limit, device, interrupted, internal };

/// One thing that is wrong: where it stands (file, line, JSON pointer, device), what stands there, what was wanted.
struct Fault {
  std::string where;
  std::string found;
  std::string wanted;
};

/// A failure that ends the operation. A reader collects *all* faults of a file before it throws.
/// Numerical outcomes ("not converged", "not identifiable") are results and never an Error.
class Error : public std::exception {
 public:
  Error(ErrorKind kind, std::string message, std::vector<Fault> faults = {});
  /// The common case of a single fault; the message is made from it.
  Error(ErrorKind kind, Fault fault);

  ErrorKind kind() const noexcept { return kind_; }
  /// One sentence, without the faults.
  const std::string& message() const noexcept { return message_; }
  const std::vector<Fault>& faults() const noexcept { return faults_; }
  /// Message and every fault, one per line.
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  ErrorKind kind_;
  std::string message_;
  std::vector<Fault> faults_;
  std::string what_;
};

/// `usage`, `input`, `limit`, `device`, `interrupted` or `internal`.
const char* name(ErrorKind kind) noexcept;

}  // namespace gonio
