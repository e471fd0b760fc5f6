// SPDX-License-Identifier: BSD-3-Clause
#include "tools/renderer_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "fitting/refit.hpp"
#include "tabulated/channel_map.hpp"
#include "tabulated/targets/target.hpp"

namespace gonio::tools {
namespace {

using tabulated::ExportNotes;
using tabulated::Opened;
namespace targets = tabulated::targets;

/// A source seen through a channel map.
class MappedBrdf final : public Brdf {
 public:
  MappedBrdf(std::shared_ptr<const Brdf> source, tabulated::ChannelMap map) : source_(std::move(source)), map_(std::move(map)) {}

  const Channels& channels() const override { return map_.to; }
  Symmetry symmetry() const override { return source_->symmetry(); }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override {
    const std::size_t from = source_->channels().size(), to = map_.to.size();
    std::vector<double> values(wi.size() * from);
    source_->eval(wi, wo, values);
    for (std::size_t k = 0; k < wi.size(); ++k) map_.apply(values.data() + k * from, f.data() + k * to);
  }

 private:
  std::shared_ptr<const Brdf> source_;
  tabulated::ChannelMap map_;
};

Dataset mapped(const Dataset& samples, const tabulated::ChannelMap& map) {
  Dataset out;
  out.channels = map.to, out.symmetry = samples.symmetry, out.angles = samples.angles;
  out.f.assign(map.to.size(), std::vector<double>(samples.size()));
  std::vector<double> in(samples.channels.size()), to(map.to.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    for (std::size_t c = 0; c < in.size(); ++c) in[c] = samples.f[c][k];
    map.apply(in.data(), to.data());
    for (std::size_t c = 0; c < to.size(); ++c) out.f[c][k] = to[c];
  }
  return out;
}

/// How the parameters of a model of ours are read as a diffuse part and a lobe, as a person does who copies them.
struct Reading {
  std::string_view model;
  /// From the parameters in table order; f0, f90, alpha_x, alpha_y.
  std::array<double, 4> (*lobe)(const double* p);
};

double width_of_exponent(double s) { return std::sqrt(2 / (s + 2)); }

const std::vector<Reading>& readings() {
  static const std::vector<Reading> list{
      {"lambert",
       [](const double*) {
         return std::array{0.0, 0.0, 0.5, 0.5};
       }},
      {"phong",
       [](const double* p) {
         return std::array{p[1], p[1], width_of_exponent(4 * p[2]), width_of_exponent(4 * p[2])};
       }},
      {"blinn-phong",
       [](const double* p) {
         return std::array{p[1], p[1], width_of_exponent(p[2]), width_of_exponent(p[2])};
       }},
      {"blinn-phong-exact",
       [](const double* p) {
         return std::array{p[1], p[1], width_of_exponent(p[2]), width_of_exponent(p[2])};
       }},
      {"blinn-phong-ngan",
       [](const double* p) {
         return std::array{p[1], p[1], width_of_exponent(p[2]), width_of_exponent(p[2])};
       }},
      {"ward",
       [](const double* p) {
         return std::array{p[1], p[1], p[2], p[2]};
       }},
      {"ward-anisotropic",
       [](const double* p) {
         return std::array{p[1], p[1], p[2], p[3]};
       }},
      {"ward-duer-gm",
       [](const double* p) {
         return std::array{p[1], p[1], p[2], p[2]};
       }},
      {"ward-duer-gm-anisotropic",
       [](const double* p) {
         return std::array{p[1], p[1], p[2], p[3]};
       }},
      {"cook-torrance",
       [](const double* p) {
         return std::array{p[1], p[2], p[3], p[3]};
       }},
      {"ggx",
       [](const double* p) {
         return std::array{p[1], p[2], p[3], p[3]};
       }},
      {"ggx-separable",
       [](const double* p) {
         return std::array{p[1], p[2], p[3], p[3]};
       }},
      {"ggx-fresnel",
       [](const double* p) {
         const double r = (p[3] - 1) / (p[3] + 1);
         return std::array{p[1] * r * r, p[1], p[2], p[2]};
       }},
      {"ggx-separable-fresnel",
       [](const double* p) {
         const double r = (p[3] - 1) / (p[3] + 1);
         return std::array{p[1] * r * r, p[1], p[2], p[2]};
       }},
  };
  return list;
}

/// The summary of a model of ours with three channels or one, or nothing.
std::optional<LobeSummary> read_summary(const Opened& opened, std::size_t channels) {
  const auto* model = dynamic_cast<const AnalyticBrdf*>(opened.brdf.get());
  if (!model || (model->values().size() != channels && model->values().size() != 1)) return std::nullopt;
  const auto reading = std::find_if(readings().begin(), readings().end(), [&](const Reading& r) { return r.model == model->model().name; });
  if (reading == readings().end()) return std::nullopt;
  LobeSummary out;
  double x = 1, y = 1;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::vector<double>& p = model->values()[std::min(c, model->values().size() - 1)];
    const auto [f0, f90, ax, ay] = reading->lobe(p.data());
    out.rho_d.push_back(p[0]), out.f0.push_back(f0), out.f90.push_back(f90);
    x *= ax, y *= ay;
  }
  out.alpha_x = std::pow(x, 1.0 / static_cast<double>(channels)), out.alpha_y = std::pow(y, 1.0 / static_cast<double>(channels));
  return out;
}

/// Text that can stand in a comment of every language: ASCII, on one line, and nothing that ends a comment.
std::string harmless(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> plain{
      {{"²", "^2"}, {"√", "sqrt "}, {"α", "alpha_"}, {"·", "*"}, {"--", "- -"}, {"*/", "* /"}}};
  for (const auto& [letters, words] : plain)
    for (std::size_t at = 0; (at = text.find(letters, at)) != std::string::npos; at += words.size())
      text.replace(at, letters.size(), words);
  for (char& letter : text)
    if (letter < 0x20 || letter > 0x7e) letter = '?';
  return text;
}

std::string errors_text(const fitting::RefitErrors& errors) {
  std::string out = fmt::format("misfit {:.4f}, log rms {:.4f}, mean relative {:.2f} %, rms of f cos {:.3g} 1/sr", errors.misfit,
                                errors.log_rms, 100 * errors.mean_relative, errors.rms_f_cos);
  if (errors.albedo_difference) out += fmt::format(", albedo {:+.4f}", *errors.albedo_difference);
  return out;
}

std::string parameter_text(const FormulaParameter& parameter, const ChannelValues& values, std::size_t p) {
  std::string out = targets::real(values[0][p]);
  if (parameter.per_channel)
    for (std::size_t c = 1; c < values.size(); ++c) out += " " + targets::real(values[c][p]);
  return out;
}

/// The misfit of every form, best first.
std::string rivals_text(const std::vector<std::pair<std::string_view, double>>& rivals) {
  std::string out;
  for (const auto& [name, error] : rivals) out += fmt::format("{}{} {:.4f}", out.empty() ? "" : ", ", name, error);
  return out;
}

/// What this source has and this formula has no parameter for.
std::vector<std::string> beyond(const Opened& opened, const fitting::RefitData& data, const TargetFormula& formula) {
  std::vector<std::string> out;
  if (const auto* model = dynamic_cast<const AnalyticBrdf*>(opened.brdf.get())) {
    const std::string name(model->model().name);
    const auto terms = 1 + std::count(name.begin(), name.end(), '+');
    if (terms > 1) out.push_back(fmt::format("the source, {}, is a sum of {} lobes: here stands one", name, terms));
    if (name.find("retro") != std::string::npos) out.push_back("the source reflects back to the light: no lobe of this material does");
  }
  const auto anisotropy = [](const FormulaParameter& p) { return p.if_isotropic.has_value(); };
  if (!data.isotropic && std::none_of(formula.parameters.begin(), formula.parameters.end(), anisotropy))
    out.push_back("the source is anisotropic, or not known to be isotropic: this material is isotropic");
  return out;
}

ExportNotes write_target(const targets::RenderTarget& target, const Opened& opened, const std::filesystem::path& path, bool with_scene) {
  if (!opened.brdf) throw Error(ErrorKind::input, {opened.format, "nothing that can be evaluated", "samples, a table or a model"});
  ExportNotes notes;
  const Channels& from = opened.brdf->channels();
  tabulated::ChannelMap map = tabulated::map_to_rgb(from);
  if (from.size() == 1) {
    map = {from, {1}, {}};
    notes.lost.push_back("one channel is written as red, green and blue: a grey material");
  }
  if (!map.changed.empty()) notes.lost.push_back(map.changed);
  const MappedBrdf source(opened.brdf, map);
  std::optional<Dataset> samples;
  if (opened.dataset) {
    if (opened.dataset->side != Side::reflection)
      throw Error(ErrorKind::input, {opened.format, "samples of transmission", "a reflection: none of these materials transmits"});
    samples = mapped(*opened.dataset, map);
  }
  const fitting::RefitData data = fitting::refit_data(source, samples ? &*samples : nullptr);
  const auto read = map.changed.empty() ? read_summary(opened, data.channel_count) : std::nullopt;
  const LobeSummary summary = read ? *read : fitting::fitted_summary(data, targets::reference_formula(), targets::reference_summary);

  const targets::Form* best = nullptr;
  fitting::Refit refit;
  std::vector<std::pair<std::string_view, double>> rivals;
  for (const targets::Form& form : target.forms) {
    fitting::Refit tried = fitting::refit(data, form.formula, summary);
    rivals.emplace_back(form.formula.name, tried.errors.misfit);
    if (!best || tried.errors.misfit < refit.errors.misfit) best = &form, refit = std::move(tried);
  }
  std::sort(rivals.begin(), rivals.end(), [](const auto& a, const auto& b) { return a.second < b.second; });

  const TargetFormula& formula = best->formula;
  notes.n_nodes = data.size();
  notes.facts = {
      {"material", std::string(formula.name)},       {"formula", std::string(formula.source)},
      {"roughness", std::string(formula.roughness)}, {"shadowing", std::string(formula.shadowing)},
      {"fresnel", std::string(formula.fresnel)},     {"compared at", data.at_samples ? "the samples" : "a grid of pairs up to 80 degrees"}};
  for (std::size_t p = 0; p < formula.parameters.size(); ++p)
    notes.facts.emplace_back(std::string(formula.parameters[p].name), parameter_text(formula.parameters[p], refit.values, p));
  notes.facts.emplace_back(read ? "naive conversion" : "naive (of a GGX fit)", errors_text(refit.naive_errors));
  notes.facts.emplace_back("after the refit", errors_text(refit.errors));
  if (rivals.size() > 1) notes.facts.emplace_back("misfit by material", rivals_text(rivals));
  for (std::string& sentence : beyond(opened, data, formula)) notes.lost.push_back(std::move(sentence));
  for (const std::size_t p : refit.at_bound)
    notes.lost.push_back(fmt::format("{} ended at a bound of the target, {} to {}", formula.parameters[p].name, formula.parameters[p].lower,
                                     formula.parameters[p].upper));
  for (const std::string_view sentence : formula.lacks) notes.lost.emplace_back(sentence);
  for (const std::string_view sentence : target.notes) notes.lost.emplace_back(sentence);

  targets::Material material{refit.values, {}};
  while (material.values.size() < 3) material.values.push_back(material.values.front());
  material.comments = {harmless(fmt::format("{} by gonio, re-fitted: {}", formula.name, formula.source)),
                       harmless("remaining error: " + errors_text(refit.errors)), harmless("roughness: " + std::string(formula.roughness))};
  const std::string text = best->text(material);
  write_file_atomically(path, text);
  notes.files = {path};
  if (with_scene && target.scene) {
    std::filesystem::path scene = path;
    scene.replace_extension(".scene" + path.extension().string());
    write_file_atomically(scene, target.scene("", text));
    notes.facts.emplace_back("scene", scene.filename().string());
    notes.files.push_back(std::move(scene));
  }
  return notes;
}

/// `Format` holds plain functions: one per place in the list of targets.
template <std::size_t index>
ExportNotes write_numbered(const Opened& opened, const std::filesystem::path& path, const tabulated::WriteOptions& options) {
  return write_target(targets::render_targets()[index], opened, path, options.scene);
}

constexpr std::size_t most_targets = 16;

template <std::size_t... index>
std::vector<tabulated::Format> formats_of(std::index_sequence<index...>) {
  const std::vector<targets::RenderTarget>& list = targets::render_targets();
  if (list.size() > sizeof...(index))
    throw Error(ErrorKind::internal,
                {"render_targets", std::to_string(list.size()) + " targets", "no more than the formats made for them"});
  std::vector<tabulated::Format> out;
  const auto add = [&](std::size_t k, auto write) {
    if (k < list.size()) out.push_back({list[k].name, list[k].description, nullptr, nullptr, write, list[k].extension});
  };
  (add(index, write_numbered<index>), ...);
  return out;
}

}  // namespace

const std::vector<tabulated::Format>& renderer_formats() {
  static const std::vector<tabulated::Format> list = formats_of(std::make_index_sequence<most_targets>());
  return list;
}

}  // namespace gonio::tools
