// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_image.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstdint>

#include "brdf/error.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

TEST_CASE("A picture is an OpenEXR file with its channels and attributes; a name that cannot be written leaves nothing") {
  const test::TemporaryFolder folder;
  const ExrImage image{2, 2, {{"Y", {1, 2, 3, 4}}, {"f.550nm", {0, 0, 0, 0}}}, {{"theta_i_deg", "30"}}};
  write_exr_image(image, folder / "a.exr");
  const std::string bytes = test::read_file(folder / "a.exr");
  CHECK(bytes.starts_with("\x76\x2f\x31\x01"));  // the magic number of the format
  for (const char* text : {"f.550nm", "gonio.theta_i_deg"}) CHECK(bytes.find(text) != std::string::npos);
  CHECK_THROWS_AS(write_exr_image(image, folder / "no" / "such" / "folder.exr"), Error);
  CHECK_THROWS_AS(write_exr_image(ExrImage{0, 0, {}, {}}, folder / "b.exr"), Error);
  CHECK_FALSE(std::filesystem::exists(folder / "b.exr"));
}

TEST_CASE("Half numbers and lossless compressions are read, integers and numbers that the file cannot hold are not") {
  const test::TemporaryFolder folder;
  const auto write = [&](Imf::PixelType type, Imf::Compression compression, int width) {
    Imf::Header header(width, 1, 1, {0, 0}, 1, Imf::INCREASING_Y, compression);
    header.channels().insert("Y", Imf::Channel(type));
    std::vector<half> halves(static_cast<std::size_t>(width), half(0.5F));
    std::vector<unsigned> integers(static_cast<std::size_t>(width), 1);
    Imf::FrameBuffer frame;
    if (type == Imf::HALF)
      frame.insert("Y", Imf::Slice(type, reinterpret_cast<char*>(halves.data()), sizeof(half), 0));
    else
      frame.insert("Y", Imf::Slice(type, reinterpret_cast<char*>(integers.data()), sizeof(unsigned), 0));
    Imf::OutputFile file((folder / "x.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(1);
  };
  for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    write(Imf::HALF, compression, 3);
    CHECK(read_exr_image(folder / "x.exr").channels[0].second == std::vector<float>{0.5F, 0.5F, 0.5F});
  }
  write(Imf::UINT, Imf::ZIP_COMPRESSION, 3);
  CHECK_THROWS_AS(read_exr_image(folder / "x.exr"), Error);
  write(Imf::HALF, Imf::B44_COMPRESSION, 3);
  CHECK_THROWS_AS(read_exr_image(folder / "x.exr"), Error);
  write(Imf::HALF, Imf::NO_COMPRESSION, 3);
  // The same file with a picture of 2^20 pixels in its header.
  std::string bytes = test::read_file(folder / "x.exr");
  const std::size_t window = bytes.find("dataWindow") + 11 + 6 + 4;
  const std::int32_t last = (1 << 20) - 1;
  bytes.replace(window + 8, sizeof last, reinterpret_cast<const char*>(&last), sizeof last);
  const std::string faults = test::faults_of([&] { read_exr_image(folder.file("y.exr", bytes)); });
  INFO(faults);
  CHECK(faults.find("cannot hold more") != std::string::npos);
}
