// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/checks/symmetry_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fitting/checks/fitted_model.hpp"
#include "fitting/checks/multiple_tests.hpp"
#include "fitting/checks/tilt.hpp"
#include "fitting/distributions.hpp"

namespace gonio::fitting {
namespace {

struct Upright {
  Tilt tilt;
  ContrastTest test;  ///< of the corrected contrasts
};

/// The tilt that explains most, if it is significant.
std::optional<Upright> without_tilt(const Contrasts& set, const CheckSubject& subject, const CheckOptions& options) {
  const auto model = fitted_model(subject.datasets[0]);
  if (!model) return std::nullopt;
  std::optional<Upright> best;
  for (const TiltFrame frame : {TiltFrame::sample, TiltFrame::plane_of_incidence}) {
    auto tilt = estimate_tilt(set, *model, frame);
    if (!tilt) continue;
    const double zx = tilt->x_deg / tilt->u_x_deg, zy = tilt->y_deg / tilt->u_y_deg;
    if (chi2_upper_tail(zx * zx + zy * zy, 2) >= options.alpha) continue;
    ContrastTest test = test_contrasts(tilt->corrected, options.margin, options.alpha);
    if (!best || test.chi2 < best->test.chi2) best = Upright{std::move(*tilt), std::move(test)};
  }
  return best;
}

std::string tilt_text(const Tilt& tilt) {
  return fmt::format("a tilt of the normal by {:.3g}° ± {:.1g}° {}", tilt.size_deg(), tilt.u_deg(),
                     tilt.frame == TiltFrame::sample ? "in the sample" : "against the bench");
}

void add_places(Check& check, const Contrasts& set, const ContrastTest& test, const CheckSubject& subject, const CheckOptions& options) {
  std::vector<std::string> channels;
  for (const Channel& channel : subject.datasets[0]->channels) channels.push_back(channel.name);
  PlaceTests tests = place_tests(set, test, channels);
  Located located = locate(std::move(tests.places), tests.p, options.alpha, options.where);
  check.where = std::move(located.places);
  if (located.rejected_bh > 0)
    check.detail += fmt::format("; {} of {} places stand out ({} family-wise)", located.rejected_bh, tests.p.size(), located.rejected_holm);
}

}  // namespace

void judge_symmetry(Check& check, const Contrasts& set, const std::optional<Repeatability>& repeatability, const CheckSubject& subject,
                    const CheckOptions& options, const SymmetryWords& words) {
  const ContrastTest test = test_contrasts(set, options.margin, options.alpha);
  if (!test.has_uncertainty) {
    judge_without_uncertainty(check, set, repeatability, subject, options, words.tested);
    return;
  }
  judge_contrasts(check, test, options.margin, options.alpha);
  check.detail = fmt::format("{}: {} beyond noise {} ± {}, {} {:.3g}", words.tested, words.effect, percent_text(test.effect),
                             percent_text(test.u_effect), words.statistic, test.chi2 / test.dof);
  if (check.verdict == Verdict::vacuous) check.detail += fmt::format("; the data cannot tell within {}", percent_text(options.margin));
  const ContrastTest* last = &test;
  const Contrasts* corrected = &set;
  std::optional<Upright> upright;
  if (test.p_value < options.alpha) upright = without_tilt(set, subject, options);
  if (upright) {
    const bool explained =
        upright->test.p_value >= options.alpha || (upright->test.effect <= options.margin && upright->test.effect < test.effect / 2);
    check.detail += explained ? fmt::format("; it is {}, not a violation of {}: without it {} ± {}, {} {:.3g}", tilt_text(upright->tilt),
                                            words.what, percent_text(upright->test.effect), percent_text(upright->test.u_effect),
                                            words.statistic, upright->test.chi2 / upright->test.dof)
                              : fmt::format("; {} explains a part of it, {} {:.3g} are left", tilt_text(upright->tilt), words.statistic,
                                            upright->test.chi2 / upright->test.dof);
    if (explained) {
      check.verdict = Verdict::warn;
      check.effect = upright->test.effect;
      check.u_effect = upright->test.u_effect;
      last = &upright->test;
      corrected = &upright->tilt.corrected;
    }
  }
  if (last->p_value < options.alpha) {
    const double understated = understated_noise(*corrected, *last, options.alpha);
    if (understated > 1) {
      check.verdict = Verdict::warn;
      check.detail += fmt::format("; it has no pattern: uncertainties that are understated by a factor {:.2g} explain it", understated);
    } else if (last->strongest >= 0) {
      check.detail += fmt::format("; it goes with {}{}", last->directed[static_cast<std::size_t>(last->strongest)].pattern, words.advice);
    }
    add_places(check, *corrected, *last, subject, options);
  }
}

}  // namespace gonio::fitting
