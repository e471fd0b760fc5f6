// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/radiance_xml_write.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "brdf/error.hpp"
#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

/// More than this of the light coming back is more than the file's own rounding; Radiance notes it and goes on.
constexpr double energy_limit = 1.01;

std::string basis_text(const KlemsBasis& basis) {
  std::string out = fmt::format("\t<AngleBasis>\n\t\t<AngleBasisName>{}</AngleBasisName>\n", basis.name());
  for (const PatchRing& ring : basis.rings())
    out += fmt::format(
        "\t\t<AngleBasisBlock>\n\t\t\t<Theta>{}</Theta>\n\t\t\t<nPhis>{}</nPhis>\n\t\t\t<ThetaBounds>\n\t\t\t\t<LowerTheta>{}</"
        "LowerTheta>\n"
        "\t\t\t\t<UpperTheta>{}</UpperTheta>\n\t\t\t</ThetaBounds>\n\t\t</AngleBasisBlock>\n",
        ring.patches == 1 ? 0 : 0.5 * (ring.lower_deg + ring.upper_deg), ring.patches, ring.lower_deg, ring.upper_deg);
  return out + "\t</AngleBasis>\n";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&')
      out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&amp;";
    else if (static_cast<unsigned char>(c) >= ' ')
      out += c;
  }
  return out;
}

}  // namespace

std::string radiance_document(const std::string& structure, const KlemsBasis* basis, const std::string& material,
                              const std::vector<RadianceBlock>& blocks) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<WindowElement xmlns=\"http://windows.lbl.gov\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:schemaLocation=\"http://windows.lbl.gov/BSDF-v1.4.xsd\">\n"
      "<WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n<Optical>\n<Layer>\n"
      "<Material>\n\t<Name>{}</Name>\n\t<Manufacturer>gonio</Manufacturer>\n\t<DeviceType>Other</DeviceType>\n</Material>\n"
      "<DataDefinition>\n\t<IncidentDataStructure>{}</IncidentDataStructure>\n{}</DataDefinition>\n",
      escaped(material), structure, basis ? basis_text(*basis) : "");
  const std::string bases =
      basis ? fmt::format("\t\t<ColumnAngleBasis>{0}</ColumnAngleBasis>\n\t\t<RowAngleBasis>{0}</RowAngleBasis>\n", basis->name())
            : "\t\t<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n";
  for (const RadianceBlock& block : blocks) {
    out += fmt::format(
        "<WavelengthData>\n\t<LayerNumber>System</LayerNumber>\n\t<Wavelength unit=\"Integral\">{}</Wavelength>\n"
        "\t<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>\n\t<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n"
        "\t<WavelengthDataBlock>\n\t\t<WavelengthDataDirection>Reflection {}</WavelengthDataDirection>\n{}"
        "\t\t<ScatteringDataType>BTDF</ScatteringDataType>\n\t\t<ScatteringData>\n",
        block.wavelength, block.front ? "Front" : "Back", bases);
    out += block.data;
    out += "\t\t</ScatteringData>\n\t</WavelengthDataBlock>\n</WavelengthData>\n";
  }
  return out + "</Layer>\n</Optical>\n</WindowElement>\n";
}

ChannelMap radiance_channels(const Opened& source) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {"the source", fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (source.side == Side::transmission)
    throw Error(ErrorKind::input, {"the source", fmt::format("the transmission of a {}", source.format), "reflection"});
  return source.brdf->channels().size() == 1 ? one_channel(source.brdf->channels()) : map_to_rgb(source.brdf->channels());
}

void RadianceMeans::add(const RadianceMeans& other) {
  unknown += other.unknown, negative += other.negative, unsettled += other.unsettled;
  largest_unsettled = std::max(largest_unsettled, other.largest_unsettled);
  for (std::size_t c = 0; c < hemispherical.size(); ++c) hemispherical[c] = std::max(hemispherical[c], other.hemispherical[c]);
}

std::array<double, 3> written_mean(std::array<double, 3> f, bool known, double unsettled, RadianceMeans& means) {
  means.unknown += known ? 0 : 1;
  means.unsettled += unsettled > 0 ? 1 : 0;
  means.largest_unsettled = std::max(means.largest_unsettled, unsettled);
  means.negative += std::any_of(f.begin(), f.end(), [](double value) { return value < 0; }) ? 1 : 0;
  for (double& value : f) value = std::max(0.0, value);
  return f;
}

void note_means(const RadianceMeans& means, const ChannelMap& map, ExportNotes& notes) {
  notes.facts.emplace_back("directions", "Reflection Back (Radiance's outward side) and Reflection Front (the sheet turned over)");
  if (map.to.size() == 3) notes.facts.emplace_back("colour", "r, g, b taken as Radiance's: grey stays grey");
  if (!map.changed.empty()) notes.lost.push_back(map.changed);
  notes.lost.emplace_back("what varies inside a cell: the file holds means weighted by projected solid angle");
  if (means.unknown > 0) notes.lost.push_back(fmt::format("{} means of which nothing is known are written as 0", means.unknown));
  if (means.negative > 0) notes.lost.push_back(fmt::format("{} negative means are written as 0", means.negative));
  if (means.unsettled > 0)
    notes.lost.push_back(fmt::format("{} means have not settled; the last two rules differ by up to {:.2g} %", means.unsettled,
                                     100 * means.largest_unsettled));
  const double largest = *std::max_element(means.hemispherical.begin(), means.hemispherical.end());
  notes.facts.emplace_back("largest hemispherical reflectance", fmt::format("{:.4g}", largest));
  if (largest > energy_limit)
    notes.lost.push_back(fmt::format("energy: some light comes back {:.4g} times; Radiance takes the file and notes it", largest));
}

}  // namespace gonio::tabulated
