// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/exr_image.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/brdf_exr_channels.hpp"

namespace gonio::tabulated {

void write_exr_image(const ExrImage& image, const std::filesystem::path& path) {
  std::string bytes;
  try {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height), 1, {0, 0}, 1, Imf::INCREASING_Y,
                       Imf::ZIP_COMPRESSION);
    Imf::FrameBuffer frame;
    for (const auto& [name, values] : image.channels) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      // The library takes a pointer to non-const for reading and writing alike; here it only reads.
      char* data = const_cast<char*>(reinterpret_cast<const char*>(values.data()));
      frame.insert(name, Imf::Slice(Imf::FLOAT, data, sizeof(float), sizeof(float) * image.width));
    }
    for (const auto& [key, value] : image.attributes) header.insert(exr_attribute_prefix + key, Imf::StringAttribute(value));
    Imf::StdOSStream stream;
    {
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(frame);
      file.writePixels(static_cast<int>(image.height));
    }
    bytes = stream.str();
  } catch (const std::exception& error) {
    throw Error(ErrorKind::input, {path.string(), error.what(), "a picture that OpenEXR can hold"});
  }
  write_file_atomically(path, bytes);
}

}  // namespace gonio::tabulated
