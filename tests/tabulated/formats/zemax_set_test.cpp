// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/zemax_set.hpp"

#include <cmath>

#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::read_file;
using gonio::test::replaced;
using gonio::test::TemporaryFolder;

namespace {

Opened coloured() { return test::source_of_model("phong", rgb_channels(), {{0.1, 0.3, 5}, {0.2, 0.2, 5}, {0.3, 0.1, 5}}); }

WriteOptions paper() {
  WriteOptions options;
  options.size = GridSize::paper;
  return options;
}

}  // namespace

TEST_CASE("A coloured source becomes a monochrome file per channel, and any of them opens all") {
  const TemporaryFolder scratch;
  const Opened source = coloured();
  const ExportNotes notes = write_zemax_set(source, scratch / "m.bsdf", paper());
  CHECK(notes.files == std::vector{scratch / "m-r.bsdf", scratch / "m-g.bsdf", scratch / "m-b.bsdf"});
  CHECK_FALSE(std::filesystem::exists(scratch / "m.bsdf"));
  CHECK(read_file(scratch / "m-g.bsdf").find("SpectralContent\tMonochrome") != std::string::npos);
  for (const auto& file : notes.files) {
    const Opened read = open_brdf(file);
    REQUIRE(read.brdf->channels() == rgb_channels());
    for (std::size_t k = 0; k < read.dataset->size(); k += 37) {
      const GonioAngles& at = read.dataset->angles[k];
      const std::vector<double> exact = source.brdf->eval(at.wi(), at.wo());
      constexpr double to_float = 1e-5;  // of values, and of angles in the digits of a file
      for (std::size_t c = 0; c < 3; ++c) REQUIRE(std::fabs(read.dataset->f[c][k] - exact[c]) <= to_float * exact[c]);
    }
    CHECK(read.dataset->provenance.at("comments").find("Channel") == std::string::npos);
    // Written as a set once more the files are the same.
    write_zemax_set(read, scratch / "again.bsdf", {});
    CHECK(read_file(scratch / "again-b.bsdf") ==
          replaced(replaced(read_file(scratch / "m-b.bsdf"), "m-r.", "again-r."), "m-g.", "again-g."));
  }
}

TEST_CASE("A file whose set is not complete is read alone and says so; one of another grid or set is refused") {
  const TemporaryFolder scratch;
  write_zemax_set(coloured(), scratch / "m.bsdf", paper());
  const std::string green = read_file(scratch / "m-g.bsdf");
  std::filesystem::remove(scratch / "m-g.bsdf");
  const Opened read = open_brdf(scratch / "m-b.bsdf");
  REQUIRE(read.brdf->channels().size() == 1);
  CHECK(read.brdf->channels()[0].name == "b");
  CHECK(read.info.back().second.find("m-g.bsdf") != std::string::npos);
  const auto with_green = [&](const std::string& text) {
    scratch.file("m-g.bsdf", text);
    return faults_of([&] { open_brdf(scratch / "m-b.bsdf"); });
  };
  CHECK(with_green(replaced(green, "\t89\n", "\t88\n")).find("m-g.bsdf|other angles") != std::string::npos);
  CHECK(with_green(replaced(green, "Channel 2 of 3 = g", "Channel 2 of 3 = r")).find("channel r a second time") != std::string::npos);
  CHECK(with_green(replaced(green, "# Channel 2", "# channel 2")).find("a file of another set") != std::string::npos);
  CHECK(with_green(replaced(green, "TIS", "TOS")).find("m-g.bsdf:") != std::string::npos);
  CHECK(with_green(green).empty());
}

TEST_CASE("A source of one channel is one file; channels whose files would be the same are refused") {
  const TemporaryFolder scratch;
  const Opened grey = test::source_of_model("phong", single_channel("value"), {{0.1, 0.3, 5}});
  CHECK(write_zemax_set(grey, scratch / "m.bsdf", paper()).files == std::vector{scratch / "m.bsdf"});
  Channels twins{single_channel("a b").front(), single_channel("a/b").front()};
  CHECK(zemax_set_files("x/m.bsdf", {twins[0]}).front() == std::filesystem::path("x/m-a_b.bsdf"));
  CHECK(faults_of([&] { zemax_set_files("m.bsdf", twins); }).find("different names") != std::string::npos);
}

TEST_CASE("Comments name a set only if they name every channel once and no other folder") {
  const std::vector<std::string> good{" Channel 1 of 2 = r", "other", " Channel 2 of 2 in m-g.bsdf\r"};
  const auto place = zemax_set_place(good);
  REQUIRE(place);
  CHECK(place->number == 1);
  CHECK(place->channel == "r");
  CHECK(place->files[1] == "m-g.bsdf");
  CHECK(zemax_set_comments(*place) == std::vector<std::string>{" Channel 1 of 2 = r", " Channel 2 of 2 in m-g.bsdf"});
  const auto refused = [&](std::size_t line, const char* text) {
    std::vector<std::string> comments = good;
    comments[line] = text;
    return !zemax_set_place(comments);
  };
  CHECK(refused(0, "nothing"));
  CHECK(refused(0, " Channel 1 of 2 in m-r.bsdf"));  // no channel of its own
  CHECK(refused(0, " Channel 3 of 2 = r"));
  CHECK(refused(0, " Channel 1 of 99999999999999999999 = r"));
  CHECK(refused(2, " Channel 2 of 2 = g"));  // two of its own
  CHECK(refused(2, " Channel 2 of 3 in m-g.bsdf"));
  CHECK(refused(2, " Channel 2 of 2 in ../m-g.bsdf"));
  CHECK(refused(2, " Channel 1 of 2 in m-g.bsdf"));
}

TEST_CASE("No damaged set does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string text =
      "# Channel 1 of 2 = r\n# Channel 2 of 2 in g.bsdf\nSource\tMeasured\nSymmetry\tPlaneSymmetrical\nSpectralContent\tMonochrome\n"
      "ScatterType\tBRDF\nSampleRotation\t1\n0\nAngleOfIncidence\t2\n10\t30\nScatterAzimuth\t2\n0\t180\nScatterRadial\t2\n0\t20\n\n"
      "Monochrome\nDataBegin\nTIS\t0.125\n4\t2\n4\t2\nTIS\t0.25\n5\t2\n5\t2\nDataEnd\n";
  scratch.file("g.bsdf", replaced(replaced(text, "1 of 2 = r", "1 of 2 in r.bsdf"), "2 of 2 in g.bsdf", "2 of 2 = g"));
  ReadOptions options;
  options.format = "zemax";
  const auto [read, refused] = test::read_damaged({text}, "0123456789 .-=/#\nChanelofin\r", 20260712, 2000, [&](const std::string& bytes) {
    open_brdf(scratch.file("r.bsdf", bytes), options).dataset->require_consistent();
  });
  CHECK(read > 100);
  CHECK(refused > 300);
}
