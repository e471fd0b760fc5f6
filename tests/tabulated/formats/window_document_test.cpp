// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/window_document.hpp"

#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

std::string block(const std::string& wavelength, const std::string& direction, const std::string& data) {
  return "<WavelengthData>\n<Wavelength unit=\"Integral\">" + wavelength + "</Wavelength>\n<WavelengthDataBlock>\n" +
         "<WavelengthDataDirection>" + direction + "</WavelengthDataDirection>\n<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n" +
         "<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>" + data + "</ScatteringData>\n</WavelengthDataBlock>\n" +
         "</WavelengthData>\n";
}

std::string document(const std::string& blocks, const std::string& structure = "TensorTree3") {
  return "<?xml version=\"1.0\"?>\n<WindowElement>\n<WindowElementType>System</WindowElementType>\n<Optical>\n<Layer>\n"
         "<Material><Name>Shade</Name><Manufacturer>Somebody</Manufacturer></Material>\n<DataDefinition>\n"
         "<IncidentDataStructure>" +
         structure + "</IncidentDataStructure>\n</DataDefinition>\n" + blocks + "</Layer>\n</Optical>\n</WindowElement>\n";
}

std::string faults_in(const std::string& text) {
  const test::TemporaryFolder scratch;
  const auto path = scratch.file("sheet.xml", text);
  return test::faults_of([&] {
    FaultList faults(path.string());
    read_window_document(path, faults);
    faults.raise();
  });
}

}  // namespace

TEST_CASE("Blocks are found with their wavelength, side, text and line, whatever the case of the words") {
  const test::TemporaryFolder scratch;
  const std::string text = document(block("Visible", "Reflection Back", "{1}") + block("Solar", "transmission front", "{0.5}"));
  const auto path = scratch.file("sheet.xml", text);
  FaultList faults(path.string());
  const WindowDocument read = read_window_document(path, faults);
  REQUIRE(faults.empty());
  CHECK(read.structure == WindowStructure::tree3);
  CHECK(read.material == "Shade");
  CHECK(read.manufacturer == "Somebody");
  REQUIRE(read.blocks.size() == 2);
  CHECK(read.blocks[0].wavelength == "Visible");
  CHECK(read.blocks[0].side.name() == "Reflection Back");
  CHECK(read.blocks[0].data == "{1}");
  CHECK(read.blocks[1].side.name() == "Transmission Front");
  for (const WindowBlock& one : read.blocks) {
    CHECK(text.substr(one.data_offset, one.data.size()) == one.data);
    CHECK(line_at(text, text.find("<WavelengthDataBlock>", one.data_offset - 250)) == one.line);
  }
}

TEST_CASE("What a document cannot do without is named; document types are refused") {
  CHECK(faults_in(document(block("Visible", "Reflection Back", "{1}"))).empty());
  CHECK(faults_in(document("")) != "");
  CHECK(faults_in(document(block("Visible", "Reflection Sideways", "{1}"))).find("Sideways") != std::string::npos);
  CHECK(faults_in(document(block("Visible", "Reflection Back", "{1}"), "Heap")).find("Heap") != std::string::npos);
  CHECK(faults_in("<!DOCTYPE x [<!ENTITY a \"aaaa\">]>\n" + document(block("Visible", "Reflection Back", "{1}"))) != "");
  CHECK(faults_in(document(block("Visible", "Reflection Back", "{1}")).substr(0, 300)) != "");
}
