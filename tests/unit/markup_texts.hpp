// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace brainshift::test {

/// Of a markups file; the position as its text.
struct MarkupPoint {
  std::string label, position;
};

/// As 3D Slicer 5 writes it.
inline std::string mrk_json(const std::string& system, const std::vector<MarkupPoint>& points) {
  std::string text = R"({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/)"
                     R"(Resources/Schema/markups-schema-v1.0.3.json#", "markups": [{"type": "Fiducial", )"
                     R"("coordinateSystem": )" +
                     system + R"(, "coordinateUnits": "mm", "controlPoints": [)";
  for (std::size_t n = 0; n < points.size(); ++n) {
    text += (n == 0 ? "" : ", ") + std::string(R"({"id": "1", "label": ")") + points[n].label + R"(", "position": [)" +
            points[n].position + R"(], "orientation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "positionStatus": "defined"})";
  }
  return text + "]}]}\n";
}

inline std::string fcsv(const std::string& system, const std::string& points) {
  return "# Markups fiducial file version = 4.11\n# CoordinateSystem = " + system +
         "\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n" + points;
}

}  // namespace brainshift::test
