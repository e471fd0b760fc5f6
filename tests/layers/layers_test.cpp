// SPDX-License-Identifier: BSD-3-Clause
// The dependency table, held against every #include of the tree: ours, and third parties'.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/check.hpp"

namespace fs = std::filesystem;

namespace {

/// What a folder may include. `sources` are third parties allowed in .cpp files (by the start of the header's path); no third party
/// may stand in a header at all, except in tests. A folder inherits nothing from its parent.
struct Layer {
  std::set<std::string> folders;
  std::vector<std::string> sources;
};

/// The table of docs/decisions/0001. fmt is allowed in every source file.
const std::map<std::string, Layer>& table() {
  static const std::map<std::string, Layer> layers{
      {"brdf", {{}, {"Eigen/"}}},
      {"data-schemas", {{"brdf"}, {"nlohmann/", "valijson/", "nettle/"}}},
      {"tabulated", {{"brdf", "data-schemas"}, {"OpenEXR/", "Imf", "Imath", "Iex", "half.h", "pugixml"}}},
      {"fitting", {{"brdf"}, {"ceres/", "Eigen/"}}},
      {"scene", {{"brdf", "data-schemas"}, {"embree", "tiny_obj_loader", "OpenEXR/", "Imf", "Imath", "png.h"}}},
      {"acquisition", {{"brdf", "data-schemas", "acquisition/modbus"}, {"sqlite3.h"}}},
      {"acquisition/modbus", {{"acquisition", "brdf", "data-schemas"}, {"modbus"}}},
      {"acquisition/usb", {{"acquisition", "brdf", "data-schemas"}, {"libusb"}}},
      {"acquisition/camera", {{"acquisition", "brdf", "data-schemas"}, {"opencv2/"}}},
      {"acquisition/simulated", {{"acquisition", "acquisition/modbus", "scene", "brdf", "data-schemas"}, {"modbus"}}},
      {"tools",
       {{"brdf", "data-schemas", "tabulated", "fitting", "scene", "acquisition", "acquisition/modbus", "acquisition/simulated"},
        {"CLI/", "png.h"}}},
  };
  return layers;
}

bool is_header(const std::string& file) { return file.ends_with(".hpp") || file.ends_with(".h"); }

/// The layer a path belongs to: its longest prefix in the table, or "tests", or "" if it is ours but in no layer.
std::string layer_of(const std::string& path) {
  if (path.starts_with("tests/")) return "tests";
  std::string best;
  for (const auto& [folder, layer] : table())
    if (path.starts_with(folder + "/") && folder.size() > best.size()) best = folder;
  return best;
}

struct Include {
  std::string name;
  bool quoted;
};

std::vector<Include> includes(const std::string& text) {
  std::vector<Include> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') continue;
    const auto word = line.find("include", hash);
    if (word == std::string::npos) continue;
    const auto open = line.find_first_of("<\"", word);
    if (open == std::string::npos) continue;
    const bool quoted = line[open] == '"';
    const auto close = line.find(quoted ? '"' : '>', open + 1);
    if (close != std::string::npos) out.push_back({line.substr(open + 1, close - open - 1), quoted});
  }
  return out;
}

/// C++, POSIX and glibc headers: no slash and no extension, or a C/POSIX name.
bool is_standard(const std::string& name) {
  static const std::set<std::string> posix{"unistd.h",       "fcntl.h",     "netdb.h",      "poll.h",        "pthread.h",
                                           "signal.h",       "immintrin.h", "netinet/in.h", "sys/mman.h",    "sys/stat.h",
                                           "sys/socket.h",   "sys/wait.h",  "arpa/inet.h",  "netinet/tcp.h", "sys/types.h",
                                           "sys/resource.h", "sys/ioctl.h", "sys/time.h",   "sys/file.h",    "termios.h",
                                           "sys/prctl.h",    "sys/uio.h",   "spawn.h",      "malloc.h",      "math.h"};
  return posix.contains(name) || name.find_first_of("./") == std::string::npos;
}

