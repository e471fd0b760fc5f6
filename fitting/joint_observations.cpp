// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/joint_observations.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "brdf/error.hpp"

namespace gonio::fitting {
namespace {

/// The same components of the same size that touch every sample alike: joined, they need no sensitivities.
bool alike(const std::vector<CorrelatedComponent>& a, const std::vector<CorrelatedComponent>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const CorrelatedComponent& x, const CorrelatedComponent& y) {
    return x.name == y.name && x.u == y.u && x.sensitivity.empty() && y.sensitivity.empty();
  });
}

class JointObservations final : public Observations {
 public:
  explicit JointObservations(std::vector<std::shared_ptr<const Observations>> parts) : parts_(std::move(parts)) {
    for (std::size_t part = 0; part < parts_.size(); ++part)
      for (std::size_t index = 0; index < parts_[part]->block_count(); ++index) blocks_.emplace_back(part, index);
  }

  const Channels& channels() const override { return parts_.front()->channels(); }
  Symmetry symmetry() const override {
    Symmetry all = parts_.front()->symmetry();
    for (const auto& part : parts_) {
      const Symmetry one = part->symmetry();
      all.isotropic = all.isotropic && one.isotropic;
      all.bilateral = all.bilateral && one.bilateral;
      all.reciprocal = all.reciprocal && one.reciprocal;
    }
    return all;
  }
  std::size_t block_count() const override { return blocks_.size(); }
  ObservationBlock block(std::size_t index) const override { return part(index).block(blocks_[index].second); }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override { part(index).geometry(blocks_[index].second, out); }
  void geometry_of(std::size_t index, std::span<const std::size_t> samples, std::vector<LobeGeometry>& out) const override {
    part(index).geometry_of(blocks_[index].second, samples, out);
  }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override { part(index).angles(blocks_[index].second, out); }
  Apertures apertures(std::size_t index) const override { return part(index).apertures(blocks_[index].second); }

  std::vector<CorrelatedComponent> correlated() const override {
    std::vector<std::vector<CorrelatedComponent>> stated;
    std::map<std::string, double> largest;
    for (const auto& part : parts_) {
      stated.push_back(part->correlated());
      for (const CorrelatedComponent& component : stated.back()) largest[component.name] = std::max(largest[component.name], component.u);
    }
    if (std::all_of(stated.begin(), stated.end(), [&](const auto& list) { return alike(list, stated.front()); })) return stated.front();

    std::vector<CorrelatedComponent> out;
    for (const auto& [name, u] : largest) {
      CorrelatedComponent joint{name, u, {}};
      for (std::size_t p = 0; p < parts_.size(); ++p) {
        const auto own = std::find_if(stated[p].begin(), stated[p].end(), [&name = name](const auto& c) { return c.name == name; });
        const double factor = own != stated[p].end() && u > 0 ? own->u / u : 0;
        for (std::size_t k = 0, size = samples_of(*parts_[p]); k < size; ++k)
          joint.sensitivity.push_back(factor > 0 && !own->sensitivity.empty() ? factor * own->sensitivity[k] : factor);
      }
      out.push_back(std::move(joint));
    }
    return out;
  }

 private:
  const Observations& part(std::size_t index) const { return *parts_[blocks_[index].first]; }
  static std::size_t samples_of(const Observations& observations) {
    std::size_t count = 0;
    for (std::size_t b = 0; b < observations.block_count(); ++b) count += observations.block(b).size;
    return count;
  }

  std::vector<std::shared_ptr<const Observations>> parts_;
  std::vector<std::pair<std::size_t, std::size_t>> blocks_;  ///< part, and the number of the block in it
};

std::string names_of(const Channels& channels) {
  std::string out;
  for (const Channel& channel : channels) out += (out.empty() ? "" : ", ") + channel.name;
  return out;
}

bool same(const Channels& a, const Channels& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Channel& x, const Channel& y) {
    return x.name == y.name && x.wavelength_in_nm == y.wavelength_in_nm && x.wavelength_out_nm == y.wavelength_out_nm;
  });
}

}  // namespace

std::shared_ptr<const Observations> join(std::vector<std::shared_ptr<const Observations>> parts) {
  if (parts.empty()) throw Error(ErrorKind::input, {"joint observations", "no part", "at least one"});
  std::vector<Fault> faults;
  const Channels& first = parts.front()->channels();
  for (std::size_t p = 1; p < parts.size(); ++p)
    if (!same(first, parts[p]->channels()))
      faults.push_back({"part " + std::to_string(p + 1), "channels " + names_of(parts[p]->channels()), "channels " + names_of(first)});
  if (!faults.empty()) throw Error(ErrorKind::input, "observations with different channels cannot be fitted together", faults);
  if (parts.size() == 1) return parts.front();
  return std::make_shared<JointObservations>(std::move(parts));
}

}  // namespace gonio::fitting
