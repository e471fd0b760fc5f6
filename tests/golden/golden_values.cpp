// SPDX-License-Identifier: BSD-3-Clause
// Every row of the golden table (36 digits, two independent computations) within 64 eps (1 + kappa).
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "brdf/blinn_phong_albedo.hpp"
#include "brdf/coordinates.hpp"
#include "brdf/models.hpp"
#include "brdf/phong_albedo.hpp"
#include "tests/shared_data.hpp"

#include "tests/check.hpp"

using namespace gonio;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double factor = 64;  // the table's own tolerance: 64 eps (1 + kappa)
constexpr double pi = std::numbers::pi;

struct Row {
  int line;
  std::string quantity, s, theta, extra, value;
  double kappa;
};

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

std::vector<Row> rows(const std::filesystem::path& path) {
  std::vector<Row> out;
  std::ifstream file(path);
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    if (text.empty() || text[0] == '#' || text.starts_with("quantity")) continue;
    const auto cells = split(text, ',');
    out.push_back(
        {line, cells.at(0), cells.at(1), cells.at(2), cells.at(3), cells.at(4), cells.at(6).empty() ? 0.0 : std::stod(cells.at(6))});
  }
  return out;
}

/// cos^s of an angle in radians, as the models form it: ln cos = -1/2 ln(1 + tan²).
double log_cos(double angle) {
  const double t = std::tan(angle);
  return angle < 1 ? -0.5 * std::log1p(t * t) : std::log(std::cos(angle));
}

/// Distance on a circle of the given length, in units of the value's scale.
double circular(double a, double b, double length) {
  const double d = std::fabs(std::remainder(a - b, length));
  return d;
}

/// The relative error of our value, or the absolute one where the golden value is 0.
double error_of(const Row& row) {
  const double s = row.s.empty() ? 0 : std::stod(row.s);
  const double golden = row.value == "any" ? 0 : std::strtod(row.value.c_str(), nullptr);
  const auto relative = [&](double value) { return golden == 0 ? std::fabs(value) : std::fabs(value - golden) / std::fabs(golden); };
  const auto theta = [&] { return degrees(std::stod(row.theta)); };
  if (row.quantity == "phong_norm_albedo") return relative(phong_albedo(s, theta()));
  if (row.quantity == "bp_albedo_s8") return relative(blinn_phong_norm(s) * half_vector_lobe_integral(s, theta()));
  if (row.quantity == "bp_albedo_exactnorm") return relative(blinn_phong_exact_norm(s) * half_vector_lobe_integral(s, theta()));
  if (row.quantity == "norm_bp_s8") return relative(blinn_phong_norm(s));
  if (row.quantity == "norm_bp_exact") return relative(blinn_phong_exact_norm(s));
  if (row.quantity == "norm_phong") return relative(phong_norm(s));
  if (row.quantity == "phong1975_albedo_normal") {
    double albedo[2];
    Phong1975::albedo(0_deg, &s, albedo);
    return relative(albedo[1]);
  }
  if (row.quantity == "dlog_norm_bp_s8_dlogs") return relative(s / (s + 8));
  if (row.quantity == "cos_pow") {
    if (golden < std::numeric_limits<double>::min()) return cosine_power(log_cos(std::stod(row.extra)), s);  // to be compared in the log
    return relative(cosine_power(log_cos(std::stod(row.extra)), s));
  }
  if (row.quantity == "log_cos_pow") return relative(s * log_cos(std::stod(row.extra)));
  if (row.quantity == "dcos_pow_ds") {
    const double lc = log_cos(std::stod(row.extra));
    if (golden > -std::numeric_limits<double>::min()) return std::fabs(lc * cosine_power(lc, s));
    return relative(lc * cosine_power(lc, s));
  }
  if (row.quantity.starts_with("rus_")) {
    const auto a = split(row.extra, ';');
    const GonioAngles angles{degrees(std::stod(a[0])), degrees(std::stod(a[1])), degrees(std::stod(a[2])), degrees(std::stod(a[3]))};
    const HalfDifference hd = half_difference(angles);
    if (row.quantity == "rus_theta_h") return relative(hd.theta_h.radians());
    if (row.quantity == "rus_theta_d") return relative(hd.theta_d.radians());
    // Azimuths live on a circle: the error is absolute, in radians.
    if (row.quantity == "rus_phi_h_mod2pi") return circular(hd.phi_h.radians(), golden, 2 * pi);
    if (row.quantity == "rus_phi_d_modpi") return circular(fold_phi_d(hd.phi_d.radians()), golden, pi);
    if (row.quantity == "rus_phi_degenerate") {
      // Any azimuth will do, but it has to be a number, and the lobes must not see it.
      const LobeGeometry from_angles = lobe_geometry(angles), from_vectors = lobe_geometry(angles.wi(), angles.wo());
      const bool sound = std::isfinite(hd.phi_h.radians()) && std::isfinite(hd.phi_d.radians());
      return sound ? std::fabs(std::exp(from_angles.log_cos_h) - std::exp(from_vectors.log_cos_h)) : 1.0;
    }
  }
  FAIL("line " << row.line << ": a golden quantity that no test knows: " << row.quantity);
  return 1;
}

}  // namespace

TEST_CASE("every golden row is met within 64 eps (1 + kappa)") {
  const auto path = test::shared_file("golden/golden.csv");
  if (!path) {
    WARN("golden/golden.csv is not beside this checkout (GONIO_SHARED): the 36-digit reference values were NOT compared");
    SUCCEED("nothing to compare");
    return;
  }
  std::map<std::string, int> seen;
  double worst = 0;
  for (const Row& row : rows(*path)) {
    const double error = error_of(row), tolerance = factor * eps * (1 + row.kappa);
    worst = std::fmax(worst, error / tolerance);
    INFO("line " << row.line << ": " << row.quantity << " s=" << row.s << " theta=" << row.theta << " extra=" << row.extra << " golden "
                 << row.value << ": error " << error << ", allowed " << tolerance);
    CHECK(error <= tolerance);
    ++seen[row.quantity];
  }
  int total = 0;
  for (const auto& [quantity, count] : seen) total += count;
  CHECK(total == 355);
  WARN("worst error is " << worst << " of its tolerance, over " << total << " rows");
}

TEST_CASE("the golden comparison rejects the naive forms") {
  // The gate has to see the difference: cos^s by pow(cos, s) at s = 1e9 is wrong by more than the tolerance of a stable form.
  const double angle = 1e-5, s = 1e9;
  const double stable = cosine_power(log_cos(angle), s), naive = std::pow(std::cos(angle), s);
  CHECK(std::fabs(naive - stable) / stable > factor * eps * 10);
  // theta_h by acos reads 0 for a half vector 1e-9 rad from the normal.
  const GonioAngles near_mirror{45_deg, 0_deg, 45_deg, degrees(180.0000001)};
  const Direction wi = near_mirror.wi(), wo = near_mirror.wo();
  const double hx = wi.x() + wo.x(), hy = wi.y() + wo.y(), hz = wi.z() + wo.z();
  CHECK(std::fabs(std::acos(std::fmin(1.0, hz / std::hypot(hx, hy, hz))) / half_difference(near_mirror).theta_h.radians() - 1) > 1e-3);
}
