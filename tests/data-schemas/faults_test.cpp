// SPDX-License-Identifier: BSD-3-Clause
// Faults of a document against a schema: places and words.
#include <atomic>
#include <thread>

#include "data-schemas/document.hpp"
#include "tests/check.hpp"

using gonio::Json;

namespace {

// Much like a bench: nested objects, arrays, patterns, alternatives.
constexpr std::string_view bench_like = R"({
  "type": "object", "additionalProperties": false, "required": ["name", "axes", "reference"],
  "properties": {
    "name": {"type": "string", "minLength": 1},
    "mode": {"enum": ["step", "fly"]},
    "axes": {"type": "array", "minItems": 2, "items": {"$ref": "#/definitions/axis"}},
    "reference": {"type": "object", "required": ["f_per_sr"], "properties": {"f_per_sr": {"type": "number", "exclusiveMinimum": 0}}},
    "mask": {"type": "string", "pattern": "^0x[0-9a-f]+$"},
    "limits": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
    "watchdog": {"anyOf": [{"type": "null"}, {"type": "object", "additionalProperties": false, "required": ["address"],
                 "properties": {"address": {"type": "integer", "minimum": 0, "maximum": 65535}}}]},
    "pattern": {"oneOf": [
      {"type": "object", "required": ["kind", "step_deg"], "properties": {"kind": {"const": "grid"}, "step_deg": {"type": "number"}}},
      {"type": "object", "required": ["kind", "points"], "properties": {"kind": {"const": "density"}, "points": {"type": "integer"}}}]},
    "names": {"type": "array", "uniqueItems": true},
    "correlated": {"type": "object", "patternProperties": {"^[a-z]+$": {"type": "number"}}, "additionalProperties": false}
  },
  "definitions": {"axis": {"type": "object", "additionalProperties": false, "required": ["unit", "speed_deg_per_s"],
    "properties": {"unit": {"type": "integer", "minimum": 1, "maximum": 247}, "speed_deg_per_s": {"type": "number", "minimum": 0, "maximum": 360}}}}
})";

constexpr std::string_view valid =
    R"({"name": "b", "mode": "step", "axes": [{"unit": 1, "speed_deg_per_s": 30}, {"unit": 2.0, "speed_deg_per_s": 360}],
  "reference": {"f_per_sr": 0.31}, "mask": "0x1f", "limits": [0, 1.5], "watchdog": null, "pattern": {"kind": "grid", "step_deg": 5},
  "names": ["a", "b"], "correlated": {"scale": 0.01}})";

std::vector<std::string> faults(std::string_view text, std::string_view schema = bench_like) {
  std::vector<std::string> lines;
  for (const gonio::Fault& fault : gonio::faults_of(gonio::parse_json(text, "doc"), schema, "doc"))
    lines.push_back(fault.where + " | " + fault.found + " | " + fault.wanted);
  return lines;
}

/// The valid document with one member replaced.
std::vector<std::string> faults_with(const std::string& member, std::string_view value) {
  return faults(gonio::parse_json(valid, "doc").set(member, gonio::parse_json(value, "value")).dump());
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("a valid document has no faults", "[faults]") {
  CHECK(faults(valid) == Lines{});
  CHECK(faults_with("watchdog", R"({"address": 7})") == Lines{});
}

TEST_CASE("a document with nine faults gives nine lines in document order", "[faults]") {
  CHECK(faults(R"({
    "name": "",
    "mode": "fast",
    "axes": [{"unit": 0, "sped_deg_per_s": 30}, {"unit": 2, "speed_deg_per_s": "fast"}],
    "mask": "31",
    "watchdog": {"address": 65536}
  })") == Lines{"doc# | no member \"reference\" | \"reference\": an object", "doc#/name | \"\" (string) | a string of at least 1 character",
                "doc#/mode | \"fast\" (string) | one of \"step\", \"fly\"",
                "doc#/axes/0 | no member \"speed_deg_per_s\" | \"speed_deg_per_s\": a number from 0 to 360",
                "doc#/axes/0/unit | 0 (integer) | an integer from 1 to 247",
                "doc#/axes/0/sped_deg_per_s | an unknown member | perhaps \"speed_deg_per_s\"; one of unit, speed_deg_per_s",
                "doc#/axes/1/speed_deg_per_s | \"fast\" (string) | a number from 0 to 360",
                "doc#/mask | \"31\" (string) | a string that matches ^0x[0-9a-f]+$",
                "doc#/watchdog/address | 65536 (integer) | an integer from 0 to 65535"});
}

TEST_CASE("a value of the wrong type is one fault, whatever its parts", "[faults]") {
  CHECK(faults("[1, 2]") == Lines{"doc# | an array of 2 elements | an object"});
  CHECK(faults_with("axes", R"({"unit": 0})") == Lines{"doc#/axes | an object of 1 member | an array of at least 2 elements"});
  CHECK(faults_with("reference", "1.5") == Lines{"doc#/reference | 1.5 (number) | an object"});
  CHECK(faults_with("limits", "[0]") == Lines{"doc#/limits | an array of 1 element | an array of 2 elements"});
  CHECK(faults_with("limits", "[true, null]") == Lines{"doc#/limits/0 | true (boolean) | a number", "doc#/limits/1 | null | a number"});
}

