// SPDX-License-Identifier: BSD-3-Clause
// Reading documents, and the context block.
#include "data-schemas/document.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace gonio {

std::string read_file(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& found) { throw Error(ErrorKind::input, {path.string(), found, "a readable file"}); };
  std::error_code ignored;  // what cannot be looked at cannot be opened either, and that tells why
  if (std::filesystem::is_directory(path, ignored)) fail("a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(std::generic_category().message(errno));
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  std::string bytes(ignored ? 0 : static_cast<std::size_t>(size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  bytes.append(std::istreambuf_iterator<char>(file), {});  // a pipe has no size, a file may have grown
  if (file.bad()) fail(std::generic_category().message(errno));
  return bytes;
}

Json load_document(const std::filesystem::path& path, Schema schema) {
  const std::string source = path.string();
  Json document = parse_json(read_file(path), source);
  std::vector<Fault> faults = faults_of(document, schema, source);
  if (!faults.empty()) throw Error(ErrorKind::input, source + " is no valid " + name(schema) + " document", std::move(faults));
  return document;
}

Json context(const std::vector<HashedInput>& inputs, std::optional<std::uint64_t> seed, bool simulated) {
  Json list = Json::array();
  for (const HashedInput& input : inputs) list.push_back(Json::object({{"path", input.path}, {"sha256", input.sha256.get()}}));
  return Json::object({{"program", "gonio"},
                       {"version", GONIO_VERSION},
                       {"build_type", GONIO_BUILD_TYPE},
                       {"inputs", std::move(list)},
                       {"seed", seed ? Json(*seed) : Json()},
                       {"simulated", simulated}});
}

}  // namespace gonio
