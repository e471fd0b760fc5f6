// SPDX-License-Identifier: BSD-3-Clause
#include "brdf/model_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>

#include "brdf/error.hpp"
#include "brdf/models.hpp"
#include "brdf/numeric_albedo.hpp"

namespace gonio {
namespace {

/// What needs the type of a model of the list, in the order of the list.
struct Kernel {
  void (*basis)(std::span<const LobeGeometry>, const double*, double*, std::size_t) = nullptr;
  void (*albedo)(Angle, const double*, double*) = nullptr;  ///< null: no closed form
  void (*albedo_bound)(const double*, double*) = nullptr;   ///< null: none, or not at the normal
};

template <AnalyticModel M>
void basis_of(std::span<const LobeGeometry> geometry, const double* nonlinear, double* columns, std::size_t stride) {
  std::array<double, linear_count<M>()> out{};
  for (std::size_t row = 0; row < geometry.size(); ++row) {
    M::basis(geometry[row], nonlinear, out.data());
    for (std::size_t k = 0; k < out.size(); ++k) columns[k * stride + row] = out[k];
  }
}

struct List {
  std::vector<ModelInfo> infos;
  std::vector<Kernel> kernels;
};

const List& list() {
  static const List made = [] {
    List all;
    for_each_model([&]<class M>(M) {
      ModelInfo info;
      info.name = M::name;
      info.citation = M::citation;
      info.parameters.assign(M::parameters.begin(), M::parameters.end());
      info.linear_count = linear_count<M>();
      info.depends_on = M::depends_on;
      info.properties = M::properties;
      info.closed_albedo = ClosedAlbedo<M>;
      if constexpr (requires { M::peak; }) info.peak = M::peak;
      all.infos.push_back(std::move(info));
      Kernel kernel{&basis_of<M>, nullptr, nullptr};
      if constexpr (requires { &M::albedo; }) kernel.albedo = &M::albedo;
      if constexpr (ClosedAlbedo<M>) kernel.albedo_bound = &M::albedo_bound;
      all.kernels.push_back(kernel);
    });
    // The elements stay where they are when the list is moved.
    for (ModelInfo& info : all.infos) info.terms = {{&info, 0, 0, 0}};
    return all;
  }();
  return made;
}

const Kernel& kernel_of(const ModelInfo& model) { return list().kernels[static_cast<std::size_t>(&model - list().infos.data())]; }

const ModelInfo* find_in_list(std::string_view name) {
  for (const ModelInfo& info : list().infos)
    if (info.name == name) return &info;
  return nullptr;
}

std::vector<std::string_view> term_names(std::string_view name) {
  std::vector<std::string_view> out;
  for (std::size_t from = 0; from <= name.size();) {
    const std::size_t to = std::min(name.find('+', from), name.size());
    out.push_back(name.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

DependsOn common_dependence(DependsOn a, DependsOn b) {
  if (a == b || b == DependsOn::nothing) return a;
  return a == DependsOn::nothing ? b : DependsOn::all;
}

/// A sum and the names of its parameters.
struct Sum {
  ModelInfo info;
  std::deque<std::string> names;
};

std::unique_ptr<Sum> make_sum(std::string_view name, const std::vector<const ModelInfo*>& models) {
  auto sum = std::make_unique<Sum>();
  ModelInfo& info = sum->info;
  std::set<std::string> used;
  const auto add = [&](Parameter parameter) {
    std::string unique(parameter.name);
    for (int k = 2; !used.insert(unique).second; ++k) unique = std::string(parameter.name) + "_" + std::to_string(k);
    sum->names.push_back(std::move(unique));
    parameter.name = sum->names.back();
    info.parameters.push_back(parameter);
  };
  info.name = name;
  info.depends_on = models.front()->depends_on;
  info.properties = models.front()->properties;
  info.closed_albedo = true;
  std::size_t nonlinear = 0;
  for (std::size_t t = 0; t < models.size(); ++t) {
    const ModelInfo& model = *models[t];
    const std::size_t first = t == 0 ? 0 : 1;
    info.terms.push_back({&model, first, info.parameters.size(), nonlinear});
    for (std::size_t k = first; k < model.linear_count; ++k) add(model.parameters[k]);
    nonlinear += model.nonlinear_count();
    info.depends_on = common_dependence(info.depends_on, model.depends_on);
    info.properties.reciprocal &= model.properties.reciprocal;
    info.properties.isotropic &= model.properties.isotropic;
    info.properties.bilateral &= model.properties.bilateral;
    info.properties.bounded &= model.properties.bounded;
    info.closed_albedo &= model.closed_albedo;
    if (info.citation.find(model.citation) == std::string::npos) info.citation += (t == 0 ? "" : "; ") + model.citation;
  }
  info.linear_count = info.parameters.size();
  for (const ModelInfo* model : models)
    for (std::size_t k = model->linear_count; k < model->parameters.size(); ++k) add(model->parameters[k]);
  return sum;
}

}  // namespace

void ModelInfo::basis(std::span<const LobeGeometry> geometry, const double* nonlinear, double* columns, std::size_t stride) const {
  if (terms.size() == 1) {
    kernel_of(*terms.front().model).basis(geometry, nonlinear, columns, stride);
    return;
  }
  std::vector<double> all;
  for (const ModelTerm& term : terms) {
    all.resize(term.model->linear_count * geometry.size());
    kernel_of(*term.model).basis(geometry, nonlinear + term.nonlinear, all.data(), geometry.size());
    for (std::size_t k = term.first_basis; k < term.model->linear_count; ++k)
      std::copy_n(all.data() + k * geometry.size(), geometry.size(), columns + (term.linear + k - term.first_basis) * stride);
  }
}

double ModelInfo::evaluate(const LobeGeometry& geometry, const double* parameters_in_order) const {
  if (!geometry.above_horizon()) return 0;
  std::array<double, 16> fixed{};
  std::vector<double> large(linear_count > fixed.size() ? linear_count : 0);
  double* columns = large.empty() ? fixed.data() : large.data();
  basis(std::span(&geometry, 1), parameters_in_order + linear_count, columns, 1);
  double f = 0;
  for (std::size_t k = 0; k < linear_count; ++k) f += parameters_in_order[k] * columns[k];
  return f;
}

void ModelInfo::albedo(Angle theta_i, Angle phi_i, const double* nonlinear, double* out) const {
  for (const ModelTerm& term : terms) {
    std::vector<double> all(term.model->linear_count);
    if (const Kernel& kernel = kernel_of(*term.model); kernel.albedo)
      kernel.albedo(theta_i, nonlinear + term.nonlinear, all.data());
    else
      numeric_albedo(*term.model, theta_i, phi_i, nonlinear + term.nonlinear, all.data());
    std::copy(all.begin() + static_cast<std::ptrdiff_t>(term.first_basis), all.end(), out + term.linear);
  }
}

ModelInfo::Incidence ModelInfo::brightest_incidence(const double* parameters_in_order) const {
  Incidence brightest;
  if (closed_albedo) return brightest;
  double largest = -1;
  std::vector<double> each(linear_count);
  const std::vector<double> azimuths = properties.isotropic ? std::vector<double>{0} : std::vector<double>{0, 45, 90, 135};
  for (const double phi : azimuths)
    for (const double theta : {0., 10., 20., 30., 40., 50., 60., 70., 75., 80., 83., 86., 88., 89.}) {
      albedo(degrees(theta), degrees(phi), parameters_in_order + linear_count, each.data());
      const double sum = std::inner_product(each.begin(), each.end(), parameters_in_order, 0.0);
      if (sum > largest) largest = sum, brightest = {degrees(theta), degrees(phi)};
    }
  return brightest;
}

double ModelInfo::albedo_bound(const double* parameters_in_order) const {
  const double* nonlinear = parameters_in_order + linear_count;
  std::vector<double> each(linear_count);
  if (!closed_albedo) {
    const Incidence brightest = brightest_incidence(parameters_in_order);
    albedo(brightest.theta, brightest.phi, nonlinear, each.data());
    return std::inner_product(each.begin(), each.end(), parameters_in_order, 0.0);
  }
  double bound = 0;
  for (const ModelTerm& term : terms) {
    each.resize(term.model->linear_count);
    kernel_of(*term.model).albedo_bound(nonlinear + term.nonlinear, each.data());
    for (std::size_t k = term.first_basis; k < each.size(); ++k) bound += parameters_in_order[term.linear + k - term.first_basis] * each[k];
  }
  return bound;
}

const std::vector<ModelInfo>& model_infos() { return list().infos; }

bool is_model(std::string_view name) {
  const auto names = term_names(name);
  return std::all_of(names.begin(), names.end(), [](std::string_view term) { return find_in_list(term) != nullptr; });
}

const ModelInfo& model_info(std::string_view name) {
  if (const ModelInfo* known = find_in_list(name)) return *known;
  std::vector<Fault> faults;
  std::vector<const ModelInfo*> models;
  std::string known;
  for (const ModelInfo& info : list().infos) known += (known.empty() ? "" : ", ") + info.name;
  for (const std::string_view term : term_names(name)) {
    const ModelInfo* model = find_in_list(term);
    if (!model)
      faults.push_back({"model", "'" + std::string(term) + "'", "one of " + known});
    else if (!models.empty() && model->linear_count < 2)
      faults.push_back({"model", "'" + std::string(term) + "' as a further term of '" + std::string(name) + "'",
                        "a model with a lobe; the diffuse part of a sum is that of its first term"});
    models.push_back(model);
  }
  if (!faults.empty()) throw Error(ErrorKind::usage, "there is no model '" + std::string(name) + "'", faults);
  static std::mutex guard;
  static std::map<std::string, std::unique_ptr<Sum>, std::less<>> sums;
  const std::lock_guard lock(guard);
  auto found = sums.find(name);
  if (found == sums.end()) found = sums.emplace(std::string(name), make_sum(name, models)).first;
  return found->second->info;
}

}  // namespace gonio
