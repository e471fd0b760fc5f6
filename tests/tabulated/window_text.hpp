// SPDX-License-Identifier: BSD-3-Clause
// XML of WINDOW and Radiance for the tests of its readers.
#pragma once

#include <string>
#include <vector>

namespace gonio::test {

struct WindowTextBlock {
  std::string wavelength = "Visible", direction = "Reflection Back", data;
  std::string basis = "<ColumnAngleBasis>two rings</ColumnAngleBasis><RowAngleBasis>two rings</RowAngleBasis>";
};

/// Five patches: a cap to 30° and four sectors below it.
inline const std::string two_rings =
    "<AngleBasis><AngleBasisName>two rings</AngleBasisName>\n"
    "<AngleBasisBlock><Theta>0</Theta><nPhis>1</nPhis>\n"
    "<ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>30</UpperTheta></ThetaBounds></AngleBasisBlock>\n"
    "<AngleBasisBlock><Theta>60</Theta><nPhis>4</nPhis>\n"
    "<ThetaBounds><LowerTheta>30</LowerTheta><UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock>\n"
    "</AngleBasis>\n";

inline std::string window_text(const std::string& structure, const std::string& basis, const std::vector<WindowTextBlock>& blocks) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<WindowElement xmlns=\"http://windows.lbl.gov\">\n<Optical>\n<Layer>\n"
      "<Material><Name>test</Name></Material>\n<DataDefinition><IncidentDataStructure>" +
      structure + "</IncidentDataStructure>\n" + basis + "</DataDefinition>\n";
  for (const WindowTextBlock& block : blocks)
    out += "<WavelengthData><Wavelength unit=\"Integral\">" + block.wavelength +
           "</Wavelength>\n<WavelengthDataBlock><WavelengthDataDirection>" + block.direction + "</WavelengthDataDirection>" + block.basis +
           "<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>" + block.data +
           "</ScatteringData></WavelengthDataBlock></WavelengthData>\n";
  return out + "</Layer>\n</Optical>\n</WindowElement>\n";
}

}  // namespace gonio::test
