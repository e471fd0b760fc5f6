// SPDX-License-Identifier: BSD-3-Clause
// gonio compare: how two BRDFs differ.
#include "fitting/compare.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "data-schemas/document.hpp"
#include "fitting/difference_image.hpp"
#include "tools/brdf_source.hpp"
#include "tools/compare_document.hpp"
#include "tools/difference_picture.hpp"
#include "tools/measured_table.hpp"
#include "tools/verbs.hpp"

namespace gonio::tools {
namespace {

namespace fs = std::filesystem;

constexpr int threads = 2;  // for the table of samples

/// The files to write, from --out and --image.
struct Outputs {
  std::string document, png, exr;
};

Outputs outputs_of(const std::string& folder, const std::string& image) {
  Outputs out;
  if (!folder.empty()) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed || !fs::is_directory(folder))
      throw Error(ErrorKind::input, {"--out " + folder, "no folder and none can be made", "a folder"});
    out.document = (fs::path(folder) / "compare.json").string();
    out.png = (fs::path(folder) / "difference.png").string();
    out.exr = (fs::path(folder) / "difference.exr").string();
  }
  if (image.empty()) return out;
  const std::string extension = fs::path(image).extension();
  if (extension != ".png" && extension != ".exr")
    throw Error(ErrorKind::usage, {"--image", "'" + image + "'", "a name ending in .png or .exr"});
  (extension == ".png" ? out.png : out.exr) = image;
  return out;
}

Channels channels_of(const fitting::ComparedValues& values, const Channels& a, const Channels& b) {
  Channels out;
  for (const fitting::ComparedChannel& channel : values.channels)
    out.push_back(a[channel.a].name == channel.name ? a[channel.a] : b[channel.b]);
  return out;
}

}  // namespace

int compare_verb(const Arguments& arguments, Console& console) {
  CLI::App app(
      "Compares two BRDFs under every metric, says where they differ most, by incidence and against their uncertainties. Sets of samples\n"
      "are compared where both were measured, else the samples of one against the other; models and tables over all directions.",
      "compare");
  std::string a, b, folder, image;
  std::vector<std::string> parameters_a, parameters_b;
  double theta_max_deg = fitting::compared_up_to_deg;
  bool nearest = false;
  ReadFlags flags;
  app.add_option("A", a, "A model's name or any BRDF file: the reference")->required();
  app.add_option("B", b, "A model's name or any BRDF file")->required();
  app.add_option("--param-a", parameters_a, "NAME=VALUE of model A")->take_all();
  app.add_option("--param-b", parameters_b, "NAME=VALUE of model B")->take_all();
  app.add_option("--theta-max", theta_max_deg, "Models and tables: both zenith angles up to this, degrees (default 80)")
      ->check(CLI::Range(1.0, 90.0));
  app.add_option("--out", folder, "Folder for compare.json, difference.png and difference.exr");
  app.add_option("--image", image, "The relative difference as NAME.png or NAME.exr");
  app.add_flag("--nearest", nearest, "Between samples the mean of the nearest ones by distance instead of their ratio to a guide");
  flags.add_to(app);
  add_common(app, console);
  if (!parse(app, arguments)) return 0;
  const Outputs outputs = outputs_of(folder, image);

  tabulated::Opened opened_a = open_source(a, parameters_a, flags), opened_b = open_source(b, parameters_b, flags);
  std::vector<HashedInput> inputs;
  for (const auto& [source, opened] : {std::pair(&a, &opened_a), std::pair(&b, &opened_b)}) {
    if (opened->format != "model") inputs.push_back(hash_in_background(*source));
    console.note_masked(*source, opened->masked);
    if (!opened->brdf && !opened->dataset) throw Error(ErrorKind::input, {*source, opened->format + " that cannot be evaluated", "a BRDF"});
  }
  const Angle theta_max = degrees(theta_max_deg);
  fitting::ComparedValues values =
      fitting::compared_values({opened_a.brdf, opened_a.dataset}, {opened_b.brdf, opened_b.dataset}, theta_max);
  // Samples of one side that were asked for values between them.
  const bool asked_a = values.at == fitting::ComparedAt::samples_of_b && is_scattered(opened_a);
  const bool asked_b = values.at == fitting::ComparedAt::samples_of_a && is_scattered(opened_b);
  if (!nearest && (asked_a || asked_b)) {
    TableReport table;
    tabulated::Opened& asked = asked_a ? opened_a : opened_b;
    asked = measured_table(asked, {}, threads, table);
    console.note(fmt::format("{}: {}", asked_a ? a : b, interpolation_line(table)));
    if (const std::string warning = coverage_warning(table); !warning.empty())
      console.note(fmt::format("{}: {}", asked_a ? a : b, warning));
    values = fitting::compared_values({opened_a.brdf, opened_a.dataset}, {opened_b.brdf, opened_b.dataset}, theta_max);
  }
  const fitting::CompareSubject subject_a{opened_a.brdf, opened_a.dataset}, subject_b{opened_b.brdf, opened_b.dataset};
  const fitting::Comparison comparison = fitting::compare(values);
  if (comparison.n == 0) throw Error(ErrorKind::input, {a + " and " + b, "no direction at which both are known", "at least one"});

  std::vector<std::string> images;
  if (!outputs.png.empty() || !outputs.exr.empty()) {
    const fitting::DifferenceImage picture = fitting::difference_image(subject_a, subject_b, values, difference_disc_size);
    const std::string title = fmt::format("2 (B - A)/(A + B), mean of the channels      A: {}      B: {}      ○ light   × mirror direction",
                                          fs::path(a).filename().string(), fs::path(b).filename().string());
    if (!outputs.png.empty()) draw_difference_png(picture, title, outputs.png), images.push_back(outputs.png);
    if (!outputs.exr.empty())
      write_difference_exr(picture, channels_of(values, subject_a.channels(), subject_b.channels()), outputs.exr),
          images.push_back(outputs.exr);
  }
  if (console.json || !outputs.document.empty()) {
    const Json document = compare_document({a, opened_a.format}, {b, opened_b.format}, values, comparison, theta_max, images,
                                           context(inputs, std::nullopt, opened_a.simulated || opened_b.simulated));
    if (!outputs.document.empty()) write_file_atomically(outputs.document, document.dump(2) + "\n");
    if (console.json) console.print_json(document);
  }
  if (!console.json) {
    for (const std::string& line : compare_lines(values, comparison, theta_max)) console.print(line);
    for (const std::string& written : images) console.print(written);
  }
  return 0;
}

}  // namespace gonio::tools