/// Everything wrong with the includes of one file.
std::vector<std::string> faults(const std::string& path, const std::string& text) {
  std::vector<std::string> out;
  const std::string layer = layer_of(path);
  const auto list = includes(text);
  if (layer.empty()) return {path + ": lies in no folder of the table"};
  if (layer == "tests") {
    const bool is_test = text.find("TEST_CASE") != std::string::npos;
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (list[k].name.starts_with("catch2/") && path != "tests/check.hpp") out.push_back(path + ": includes Catch2 past tests/check.hpp");
      if (list[k].name == "tests/check.hpp" && k + 1 != list.size()) out.push_back(path + ": tests/check.hpp is not the last include");
    }
    if (is_test && path != "tests/check.hpp" &&
        std::none_of(list.begin(), list.end(), [](const Include& i) { return i.name == "tests/check.hpp"; }))
      out.push_back(path + ": a test without tests/check.hpp");
    return out;
  }
  const Layer& allowed = table().at(layer);
  for (const Include& include : list) {
    if (include.quoted) {
      const std::string other = layer_of(include.name);
      if (other == "tests" || (other.empty() && !include.name.starts_with("generated/")))
        out.push_back(path + ": includes \"" + include.name + "\", which is no folder of the product");
      else if (!other.empty() && other != layer && !allowed.folders.contains(other))
        out.push_back(path + ": " + layer + " may not include " + other + " (\"" + include.name + "\")");
      continue;
    }
    if (is_standard(include.name)) continue;
    const bool third_party =
        include.name.starts_with("fmt/") || std::any_of(allowed.sources.begin(), allowed.sources.end(),
                                                        [&](const std::string& start) { return include.name.starts_with(start); });
    if (!third_party) out.push_back(path + ": " + layer + " may not include <" + include.name + ">");
    if (third_party && is_header(path)) out.push_back(path + ": <" + include.name + "> stands in a header");
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> tree() {
  std::vector<std::pair<std::string, std::string>> out;
  const fs::path root = GONIO_SOURCE_DIR;
  std::vector<std::string> folders{"brdf", "data-schemas", "tabulated", "fitting", "scene", "acquisition", "tools", "tests"};
  for (const auto& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".h" && extension != ".c") continue;
      std::ifstream file(entry.path());
      std::stringstream text;
      text << file.rdbuf();
      out.emplace_back(fs::relative(entry.path(), root).generic_string(), text.str());
    }
  }
  return out;
}

}  // namespace

TEST_CASE("every include is allowed by the dependency table") {
  const auto files = tree();
  CHECK(files.size() > 60);
  for (const auto& [path, text] : files)
    for (const std::string& fault : faults(path, text)) FAIL_CHECK(fault);
}

TEST_CASE("every source file starts with its licence and the top level holds only known folders") {
  for (const auto& [path, text] : tree()) {
    INFO(path);
    CHECK(text.starts_with("// SPDX-License-Identifier: BSD-3-Clause\n"));
  }
  const std::set<std::string> known{"brdf",        "data-schemas", "tabulated", "fitting", "scene",
                                    "acquisition", "tools",        "tests",     "docs",    "cmake"};
  for (const auto& entry : fs::directory_iterator(GONIO_SOURCE_DIR)) {
    const std::string name = entry.path().filename();
    if (!entry.is_directory() || name.starts_with(".") || name.starts_with("build") || name == "b" ||
        entry.path() == fs::path(GONIO_BINARY_DIR))
      continue;
    INFO(name);
    // Results of a demo or a build tree may lie beside the sources; a folder with sources of its own has to be in the table.
    const auto has_source = [](const fs::path& folder) {
      return std::any_of(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator(), [](const fs::directory_entry& file) {
        return file.path().extension() == ".cpp" || file.path().extension() == ".hpp";
      });
    };
    CHECK((known.contains(name) || fs::exists(entry.path() / "CMakeCache.txt") || !has_source(entry.path())));
  }
}

TEST_CASE("the layer test sees a wrong include") {
  CHECK(faults("brdf/x.cpp", "#include \"tabulated/open.hpp\"\n").size() == 1);
  CHECK(faults("fitting/x.cpp", "#include \"data-schemas/json.hpp\"\n").size() == 1);
  CHECK(faults("fitting/x.cpp", "#include <ceres/ceres.h>\n").empty());
  CHECK(faults("fitting/x.hpp", "#include <ceres/ceres.h>\n").size() == 1);
  CHECK(faults("fitting/x.cpp", "  # include <opencv2/core.hpp>\n").size() == 1);
  CHECK(faults("acquisition/sweep.cpp", "#include \"acquisition/simulated/simulated_bench.hpp\"\n").size() == 1);
  CHECK(faults("acquisition/sweep.cpp", "#include <modbus/modbus.h>\n").size() == 1);
  CHECK(faults("tools/demo.cpp", "#include \"acquisition/simulated/simulated_bench.hpp\"\n").empty());
  CHECK(faults("brdf/x.hpp", "#include <vector>\n#include <fmt/format.h>\n").size() == 1);
  CHECK(faults("tests/x_test.cpp", "#include \"tests/check.hpp\"\n#include <vector>\nTEST_CASE(\"a\"){}").size() == 1);
  CHECK(faults("tests/x_test.cpp", "#include <catch2/catch.hpp>\nTEST_CASE(\"a\"){}").size() == 2);
  CHECK(faults("elsewhere/x.cpp", "#include <vector>\n").size() == 1);
}