TEST_CASE("each missing member is a fault of its own", "[faults]") {
  CHECK(faults_with("axes", R"([{}, {"unit": 1, "speed_deg_per_s": 1}])") ==
        Lines{"doc#/axes/0 | no member \"unit\" | \"unit\": an integer from 1 to 247",
              "doc#/axes/0 | no member \"speed_deg_per_s\" | \"speed_deg_per_s\": a number from 0 to 360"});
}

TEST_CASE("types are strict, and a number without a fraction is an integer", "[faults]") {
  CHECK(faults_with("reference", R"({"f_per_sr": "0.3"})") == Lines{"doc#/reference/f_per_sr | \"0.3\" (string) | a number above 0"});
  CHECK(faults_with("reference", R"({"f_per_sr": 0})") == Lines{"doc#/reference/f_per_sr | 0 (integer) | a number above 0"});
  CHECK(faults_with("watchdog", R"({"address": 1.0})") == Lines{});
  CHECK(faults_with("watchdog", R"({"address": 1.5})") == Lines{"doc#/watchdog/address | 1.5 (number) | an integer from 0 to 65535"});
}

TEST_CASE("of alternatives the one that was meant is explained", "[faults]") {
  CHECK(faults_with("watchdog", "\"none\"") == Lines{"doc#/watchdog | \"none\" (string) | null or an object"});
  CHECK(faults_with("watchdog", "{}") == Lines{"doc#/watchdog | no member \"address\" | \"address\": an integer from 0 to 65535"});
  CHECK(faults_with("pattern", R"({"kind": "density", "points": "many"})") ==
        Lines{"doc#/pattern/points | \"many\" (string) | an integer"});
  CHECK(faults_with("pattern", R"({"kind": "grid", "points": 5})") ==
        Lines{"doc#/pattern | no member \"step_deg\" | \"step_deg\": a number"});
  CHECK(faults_with("pattern", R"({"kind": "spiral"})") == Lines{"doc#/pattern/kind | \"spiral\" (string) | \"grid\" or \"density\""});
}

TEST_CASE("a value that fits several of exclusive alternatives is a fault", "[faults]") {
  CHECK(faults("5", R"({"oneOf": [{"type": "integer"}, {"minimum": 2}]})") ==
        Lines{"doc# | 5 (integer) that fits several alternatives | exactly one of them"});
}

TEST_CASE("members by pattern, repeated elements and names with special characters", "[faults]") {
  CHECK(faults_with("correlated", R"({"scale": "x", "B/~": 1})") ==
        Lines{"doc#/correlated/scale | \"x\" (string) | a number", "doc#/correlated/B~1~0 | an unknown member | no members"});
  CHECK(faults_with("names", R"(["a", "b", "a"])") == Lines{"doc#/names | an array of 3 elements | an array, all different"});
}

TEST_CASE("a condition is explained by its consequence", "[faults]") {
  constexpr std::string_view schema = R"({"allOf": [{"if": {"properties": {"k": {"const": 1}}}, "then": {"required": ["a"]},
                                                     "else": {"properties": {"a": {"type": "null"}}}}]})";
  CHECK(faults(R"({"k": 1, "a": 2})", schema) == Lines{});
  CHECK(faults(R"({"k": 1})", schema) == Lines{"doc# | no member \"a\" | \"a\""});
  CHECK(faults(R"({"k": 2, "a": 2})", schema) == Lines{"doc#/a | 2 (integer) | null"});
}

TEST_CASE("a very long string is a fault before any pattern is tried on it", "[faults]") {
  CHECK(faults_with("mask", "\"0x" + std::string(4094, '1') + "\"") == Lines{});
  const Lines lines = faults_with("mask", "\"0x" + std::string(1'000'000, '1') + "\"");
  CHECK(lines == Lines{"doc#/mask | a string of 1000002 bytes | at most 4096"});
}

TEST_CASE("the built-in schemas say nothing against an empty list of faults only when the document is valid", "[faults]") {
  const Json fit = gonio::parse_json(gonio::example_text("converged.fit.json"), "fit");
  CHECK(gonio::faults_of(fit, gonio::Schema::fit, "fit").empty());
  CHECK_FALSE(gonio::faults_of(fit, gonio::Schema::checks, "fit").empty());
  CHECK_FALSE(gonio::faults_of(Json(), gonio::Schema::fit, "fit").empty());
}

TEST_CASE("documents are validated and explained from several threads", "[faults]") {
  Json wrong = gonio::parse_json(gonio::example_text("converged.fit.json"), "fit");
  wrong.set("n_masked", -1);
  std::atomic<std::size_t> count{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 10; ++k) count += gonio::faults_of(wrong, gonio::Schema::fit, "fit").size();
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(count == 40);
}
