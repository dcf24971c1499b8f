// SPDX-License-Identifier: GPL-3.0-or-later
//
// Septa through the program: from a file and from a label map, what they change, and those that cannot be.
#include <nlohmann/json.hpp>

#include "segmentation/files/surface_file.hpp"
#include "segmentation/geometry/surface.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/bad_input.hpp"

namespace brainshift::septum_test {

constexpr double centre = bad_input::grid / 2 * bad_input::voxel;  // of the ball, mm

class Septum : public bad_input::BadInput {
 protected:
  /// A cell has one point in the scene, which is too few for the nodes on both sides of a sheet.
  static constexpr const char* to_solution = " --until solve --set solve.points_per_cell=8";

  /// The scene with an element before its contact, and options after the name.
  static std::string with(const std::string& element, const std::string& scene = "scene.xml") {
    std::string text = bytes_of(at(scene));
    text.insert(text.find("<contact/>"), element + "\n");
    write_text(at("septum.xml"), text);
    return run_scene("septum.xml") + to_solution;
  }
  static void run(const std::string& command) {
    std::filesystem::remove_all(at("out"));
    const ProgramResult result = run_shell(command);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static nlohmann::json measures() {
    return nlohmann::json::parse(bytes_of(at("out/solve/stage.json")))["entry"]["measures"];
  }
  /// Of the displacement behind the sheet, in the upper part of the ball.
  static double mean_beyond(double from) {
    const Solution solution = read_solution(at("out/solve/solution.vtu"));
    double sum = 0;
    int nodes = 0;
    for (Eigen::Index a = 0; a < solution.positions.rows(); ++a) {
      if (solution.positions(a, 0) > from && solution.positions(a, 2) > centre + 10) {
        sum += solution.displacement.row(a).norm();
        ++nodes;
      }
    }
    return sum / nodes;
  }
  /// A sheet in the plane x = centre + 12 from z = centre - 10 up.
  static void write_falx(const std::string& name, double away = 0) {
    Surface sheet{Points(4, 3), Triangles(2, 3)};
    const double x = centre + 12 + away, low = centre - 10, high = centre + 60;
    sheet.vertices << x, centre - 60, low, x, centre + 60, low, x, centre + 60, high, x, centre - 60, high;
    sheet.triangles << 0, 1, 2, 0, 2, 3;
    write_surface(at(name), sheet);
  }
};

TEST_F(Septum, FromAFileHoldsTheOtherSideBack) {
  write_falx("falx.vtp");
  run(run_scene("scene.xml") + to_solution);
  const double without = mean_beyond(centre + 13);
  EXPECT_FALSE(measures().contains("septum"));
  EXPECT_FALSE(std::filesystem::exists(at("out/solve/septum.vtp")));
  run(with("<septum file=\"falx.vtp\"/>"));
  EXPECT_LT(mean_beyond(centre + 13), 0.8 * without);
  EXPECT_EQ(read_surface(at("out/solve/septum.vtp")).triangles.rows(), 2);
  EXPECT_GT(measures()["septum"]["face_nodes"], 20);
  EXPECT_GT(measures()["estimated_error_95_mm"], 0.0);
  EXPECT_LT(measures()["septum"]["largest_penetration_mm"], 0.1);
}

/// The ball in two hemispheres of cortex with a core of white matter.
LabelMap hemispheres() {
  LabelMap map = bad_input::ball_labels();
  for (int k = 0; k < bad_input::grid; ++k) {
    for (int j = 0; j < bad_input::grid; ++j) {
      for (int i = 0; i < bad_input::grid; ++i) {
        const Eigen::Vector3d x = (Eigen::Vector3d(i, j, k).array() * bad_input::voxel - centre).matrix();
        if (std::uint16_t& label = map.at(i, j, k); label != 0) {
          const bool left = x.x() >= 0, white = x.norm() < 22;
          label = static_cast<std::uint16_t>(white ? (left ? 2 : 41) : (left ? 3 : 42));
        }
      }
    }
  }
  return map;
}

TEST_F(Septum, FromTheLabelMapLiesBetweenTheHemispheres) {
  write_image(at("hemispheres.nii.gz"), hemispheres());
  write_text(at("labelled.xml"),
             "<scene>\n<image labels=\"hemispheres.nii.gz\" labels_are=\"freesurfer\"/>\n"
             "<load><craniotomy file=\"load.csv\"/></load>\n<contact/>\n"
             "<stage name=\"segment\" edge_length=\"12\"/>\n<stage name=\"discretise\" nodes=\"250\"/>\n"
             "<stage name=\"solve\" basis=\"linear\" points_per_cell=\"1\" tolerance=\"0.1\"/>\n</scene>\n");
  run(with("<septa/>", "labelled.xml"));
  const Surface septa = read_surface(at("out/segment/septa.vtp"));
  EXPECT_LT((septa.vertices.col(0).array() - (centre - bad_input::voxel / 2)).abs().maxCoeff(), 2);
  EXPECT_EQ(measures()["septum"]["area_mm2"], area(read_surface(at("out/solve/septum.vtp"))));
  const ProgramResult explained = run_shell("brainshift scene --explain " + at("septum.xml"));
  EXPECT_NE(explained.out.find("septa: active, named in"), std::string::npos) << explained.out << explained.err;
  EXPECT_NE(explained.out.find("septum: not built"), std::string::npos);
}

TEST_F(Septum, ThatCannotBeIsRefused) {
  expect_refused(with("<septum file=\"none.vtp\"/>"), {"septum.xml:5", "none.vtp", "does not exist"});
  expect_refused(with("<septum/>"), {"septum.xml:5", "file"});
  expect_refused(with("<septum file=\"load.csv\"/>"), {"septum.xml:5", "load.csv"});
  write_falx("falx.vtp");
  expect_refused(with("<septa/><septum file=\"falx.vtp\"/>"), {"septum.xml:5", "both <septa>", "<septum>"});
  expect_refused(with("<septa/>"), {"septum.xml:5", "neither hemisphere", "FreeSurfer"});
  write_falx("far.vtp", 300);
  expect_refused(with("<septum file=\"far.vtp\"/>"), {"far.vtp", "does not meet the body"});
  expect_refused(with("<septum file=\"falx.vtp\"/>") + " --set solve.region=1", {"--set", "region", "a septum"});
}

}  // namespace brainshift::septum_test
