// SPDX-License-Identifier: BSD-3-Clause
// Running the gonio program as a user does, in a folder of its own.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "data-schemas/json.hpp"
#include "tests/temporary_folder.hpp"

namespace gonio::test {

struct Outcome {
  int code = -1;
  std::string out, err;
  Json json() const { return parse_json(out, "standard output"); }
};

/// `gonio ARGUMENTS` by the shell, standard input from `in`.
inline Outcome run_gonio(const std::string& arguments, const std::string& in = "") {
  const TemporaryFolder folder;
  write_file(folder / "in", in);
  const auto quoted = [&](const char* name) { return " '" + (folder / name).string() + "'"; };
  const std::string command =
      std::string("'") + GONIO_BINARY + "' " + arguments + " <" + quoted("in") + " >" + quoted("out") + " 2>" + quoted("err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(folder / "out"), read_file(folder / "err")};
}

}  // namespace gonio::test
