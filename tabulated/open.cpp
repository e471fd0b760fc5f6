// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/open.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "brdf/error.hpp"
#include "tabulated/alta.hpp"
#include "tabulated/brdf_exr.hpp"
#include "tabulated/csv.hpp"
#include "tabulated/fit_json.hpp"
#include "tabulated/merl.hpp"
#include "tabulated/rgl.hpp"

namespace gonio::tabulated {
namespace {

/// Enough to recognise any format.
constexpr std::size_t head_size = 4096;

void write_samples_as_csv(const Opened& opened, const std::filesystem::path& path, const WriteOptions&) {
  if (!opened.dataset)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} without samples", opened.format), "samples to write as csv"});
  write_csv(*opened.dataset, path);
}

void write_samples_as_exr(const Opened& opened, const std::filesystem::path& path, const WriteOptions&) {
  if (!opened.dataset)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} without samples", opened.format), "samples to write as a table"});
  write_brdf_exr(tabulate(*opened.dataset), path);
}

void write_brdf_as_merl(const Opened& opened, const std::filesystem::path& path, const WriteOptions& options) {
  if (!opened.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", opened.format), "a model or a table"});
  write_merl(*opened.brdf, path, options, opened.format, opened.simulated);
}

std::string known_formats() {
  std::string out;
  for (const Format& format : formats()) out += (out.empty() ? "" : ", ") + std::string(format.name);
  return out;
}

std::string head_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(head_size, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!file && !file.eof()) throw Error(ErrorKind::input, {path.string(), "a file that cannot be read", "a readable file"});
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

}  // namespace

const std::vector<Format>& formats() {
  // In the order of recognition: text comes last because anything readable could be it.
  static const std::vector<Format> list{
      {"merl", "90 x 90 x 180 half/difference table of red, green, blue (.binary)", recognises_merl, open_merl, write_brdf_as_merl},
      {"brdf-exr", "table of incident by outgoing directions as an OpenEXR file (.brdf.exr)", recognises_brdf_exr, open_brdf_exr,
       write_samples_as_exr},
      {"rgl", "material file of the RGL database, RGB or spectral (.bsdf, read only)", recognises_rgl, open_rgl, nullptr},
      {"fit-json", "the document of a fit, as the model it describes (read only)", recognises_fit_json, open_fit_json, nullptr},
      {"alta", "samples as text of the ALTA library, with its #DIM and #PARAM lines (read only)", recognises_alta, open_alta, nullptr},
      {"csv", "samples as text: theta_i_deg, phi_i_deg, theta_o_deg, phi_o_deg, values and uncertainties", recognises_csv, open_csv,
       write_samples_as_csv},
  };
  return list;
}

Opened open_brdf(const std::filesystem::path& path, const ReadOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw Error(ErrorKind::input, {path.string(), std::filesystem::exists(path, error) ? "something that is not a file" : "no such file",
                                   "a file that holds a BRDF"});
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw Error(ErrorKind::input, {path.string(), error.message(), "a readable file"});

  const std::vector<Format>& list = formats();
  if (options.format) {
    const auto named = std::find_if(list.begin(), list.end(), [&](const Format& format) { return *options.format == format.name; });
    if (named == list.end()) throw Error(ErrorKind::usage, {"--format", *options.format, "one of " + known_formats()});
    return named->open(path, options);
  }
  const std::string head = head_of(path);
  const auto found = std::find_if(list.begin(), list.end(), [&](const Format& format) { return format.recognises(head, size); });
  if (found == list.end())
    throw Error(ErrorKind::input, {path.string(), size == 0 ? "an empty file" : fmt::format("{} bytes of an unknown kind", size),
                                   "one of " + known_formats()});
  return found->open(path, options);
}

}  // namespace gonio::tabulated
