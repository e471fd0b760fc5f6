// SPDX-License-Identifier: BSD-3-Clause
// The only way into Catch2, and the last include of every test: glog (through Ceres) defines a CHECK of its own, which would
// silently take the place of Catch's and leave a test without a single assertion.
#pragma once

#include <catch2/catch.hpp>

#undef CHECK
#define CHECK(...) INTERNAL_CATCH_TEST("CHECK", Catch::ResultDisposition::ContinueOnFailure, __VA_ARGS__)
