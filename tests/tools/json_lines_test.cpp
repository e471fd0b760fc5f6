// SPDX-License-Identifier: BSD-3-Clause
#include "tools/json_lines.hpp"

#include <random>
#include <string>

#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using tools::JsonLines;

namespace {

const std::string good = parse_json(example_text("failed.fit-line.json"), "example").dump(-1) + "\n";

void resume(const std::filesystem::path& path) { JsonLines(path, Schema::fit_line, true); }

}  // namespace

TEST_CASE("lines that were written stand there on resuming, and no file is overwritten") {
  const test::TemporaryFolder folder;
  const Json line = parse_json(good, "line");
  {
    JsonLines lines(folder / "a.jsonl", Schema::fit_line, false);
    CHECK(lines.standing().empty());
    lines.append(line);
    lines.append(line);
    CHECK_THROWS_AS(resume(folder / "a.jsonl"), Error);  // open already
  }
  CHECK(test::read_file(folder / "a.jsonl") == good + good);
  CHECK_THROWS_AS(JsonLines(folder / "a.jsonl", Schema::fit_line, false), Error);
  JsonLines again(folder / "a.jsonl", Schema::fit_line, true);
  CHECK(again.standing().size() == 2);
  again.append(line);
  CHECK(test::read_file(folder / "a.jsonl") == good + good + good);
}

TEST_CASE("a torn last line is cut off wherever it is torn") {
  const test::TemporaryFolder folder;
  for (std::size_t length = 0; length < good.size(); ++length) {
    const auto path = folder.file("torn.jsonl", good + good.substr(0, length));
    const bool whole = length == good.size() - 1;  // only the line feed is missing
    JsonLines lines(path, Schema::fit_line, true);
    INFO(length);
    CHECK(lines.standing().size() == (whole ? 2 : 1));
    CHECK(test::read_file(path) == (whole ? good + good : good));
  }
  const auto zeros = folder.file("zeros.jsonl", good + std::string(100, '\0'));
  resume(zeros);
  CHECK(test::read_file(zeros) == good);
}

TEST_CASE("a file that is something else is refused with its wrong lines and stays as it was") {
  const test::TemporaryFolder folder;
  for (const std::string& text : {std::string("notes of mine"), "{\n" + good, good + "{}\n" + good, good + "[1, 2]", "x\n" + good}) {
    const auto path = folder.file("mine.txt", text);
    CHECK_THROWS_AS(resume(path), Error);
    CHECK(test::read_file(path) == text);
  }
}

TEST_CASE("mutated lines are read or refused, and only a torn end is ever removed") {
  constexpr unsigned seed = 20261123;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  const test::TemporaryFolder folder;
  int read = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = good + good + good;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0: text[at] = static_cast<char>(random() % 256); break;
        case 1: text.erase(at, 1 + random() % 20); break;
        case 2: text.insert(at, 1, "{}[]\",:\n0\\"[random() % 10]); break;
        default: text.resize(at + 1);
      }
      if (text.empty()) text = "{";
    }
    const auto path = folder.file("mutated.jsonl", text);
    try {
      resume(path);
      ++read;
      const std::string kept = test::read_file(path);
      CHECK((kept.empty() || kept.back() == '\n'));
      CHECK((text + "\n").starts_with(kept));
    } catch (const Error& error) {
      ++refused;
      CHECK(error.kind() == ErrorKind::input);
      CHECK(test::read_file(path) == text);
    }
  }
  CHECK(read > 100);
  CHECK(refused > 100);
}
