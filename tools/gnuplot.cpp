// SPDX-License-Identifier: BSD-3-Clause
#include "tools/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <system_error>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"

namespace gonio::tools {
namespace {

/// Runs `gnuplot script`, silently; whether it ended well.
bool run_gnuplot(const std::filesystem::path& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot", file = script.string();
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = -1;
  return failed == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

void draw_with_gnuplot(const std::filesystem::path& picture,
                       const std::function<std::string(const std::filesystem::path& output)>& script) {
  std::filesystem::path output = picture, text = picture;
  output += ".part";
  text += ".gnuplot";
  write_file_atomically(text, script(output));
  const bool drawn = run_gnuplot(text);
  std::error_code ignored;
  std::filesystem::remove(text, ignored);
  if (!drawn || !std::filesystem::exists(output, ignored)) {
    std::filesystem::remove(output, ignored);
    throw Error(ErrorKind::input,
                {picture.string(), "gnuplot did not draw it", "the program gnuplot (package gnuplot-nox, installed by tools/setup)"});
  }
  std::filesystem::rename(output, picture);
}

}  // namespace gonio::tools
