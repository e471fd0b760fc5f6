// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_batch.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "fitting/threads.hpp"
#include "tools/fit_job.hpp"
#include "tools/json_lines.hpp"
#include "tools/progress_bar.hpp"
#include "tools/stop_signal.hpp"

namespace gonio::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::array not_measurements{"", ".json", ".jsonl", ".md", ".log", ".gz", ".zip", ".png", ".jpg", ".pdf"};

int severity(int code) { return code == 1 ? 1 : code == 0 ? 0 : code == exit_code(ErrorKind::internal) ? 3 : 2; }

/// What decides whether two fits give the same parameters.
std::string identity(const Json& line) {
  std::string out = line.at("context").at("version").string() + line.at("options").dump(-1);
  for (const Json& input : line.at("context").at("inputs").elements()) out += input.at("sha256").string();
  return out;
}

int code_of(const Json& line) {
  if (line.contains("error"))
    return line.at("error").at("kind").string() == name(ErrorKind::internal) ? exit_code(ErrorKind::internal) : exit_code(ErrorKind::input);
  return line.at("status").string() == name(fitting::Status::converged) ? 0 : 1;
}

/// Our own faults, and files that could not even be read, are tried again.
bool is_final(const Json& line) { return line.at("context").at("inputs").size() > 0 && code_of(line) != exit_code(ErrorKind::internal); }

/// Where the lines go, in the order they come or in that of the files. Safe from several threads.
class Lines {
 public:
  Lines(const BatchOptions& options, const Console& console) : console_(console), ordered_(options.ordered) {
    if (!options.out.empty()) file_.emplace(options.out, Schema::fit_line, options.resume);
    if (!file_) return;
    for (const Json& line : file_->standing())
      if (is_final(line)) standing_[identity(line)] = code_of(line);
  }
  /// The exit code of the line that stands for this identity.
  std::optional<int> standing(const std::string& key) const {
    const auto found = standing_.find(key);
    return found == standing_.end() ? std::nullopt : std::optional(found->second);
  }
  /// Gives the line of a file, or none if it was left out.
  void give(std::size_t index, std::optional<Json> line) {
    const std::lock_guard lock(guard_);
    if (!ordered_) return write(line);
    waiting_.emplace(index, std::move(line));
    for (auto first = waiting_.find(next_); first != waiting_.end(); first = waiting_.find(++next_)) {
      write(first->second);
      waiting_.erase(first);
    }
  }

 private:
  void write(const std::optional<Json>& line) {
    if (line && file_) file_->append(*line);
    if (line && !file_) console_.print(line->dump(-1));
  }

  const Console& console_;
  const bool ordered_;
  std::optional<JsonLines> file_;
  std::map<std::string, int> standing_;
  std::mutex guard_;
  std::map<std::size_t, std::optional<Json>> waiting_;
  std::size_t next_ = 0;
};

Json error_line(const std::string& file, const Json& context_block, const FitRequest& request, const Error& error) {
  return Json::object(
      {{"context", context_block}, {"file", file}, {"options", request.options}, {"error", error_document(error).at("error")}});
}

Json fit_line(const std::string& file, const FitRequest& request, Json context_block) {
  using Stopwatch = std::chrono::steady_clock;
  const auto begin = Stopwatch::now();
  Console silent;
  silent.quiet = true;
  const FitInput input = read_inputs({file}, request.read, silent);
  FitOutcome outcome = fit_input(input, request.fit);
  outcome.timings.total_s = std::chrono::duration<double>(Stopwatch::now() - begin).count();
  context_block.set("simulated", input.simulated);
  return fit_document(outcome.result, input.masked, outcome.timings, std::move(context_block), request.options);
}

}  // namespace

std::vector<std::string> expand_folders(const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const std::string& given : names) {
    std::error_code error;
    if (!fs::is_directory(given, error)) {
      out.push_back(given);
      continue;
    }
    std::vector<std::string> found;
    for (fs::directory_iterator entry(given, error), end; !error && entry != end; entry.increment(error)) {
      const fs::path& path = entry->path();
      std::error_code none;
      const bool wanted = entry->is_regular_file(none) && !path.filename().string().starts_with('.') &&
                          std::find(not_measurements.begin(), not_measurements.end(), path.extension()) == not_measurements.end();
      if (wanted) found.push_back(path.string());
    }
    if (error) throw Error(ErrorKind::input, {given, error.message(), "a folder that can be listed"});
    std::sort(found.begin(), found.end());
    out.insert(out.end(), found.begin(), found.end());
  }
  return out;
}

int fit_batch(const std::vector<std::string>& files, const FitRequest& request, const BatchOptions& options, Console& console) {
  const std::atomic<bool>& stop = stop_on_signals();
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int jobs = std::clamp(options.jobs > 0 ? options.jobs : processors, 1, std::max(1, static_cast<int>(files.size())));
  FitRequest one = request;
  one.fit.threads = std::max(1, processors / jobs);

  Lines lines(options, console);
  std::vector<std::optional<int>> codes(files.size());  // none: not reached
  std::atomic<std::size_t> skipped{0}, failed{0};
  std::atomic<bool> useless{false};  // a wrong flag or a full disk: the rest would fail alike
  {
    ProgressBar bar(console, "fit", files.size());
    fitting::for_each_index(files.size(), jobs, [&](std::size_t k) {
      if (stop || useless) return;
      Json block = context({}, std::nullopt, false);
      std::optional<Json> line;
      try {
        block = context(hash_inputs({files[k]}, request.read), std::nullopt, false);
        codes[k] = lines.standing(identity(Json::object({{"context", block}, {"options", request.options}})));
        if (codes[k]) {
          ++skipped;
        } else {
          line = fit_line(files[k], one, block);
        }
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::usage) {
          useless = true;
          throw;
        }
        line = error_line(files[k], block, request, error);
      } catch (const std::exception& error) {
        line =
            error_line(files[k], block, request, Error(ErrorKind::internal, {files[k], error.what(), "a report of this to the authors"}));
      }
      if (line) codes[k] = code_of(*line);
      failed += *codes[k] > 1;
      try {
        const bool was_there = !line;
        lines.give(k, std::move(line));
        bar.advance(was_there, failed > 0 ? fmt::format("{} failed", failed.load()) : "");
      } catch (...) {
        useless = true;
        throw;
      }
    });
  }

  int worst = 0;
  std::size_t done = 0, not_converged = 0;
  for (const auto& code : codes) {
    if (!code) continue;
    ++done;
    not_converged += *code == 1;
    if (severity(*code) > severity(worst)) worst = *code;
  }
  console.note(fmt::format("{} of {} files: {} converged, {} not converged, {} failed; {} of them stood there before", done, files.size(),
                           done - not_converged - failed, not_converged, failed.load(), skipped.load()));
  if (done < files.size())
    throw Error(ErrorKind::interrupted, {"gonio fit", fmt::format("a signal after {} of {} files", done, files.size()),
                                         options.out.empty() ? "a run to the end" : "the same command with --resume"});
  return worst;
}

}  // namespace gonio::tools
