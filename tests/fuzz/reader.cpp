// SPDX-License-Identifier: BSD-3-Clause
// A libFuzzer target for every reader: `fuzz_reader --format=NAME [libFuzzer's options] CORPUS`; `fuzz_reader --list` names them all.
//
// What must hold for any bytes: the reader gives a BRDF or throws Error of kind input (usage, if it wants an --assume) with a fault that
// says where, what was found and what was wanted; what it gives can be described, observed and evaluated, and no value is infinite.
#include <sys/mman.h>
#include <unistd.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/error.hpp"
#include "tabulated/formats/merl.hpp"
#include "tabulated/formats/utia.hpp"
#include "tabulated/open.hpp"

namespace {

using namespace gonio;
using namespace gonio::tabulated;

const Format* fuzzed = nullptr;

[[noreturn]] void broken(const char* law) {
  std::fprintf(stderr, "a law is broken: %s\n", law);
  std::abort();
}

/// The bytes as a file that has no name and goes away with its descriptor.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("input", MFD_CLOEXEC)) {
    if (descriptor_ < 0) broken("memfd_create works here");
    for (std::size_t done = 0; done < size;) {
      const ssize_t n = write(descriptor_, data + done, size - done);
      if (n <= 0) broken("a file in memory can be written");
      done += static_cast<std::size_t>(n);
    }
    // Some readers look at nothing but files of one size: the rest is zeros.
    const std::string_view format = fuzzed->name;
    const std::uintmax_t only_size = format == "merl" ? merl_file_size : format == "utia" ? utia_file_size : size;
    if (only_size != size && ftruncate(descriptor_, static_cast<off_t>(only_size)) != 0) broken("a file in memory can grow");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

/// Answers to what a reader may ask, so that the fuzzer gets past the questions; every fourth file goes without.
void assume_something(ReadOptions& options, std::uint8_t which) {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> answers{
      {"blocked", {"mask", "keep"}},
      {"coverage_factor", {"1", "2"}},
      {"data_type", {"brdf", "btdf"}},
      {"isotropic", {"no", "yes"}},
      {"kind", {"reflection", "transmission"}},
      {"nodes", {"centre", "left"}},
      {"part", {"reflection", "transmission"}},
      {"phi_d_deg", {"90", "0"}},
      {"rotation", {"counter-clockwise", "clockwise"}},
      {"scale", {"stored", "percentage"}},
      {"scatter", {"BRDF", "BTDF"}},
      {"side", {"front", "back", "reflection", "transmission"}},
      {"specular", {"0", "pi"}},
      {"specular_azimuth_deg", {"0", "180"}},
      {"theta_d_deg", {"0", "30"}},
      {"values", {"f", "display"}},
      {"wavelength", {"Visible", "CIE-Y"}},
      {"wavelength_nm", {"550", "650"}},
      {"white", {"1", "0.98"}},
      {"zero_azimuth", {"across", "fixed"}},
  };
  if (which % 4 == 3) return;
  for (const auto& [key, values] : answers)
    for (const char* known : fuzzed->assumptions)
      if (key == known) options.assume[key] = values[which / 4 % values.size()];
}

void use(const Opened& opened) {
  for (const auto& [key, words] : opened.info)
    if (key.empty()) broken("what is said of a file has a key");
  if (!opened.dataset && !opened.brdf) broken("an opened file holds something");
  if (opened.dataset) opened.dataset->require_consistent();
  if (opened.observations)
    for (std::size_t k = 0; k < std::min<std::size_t>(2, opened.observations->block_count()); ++k) {
      const ObservationBlock block = opened.observations->block(k);
      for (const Column& column : block.f)
        for (std::size_t j = 0; j < block.size; ++j)
          if (block.valid(j) && std::isinf(column[j])) broken("no sample is infinite");
    }
  if (!opened.brdf) return;
  std::vector<Direction> wi, wo;
  for (const double theta : {0.0, 0.3, 1.2, 1.57})
    for (const double phi : {0.0, 2.0, -3.1}) {
      wi.push_back(Direction::trusted(std::sin(theta), 0, std::cos(theta)));
      wo.push_back(Direction::trusted(std::sin(0.9 * theta) * std::cos(phi), std::sin(0.9 * theta) * std::sin(phi), std::cos(0.9 * theta)));
    }
  std::vector<double> f(wi.size() * opened.brdf->channels().size());
  opened.brdf->eval(wi, wo, f);
  for (const double value : f)
    if (std::isinf(value)) broken("no value is infinite");
}

void list_readers() {
  for (const Format& format : formats())
    if (format.open) std::puts(format.name);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string_view flag = "--format=";
  for (int k = 1; k < *argc; ++k) {
    const std::string_view argument = (*argv)[k];
    if (argument == "--list") {
      list_readers();
      std::exit(0);
    }
    if (argument.starts_with(flag))
      for (const Format& format : formats())
        if (format.open && argument.substr(flag.size()) == format.name) fuzzed = &format;
  }
  if (!fuzzed) {
    std::fputs("fuzz_reader --format=NAME ...; --list names the readers\n", stderr);
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  ReadOptions options;
  options.format = fuzzed->name;
  assume_something(options, size > 0 ? data[size - 1] : 0);
  try {
    use(open_brdf(file.path(), options));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::usage) broken("a damaged file is an input error");
    if (error.faults().empty()) broken("an error names its faults");
    for (const Fault& fault : error.faults())
      if (!fault.where.ends_with("more faults") && (fault.where.empty() || fault.found.empty() || fault.wanted.empty()))
        broken("a fault says where, what was found and what was wanted");
  }
  return 0;
}
