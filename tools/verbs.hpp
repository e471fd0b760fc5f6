// SPDX-License-Identifier: BSD-3-Clause
// The verbs of gonio. A new verb is one file and one line in the list of main.cpp.
#pragma once

#include "tools/console.hpp"

namespace gonio::tools {

/// Runs a verb with the arguments after its name; returns the exit code, throws Error for every failure.
using Verb = int (*)(const Arguments& arguments, Console& console);

int check_verb(const Arguments& arguments, Console& console);
int compare_verb(const Arguments& arguments, Console& console);
int collapse_verb(const Arguments& arguments, Console& console);
int demo_verb(const Arguments& arguments, Console& console);
int eval_verb(const Arguments& arguments, Console& console);
int export_verb(const Arguments& arguments, Console& console);
int fit_verb(const Arguments& arguments, Console& console);
int import_verb(const Arguments& arguments, Console& console);
int info_verb(const Arguments& arguments, Console& console);
int plan_verb(const Arguments& arguments, Console& console);
int reduce_verb(const Arguments& arguments, Console& console);
int serve_verb(const Arguments& arguments, Console& console);
int sweep_verb(const Arguments& arguments, Console& console);
int tradeoff_verb(const Arguments& arguments, Console& console);

}  // namespace gonio::tools
