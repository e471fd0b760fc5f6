// SPDX-License-Identifier: BSD-3-Clause
// The gonio program: finds the verb, runs it, turns every error into its message and exit code.
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "tools/verbs.hpp"

#ifndef GONIO_VERSION
#error "the build defines GONIO_VERSION"
#endif

namespace {

using namespace gonio;
using namespace gonio::tools;

struct Entry {
  const char* name;
  const char* summary;
  Verb run;
};

constexpr std::array<Entry, 14> verbs{{
    {"demo", "the whole chain on the embedded simulated bench: sweep, reduce, fit, check, export, picture", demo_verb},
    {"plan", "what a sweep would do: reachability, order, predicted time; moves nothing", plan_verb},
    {"serve", "emulate a bench's devices until stopped", serve_verb},
    {"sweep", "measure a plan on a bench", sweep_verb},
    {"reduce", "raw readings -> samples with uncertainty", reduce_verb},
    {"import", "any supported format -> ours", import_verb},
    {"fit", "parameters of a model, with intervals", fit_verb},
    {"collapse", "samples -> what a fit needs of them, to be merged with that of others", collapse_verb},
    {"check", "reciprocity, isotropy, energy, positivity", check_verb},
    {"compare", "two BRDFs: every metric, where they differ most, pictures", compare_verb},
    {"export", "table or fit -> a renderer's format", export_verb},
    {"eval", "values of a model or a BRDF file at directions from standard input", eval_verb},
    {"info", "what a file is", info_verb},
    {"tradeoff", "what accuracy costs in time: table, plot, advice", tradeoff_verb},
}};

void print_help(std::ostream& out) {
  out << "gonio " << GONIO_VERSION << ": measures how a surface reflects light, and hands the result on\n\n"
      << "Usage: gonio VERB [ARGUMENTS] [--json] [--quiet]\n\n";
  for (const Entry& entry : verbs) out << "  " << entry.name << std::string(10 - std::strlen(entry.name), ' ') << entry.summary << '\n';
  out << "\ngonio VERB --help tells more. Exit codes: 0 fine, 1 a check failed or a fit did not converge, 2 usage,\n"
         "3 input file, 4 limits, 5 device, 6 interrupted, 70 our own fault.\n";
}

/// What was freed is used again instead of going back to the system and being cleared once more: one pass over a large table after another
/// takes and frees the same megabytes.
void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
#endif
}

int run(const Arguments& arguments, Console& console) {
  if (arguments.empty()) {
    print_help(std::cerr);
    return 2;
  }
  if (arguments[0] == "--help" || arguments[0] == "-h") {
    print_help(std::cout);
    return 0;
  }
  if (arguments[0] == "--version") {
    console.print(std::string("gonio ") + GONIO_VERSION);
    return 0;
  }
  const auto entry = std::find_if(verbs.begin(), verbs.end(), [&](const Entry& e) { return arguments[0] == e.name; });
  if (entry == verbs.end()) throw Error(ErrorKind::usage, {"gonio", "'" + arguments[0] + "'", "a verb; gonio --help lists them"});
  return entry->run(Arguments(arguments.begin() + 1, arguments.end()), console);
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  std::ios::sync_with_stdio(false);
  const Arguments arguments(argv + 1, argv + argc);
  Console console;
  console.json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();  // for errors before the verb has parsed
  const auto fail = [&](const Error& error) {
    std::cout.flush();
    console.progress("");
    if (console.json)
      std::cerr << error_document(error).dump(-1) << '\n';
    else
      std::cerr << "gonio: " << error.what() << '\n';
    return exit_code(error.kind());
  };
  try {
    const int code = run(arguments, console);
    std::cout.flush();
    if (!std::cout) return fail(Error(ErrorKind::input, {"standard output", "a write that failed", "room for the result"}));
    return code;
  } catch (const Error& error) {
    return fail(error);
  } catch (const std::bad_alloc&) {
    return fail(Error(ErrorKind::internal, {"memory", "none left", "more memory, or less input"}));
  } catch (const std::exception& error) {
    return fail(Error(ErrorKind::internal, {"gonio", error.what(), "a report of this to the authors"}));
  }
}
