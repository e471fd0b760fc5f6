// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/cell_mean.hpp"

#include <cmath>
#include <limits>

#include "brdf/brdf.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

/// A function of wi.x alone.
class OfX final : public Brdf {
 public:
  explicit OfX(double (*function)(double)) : function_(function), channels_(single_channel("value")) {}
  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {}; }
  void eval(std::span<const Direction> wi, std::span<const Direction>, std::span<double> f) const override {
    for (std::size_t k = 0; k < wi.size(); ++k) f[k] = function_(wi[k].x());
  }

 private:
  double (*function_)(double);
  Channels channels_;
};

CellMean::Result mean_of(double (*function)(double), std::vector<std::size_t> orders, ExportNotes& notes) {
  Opened source;
  source.brdf = std::make_shared<const OfX>(function);
  const ChannelMap map{source.brdf->channels(), {1}, ""};
  const CellMean mean(source, map, std::move(orders), 1e-3);
  return mean(
      3,
      [](std::span<const double> at) {
        return DirectionPair{Direction::trusted(at[1], 0, std::sqrt(1 - at[1] * at[1])), Direction()};
      },
      2, notes);
}

}  // namespace

TEST_CASE("The mean stops where two rules agree, with the points it took counted") {
  ExportNotes notes;
  const auto cubic = mean_of([](double x) { return 1 + x * x * x; }, {1, 2, 3, 8}, notes);
  CHECK(cubic.f[0] == Approx(1.25).epsilon(1e-12));
  CHECK(cubic.known);
  CHECK(cubic.unsettled == 0);
  CHECK(notes.n_nodes == 8 + 27);
}

TEST_CASE("A mean that has not settled says by how much") {
  ExportNotes notes;
  const auto narrow = mean_of([](double x) { return std::exp(-1e4 * (x - 0.5) * (x - 0.5)); }, {2, 3, 4}, notes);
  CHECK(narrow.unsettled > 0.1);
  CHECK(notes.n_nodes == 8 + 27 + 64);
}

TEST_CASE("Points without a value are left out; a cell without any is unknown") {
  ExportNotes notes;
  const auto partly = mean_of([](double x) { return x > 0.5 ? 2 : std::numeric_limits<double>::quiet_NaN(); }, {2, 4}, notes);
  CHECK(partly.known);
  CHECK(partly.f[0] == Approx(2));
  CHECK(notes.n_unknown == 4 + 32);
  CHECK_FALSE(mean_of([](double) { return std::numeric_limits<double>::quiet_NaN(); }, {2, 4}, notes).known);
}

TEST_CASE("A mean is settled when its error is small beside its uncertainty, and no sooner") {
  // A kink of 2 %, with an uncertainty of 10 %, of 0.1 %, and of none.
  class Kinked final : public UncertainBrdf {
   public:
    explicit Kinked(double u) : u_(u), channels_(single_channel("value")) {}
    const Channels& channels() const override { return channels_; }
    Symmetry symmetry() const override { return {}; }
    void eval(std::span<const Direction> wi, std::span<const Direction>, std::span<double> f) const override {
      for (std::size_t k = 0; k < wi.size(); ++k) f[k] = wi[k].x() < 0.45 ? 1 : 1.02;
    }
    void eval_with_uncertainty(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f, std::span<double> u,
                               std::span<Coverage> coverage) const override {
      eval(wi, wo, f);
      std::fill(u.begin(), u.end(), u_);
      std::fill(coverage.begin(), coverage.end(), Coverage::interpolated);
    }

   private:
    double u_;
    Channels channels_;
  };
  const auto nodes_for = [](double u) {
    Opened source;
    source.uncertain = std::make_shared<const Kinked>(u);
    source.brdf = source.uncertain;
    const ChannelMap map{source.brdf->channels(), {1}, ""};
    ExportNotes notes;
    CellMean(source, map, {2, 3, 4, 6, 8}, 1e-3)(
        1,
        [](std::span<const double> at) {
          return DirectionPair{Direction::trusted(at[0], 0, std::sqrt(1 - at[0] * at[0])), Direction()};
        },
        2, notes);
    return notes.n_nodes;
  };
  CHECK(nodes_for(0.1) == 2 + 3);
  CHECK(nodes_for(0.001) > 2 + 3);
  CHECK(nodes_for(0.001) == nodes_for(std::numeric_limits<double>::quiet_NaN()));
}
