// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/exr_image.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/formats/brdf_exr_channels.hpp"
#include "tabulated/formats/exr_header.hpp"

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

ExrImage read_exr_image(const std::filesystem::path& path) {
  require_sound_exr_header(path);
  const auto refused = [&](const std::string& found, const char* wanted) {
    return Error(ErrorKind::input, {path.string(), found, wanted});
  };
  try {
    Imf::InputFile file(path.c_str(), 0);
    const Imf::Header& header = file.header();
    const Imath::Box2i& window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1, height = std::int64_t{window.max.y} - window.min.y + 1;
    const auto limit = static_cast<std::int64_t>(max_image_pixels);
    if (window.min != Imath::V2i(0, 0) || width < 1 || height < 1 || width > limit || height > limit / width)
      throw refused(fmt::format("{} x {} pixels from ({}, {})", width, height, window.min.x, window.min.y),
                    "at most 2^24 pixels from (0, 0)");
    if (header.compression() > Imf::PIZ_COMPRESSION) throw refused("compression with loss", "ZIP, PIZ, RLE or no compression");

    ExrImage out;
    out.width = static_cast<std::size_t>(width), out.height = static_cast<std::size_t>(height);
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      constexpr std::size_t most_channels = 4096;
      if (channel.channel().type == Imf::UINT || channel.channel().xSampling != 1 || channel.channel().ySampling != 1 ||
          out.channels.size() == most_channels)
        throw refused(fmt::format("a channel {} of integers or not of every pixel, or too many", channel.name()),
                      "channels of floats, one number per pixel");
      out.channels.emplace_back(channel.name(), std::vector<float>());
    }
    if (out.channels.empty() || out.width * out.height > max_image_pixels / out.channels.size())
      throw refused(fmt::format("{} channels of {} x {} pixels", out.channels.size(), width, height), "at most 2^24 numbers");
    Imf::FrameBuffer frame;
    for (auto& [name, values] : out.channels) {
      values.resize(out.width * out.height);
      frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * out.width));
    }
    file.setFrameBuffer(frame);
    file.readPixels(0, static_cast<int>(height) - 1);
    const std::string prefix = exr_attribute_prefix;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
          text != nullptr && std::string(attribute.name()).starts_with(prefix))
        out.attributes.emplace_back(std::string(attribute.name()).substr(prefix.size()), text->value());
    return out;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw refused(error.what(), "a whole OpenEXR file");
  }
}

}  // namespace gonio::tabulated
