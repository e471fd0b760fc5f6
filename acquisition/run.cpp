// SPDX-License-Identifier: BSD-3-Clause
// The run store on SQLite.
#include "acquisition/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>

#include "acquisition/sqlite.hpp"
#include "brdf/error.hpp"
#include "data-schemas/document.hpp"

namespace gonio::acquisition {
namespace {

constexpr std::uint32_t application_id = 1735356009;  // as data-schemas/run.sql
constexpr std::uint32_t schema_version = 1;

/// Looks at the header of the file (SQLite file format 1.3) before SQLite does: a file of another program must stay as it is.
void require_run_file(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& found, const std::string& wanted) {
    throw Error(ErrorKind::input, Fault{path.string(), found, wanted});
  };
  constexpr std::string_view magic("SQLite format 3\0", 16);
  std::array<char, 100> header{};
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("a file that cannot be read", "a run file (.gonio)");
  file.read(header.data(), header.size());
  if (file.gcount() != header.size() || std::string_view(header.data(), magic.size()) != magic)
    refuse("no SQLite file", "a run file (.gonio)");
  const auto number = [&](std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<std::uint8_t>(header[offset + k]);
    return value;
  };
  if (const auto id = number(68); id != application_id)
    refuse(fmt::format("an SQLite file with application id {}", id), "a run file (.gonio)");
  if (const auto version = number(60); version != schema_version) {
    refuse(fmt::format("run schema version {}", version), fmt::format("version {}", schema_version));
  }
}

/// Numbers in JSON in their shortest form that reads back as the same bits.
template <class Numbers>
std::string json_array(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

template <class Number>
std::vector<Number> numbers_of(const std::string& text, const std::string& where) {
  std::vector<Number> numbers;
  const Json array = parse_json(text, where);
  for (const Json& element : array.elements()) {
    if constexpr (std::is_integral_v<Number>) {
      numbers.push_back(element.integer());
    } else {
      numbers.push_back(element.number());
    }
  }
  return numbers;
}

template <class Enum>
Enum named(const std::string& text, std::initializer_list<Enum> all, const std::string& where) {
  for (const Enum e : all) {
    if (text == name(e)) return e;
  }
  throw Error(ErrorKind::input, Fault{where, text, "a word of the run schema"});
}

}  // namespace

struct Run::Store {
  Store(const std::filesystem::path& file, sqlite::Database::Mode mode, const RunStorage& storage)
      : path(file), writable(mode != sqlite::Database::Mode::read), database(file, mode, storage.vfs) {
    // Set by hand, not by SQLite's own busy handler: whoever finds the file in use is told at once.
    if (!writable) return;
    database.execute("PRAGMA locking_mode = EXCLUSIVE");
    database.execute("PRAGMA journal_mode = WAL");
    database.execute(storage.synced ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = OFF");
    database.execute("PRAGMA foreign_keys = ON");
  }
  ~Store() {
    // Fold the log into the file, so that a finished run is a single file. If that fails the log stays and holds everything.
    if (!writable) return;
    insert_reading.reset();
    try {
      database.execute("PRAGMA journal_mode = DELETE");
    } catch (...) {
    }
  }

  std::string meta(const std::string& key) {
    auto s = database.prepare("SELECT value FROM meta WHERE key = ?");
    s.bind(key);
    if (!s.step()) throw Error(ErrorKind::input, Fault{path.string(), "no '" + key + "'", "a run file that holds its " + key});
    return s.text(0);
  }
  void set_meta(const std::string& key, const std::string& value) {
    database.prepare("INSERT INTO meta VALUES (?, ?) ON CONFLICT (key) DO UPDATE SET value = excluded.value").bind(key).bind(value).step();
  }

  std::filesystem::path path;
  bool writable;
  sqlite::Database database;
  std::optional<sqlite::Statement> insert_reading;
};

Run::Run(std::unique_ptr<Store> store) : store_(std::move(store)) {}
Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

Run Run::create(const std::filesystem::path& path, const Bench& bench, const PlanRequest& request, const SweepPlan& plan,
                const RunStorage& storage) {
  if (std::filesystem::exists(path)) throw Error(ErrorKind::input, Fault{path.string(), "a file that exists", "a new file, or --resume"});
  // Written under another name and renamed when complete: a run file that exists holds its whole plan.
  const std::filesystem::path growing = path.string() + ".new";
  const auto remove_growing = [&] {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(growing.string() + suffix, ignored);
  };
  remove_growing();
  try {
    write_plan(growing, bench, request, plan, storage);
    std::filesystem::rename(growing, path);
  } catch (const std::filesystem::filesystem_error& e) {
    remove_growing();
    throw Error(ErrorKind::input, Fault{path.string(), e.code().message(), "a file that can be made"});
  } catch (...) {
    remove_growing();
    throw;
  }
  return open(path, true, storage);
}

void Run::write_plan(const std::filesystem::path& path, const Bench& bench, const PlanRequest& request, const SweepPlan& plan,
                     const RunStorage& storage) {
  Store store(path, sqlite::Database::Mode::create, storage);
  sqlite::Database& db = store.database;
  db.execute("BEGIN");
  db.execute(std::string(run_sql()));
  store.set_meta("bench", bench.document.dump());
  store.set_meta("bench_sha256", bench.sha256);
  store.set_meta("plan", request.document.dump());
  store.set_meta("plan_sha256", request.sha256);
  store.set_meta("seed", std::to_string(bench.seed));
  store.set_meta("simulated", bench.is_simulated ? "true" : "false");
  auto insert = db.prepare("INSERT INTO step VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const PlanStep& s : plan.steps) {
    insert.bind(s.number).bind(position++).bind(std::string(name(s.kind)));
    insert.bind(s.pose.theta_i.degrees()).bind(s.pose.phi_i.degrees()).bind(s.pose.theta_o.degrees()).bind(s.pose.phi_o.degrees());
    insert.bind(json_array(s.axes)).bind(s.exposure_s).bind(std::string(name(s.state))).bind(s.reason).bind(s.rotation_deg);
    s.partner < 0 ? insert.bind_null() : insert.bind(s.partner);
    insert.step();
  }
  auto calibration = db.prepare("INSERT INTO calibration VALUES (?, ?, ?, ?, ?)");
  const auto calibrate = [&](const std::string& what, double value, double u, const char* unit, const std::string& source) {
    calibration.bind(what).bind(value);
    u > 0 ? calibration.bind(u) : calibration.bind_null();
    calibration.bind(std::string(unit)).bind(source).step();
  };
  const Reference& white = bench.reference;
  calibrate("reference_f", white.f_per_sr, white.u_relative * white.f_per_sr, "1/sr", "certificate of " + white.name);
  for (const auto& [component, u] : bench.correlated) calibrate(component, 1, u, "1", "bench file");
  db.execute("COMMIT");
}

Run Run::open(const std::filesystem::path& path, bool writable, const RunStorage& storage) {
  if (!std::filesystem::is_regular_file(path)) throw Error(ErrorKind::input, Fault{path.string(), "no such file", "a run file (.gonio)"});
  require_run_file(path);
  return Run(std::make_unique<Store>(path, writable ? sqlite::Database::Mode::write : sqlite::Database::Mode::read, storage));
}

void Run::append(const Reading& r) {
  auto& insert = store_->insert_reading;
  if (!insert) {
    insert.emplace(store_->database.prepare(
        "INSERT INTO reading (step, attempt, repeat, time_ns, signal_w, exposure_s, range_w, counts, axes_deg, good, reason) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  }
  insert->bind(r.step)
      .bind(std::int64_t{r.attempt})
      .bind(std::int64_t{r.repeat})
      .bind(r.time)
      .bind(r.signal)
      .bind(r.exposure_s)
      .bind(r.range_w);
  insert->bind(json_array(r.counts)).bind(json_array(r.axes)).bind(std::int64_t{r.good}).bind(r.reason);
  insert->step();
}

void Run::append(const RunEvent& e) {
  store_->database.prepare("INSERT INTO event (time_ns, kind, text) VALUES (?, ?, ?)").bind(e.time).bind(e.kind).bind(e.text).step();
}

void Run::set_meta(const std::string& key, const std::string& value) { store_->set_meta(key, value); }

Bench Run::bench() const {
  const std::string where = store_->path.string() + " bench";
  Bench bench = bench_from(parse_json(store_->meta("bench"), where), store_->path.parent_path(), where);
  bench.sha256 = store_->meta("bench_sha256");
  bench.seed = std::stoull(store_->meta("seed"));
  return bench;
}

PlanRequest Run::request() const {
  const std::string where = store_->path.string() + " plan";
  PlanRequest request = plan_from(parse_json(store_->meta("plan"), where), where);
  request.sha256 = store_->meta("plan_sha256");
  return request;
}

std::vector<PlanStep> Run::steps() const {
  const std::string where = store_->path.string() + " step";
  std::vector<PlanStep> steps;
  auto s = store_->database.prepare(
      "SELECT number, kind, theta_i_deg, phi_i_deg, theta_o_deg, phi_o_deg, axes_deg, exposure_s, state, reason, rotation_deg, partner "
      "FROM step ORDER BY position");
  while (s.step()) {
    PlanStep p;
    p.number = s.integer(0);
    p.kind = named(s.text(1), {StepKind::sample, StepKind::dark, StepKind::reference}, where);
    p.pose = {degrees(s.real(2)), degrees(s.real(3)), degrees(s.real(4)), degrees(s.real(5))};
    p.axes = numbers_of<double>(s.text(6), where);
    p.exposure_s = s.real(7);
    p.state = named(s.text(8), {StepState::ok, StepState::masked, StepState::unreachable}, where);
    p.reason = s.text(9);
    p.rotation_deg = s.real(10);
    p.partner = s.is_null(11) ? -1 : s.integer(11);
    steps.push_back(std::move(p));
  }
  return steps;
}

std::vector<Reading> Run::readings() const {
  const std::string where = store_->path.string() + " reading";
  std::vector<Reading> readings;
  auto s = store_->database.prepare(
      "SELECT step, attempt, repeat, time_ns, signal_w, exposure_s, range_w, counts, axes_deg, good, reason FROM reading ORDER BY number");
  while (s.step()) {
    Reading r;
    r.step = s.integer(0);
    r.attempt = static_cast<int>(s.integer(1));
    r.repeat = static_cast<int>(s.integer(2));
    r.time = s.integer(3);
    r.signal = s.real(4);
    r.exposure_s = s.real(5);
    r.range_w = s.real(6);
    r.counts = numbers_of<std::int64_t>(s.text(7), where);
    r.axes = numbers_of<double>(s.text(8), where);
    r.good = s.integer(9) == 1;
    r.reason = s.text(10);
    readings.push_back(std::move(r));
  }
  return readings;
}

std::vector<RunEvent> Run::events() const {
  std::vector<RunEvent> events;
  auto s = store_->database.prepare("SELECT time_ns, kind, text FROM event ORDER BY number");
  while (s.step()) events.push_back({s.integer(0), s.text(1), s.text(2)});
  return events;
}

std::map<std::string, std::string> Run::meta() const {
  std::map<std::string, std::string> meta;
  auto s = store_->database.prepare("SELECT key, value FROM meta");
  while (s.step()) meta.emplace(s.text(0), s.text(1));
  return meta;
}

std::set<std::int64_t> Run::accepted_steps() const {
  const Bench b = bench();
  std::set<std::int64_t> accepted;
  auto s = store_->database.prepare(
      "SELECT step.number, step.kind, COUNT(DISTINCT reading.repeat) FROM step JOIN reading ON reading.step = step.number "
      "WHERE reading.good = 1 GROUP BY step.number");
  while (s.step()) {
    const StepKind kind = named(s.text(1), {StepKind::sample, StepKind::dark, StepKind::reference}, store_->path.string() + " step");
    if (s.integer(2) >= readings_at(kind, b)) accepted.insert(s.integer(0));
  }
  return accepted;
}

}  // namespace gonio::acquisition
