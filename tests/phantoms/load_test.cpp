// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loads of a small synthetic head, through the program: a run's own transforms given back as a load, and points that
// contradict the others. One head serves all, and one run of it with all its points is the truth.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "discretise/interface/node_cloud.hpp"
#include "segmentation/geometry/point_tree.hpp"
#include "segmentation/image/image.hpp"
#include "solve/load/craniotomy_load.hpp"
#include "solve/load/rigid_fit.hpp"
#include "solve/output/solution_file.hpp"
#include "tests/phantoms/program.hpp"
#include "tests/unit/solve/read_rigid.hpp"

namespace brainshift::load_test {

namespace fs = std::filesystem;

class Load : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>();
    const ProgramResult head = run_shell("brainshift phantom --size 64 --spacing 3 --out " + at("head").string());
    ASSERT_EQ(head.code, 0) << head.err;
    const ProgramResult result = run(at("head/scene.xml"), at("truth"), "register");
    ASSERT_EQ(result.code, 0) << result.err;
    measured = solve::read_craniotomy_csv(at("head/craniotomy.csv"));
    truth = read_solution(at("truth/solve/solution.vtu"));
    fs::create_directories(at("other"));
    for (const char* stage : {"segment", "discretise"}) {
      fs::copy(at("truth") / stage, at("other") / stage);
    }
    write_opening();
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static fs::path at(const std::string& name) { return *scratch / name; }
  static ProgramResult run(const fs::path& scene, const fs::path& out, const std::string& until) {
    return run_shell("brainshift run --quiet " + scene.string() +
                     " --set segment.edge_length=8 --set discretise.nodes=900 --set discretise.craniotomy_factor=1 "
                     "--set solve.tolerance=0.02"
                     " --until " +
                     until + " --out " + out.string());
  }
  /// The head's scene with another load, solved on the nodes of the truth.
  static ProgramResult solve_with(const std::string& load) {
    std::string text = bytes_of(at("head/scene.xml"));
    const std::size_t from = text.find("<load>"), to = text.find("</load>");
    text.replace(from, to - from, load);
    write_text(at("head/other.xml"), text);
    return run(at("head/other.xml"), at("other"), "solve");
  }
  static Solution solved_with(const std::string& load) {
    const ProgramResult result = solve_with(load);
    EXPECT_EQ(result.code, 0) << result.err;
    return read_solution(at("other/solve/solution.vtu"));
  }
  static std::string refused(const std::string& load) {
    const ProgramResult result = solve_with(load);
    EXPECT_EQ(result.code, 2) << result.err;
    return result.err;
  }

  /// Markups at the measured points.
  static void write_opening() {
    std::string text = "# CoordinateSystem = LPS\n# columns = id,x,y,z\n";
    for (Eigen::Index p = 0; p < measured.positions.rows(); ++p) {
      text += std::to_string(p);
      for (const double x : measured.positions.row(p)) {
        text += "," + std::to_string(x);
      }
      text += "\n";
    }
    write_text(at("opening.fcsv"), text);
  }
  static std::string field(const std::string& file, const std::string& more = "") {
    return field_all_over(file, " where=\"" + at("opening.fcsv").string() + "\"" + more);
  }
  static std::string field_all_over(const std::string& file, const std::string& more = "") {
    return "<load><field file=\"" + file + "\"" + more + "/>";
  }
  static std::string with_noise(std::string load, const std::string& noise) {
    return load.replace(0, 5, "<load noise=\"" + noise + "\"");
  }
  static std::string written(const std::string& name) { return at("truth/register/" + name).string(); }
  static double voxel_error() {
    return nlohmann::json::parse(bytes_of(at("truth/register/stage.json")))["entry"]["measures"]["fit_error_mm"];
  }
  /// The truth's forward field, off at each node by noise of its own, 1 mm along each axis: a voxel has its node's.
  static void write_noisy_field(const fs::path& file, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1);
    Points off(truth.positions.rows(), 3);
    for (double& u : off.reshaped()) {
      u = noise(random);
    }
    VectorImage noisy = read_vector_image(written("preop_to_intraop.nii.gz"));
    const PointTree nodes(truth.positions);
    for (int k = 0; k < noisy.geometry.size.z(); ++k) {
      for (int j = 0; j < noisy.geometry.size.y(); ++j) {
        for (int i = 0; i < noisy.geometry.size.x(); ++i) {
          const Eigen::Vector3d x = noisy.geometry.to_world(Eigen::Vector3d(i, j, k));
          const auto node = static_cast<Eigen::Index>(nodes.nearest(x.data()).first);
          Eigen::Map<Eigen::RowVector3f>(noisy.at(i, j, k).data()) += off.row(node).cast<float>();
        }
      }
    }
    write_image(file, noisy);
  }

  static std::unique_ptr<ScratchFolder> scratch;
  static solve::CraniotomyLoad measured;
  static Solution truth;
};
std::unique_ptr<ScratchFolder> Load::scratch;
solve::CraniotomyLoad Load::measured;
Solution Load::truth;

/// Below which 95 % of the nodes are off, mm.
double off_95(const Solution& solution, const Solution& from) {
  const Eigen::VectorXd off = (solution.displacement - from.displacement).rowwise().norm();
  std::vector<double> sorted(off.begin(), off.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() * 95 / 100];
}

/// The largest difference of a load from the displacement of the nodes at its points, mm.
double off_nodes(const solve::CraniotomyLoad& load, const Solution& solution) {
  const PointTree tree(solution.positions);
  double most = 0;
  for (Eigen::Index p = 0; p < load.positions.rows(); ++p) {
    const Eigen::RowVector3d x = load.positions.row(p);
    const auto node = static_cast<Eigen::Index>(tree.nearest(x.data()).first);
    most = std::max(most, (load.displacement.row(p) - solution.displacement.row(node)).norm());
  }
  return most;
}

TEST_F(Load, OfItsOwnTransformsGivesARunItsDisplacementsBack) {
  for (const char* name :
       {"preop_to_intraop.nii.gz", "intraop_to_preop.nii.gz", "from-preop_to-intraop_mode-points_xfm.h5",
        "from-preop_to-intraop_mode-image_xfm.h5", "from-preop_to-intraop_mode-image_xfm.nrrd"}) {
    const Solution again = solved_with(field(written(name)));
    const double at_nodes = off_nodes(solve::read_craniotomy_csv(at("other/solve/load.csv")), truth);
    std::printf("%s: surface %.4f mm, brain (95 %%) %.4f mm; voxel error %.4f mm\n", name, at_nodes,
                off_95(again, truth), voxel_error());
    EXPECT_LT(at_nodes, 2 * voxel_error() + 0.02) << name;
    EXPECT_LT(off_95(again, truth), 2 * voxel_error() + 0.02) << name;
  }
}

TEST_F(Load, OfAFieldTakesTheWayThatTheSceneSays) {
  fs::copy(written("intraop_to_preop.nii.gz"), at("warp.nii.gz"), fs::copy_options::overwrite_existing);
  const std::string warp = at("warp.nii.gz").string();
  EXPECT_NE(refused(field(warp)).find("nothing says which way it goes"), std::string::npos);
  EXPECT_LT(off_95(solved_with(field(warp, " moves=\"image\"")), truth), 0.5);
  EXPECT_GT(solved_with(field(warp, " moves=\"points\"")).displacement.norm(), 0);
  EXPECT_GT(off_nodes(solve::read_craniotomy_csv(at("other/solve/load.csv")), truth), 2) << "the brain rises";
  EXPECT_NE(refused(field(written("preop_to_intraop.nii.gz"), " moves=\"image\"")).find("it moves points"),
            std::string::npos);
}

TEST_F(Load, OfAFieldGivesWayToItsNoise) {
  double imposed = 0, weighed = 0;
  for (const unsigned seed : {1, 2}) {
    write_noisy_field(at("noisy.mha"), seed);
    const std::string noisy = field(at("noisy.mha").string(), " moves=\"points\"");
    imposed += off_95(solved_with(noisy), truth) / 2;
    weighed += off_95(solved_with(with_noise(noisy, "1")), truth) / 2;
  }
  std::printf("noise of 1 mm, mean of two draws: brain (95 %%) imposed %.4f, weighed %.4f mm\n", imposed, weighed);
  EXPECT_LT(weighed, 0.85 * imposed);
}

TEST_F(Load, OfAFieldWithoutAnOpeningActsOnAllOfTheSurface) {
  const std::string whole = field_all_over(written("preop_to_intraop.nii.gz"));
  const double exact = off_95(solved_with(whole), truth);
  const solve::CraniotomyLoad load = solve::read_craniotomy_csv(at("other/solve/load.csv"));
  const auto surface = surface_nodes(read_node_cloud(at("truth/discretise/nodes.vtu")));
  EXPECT_EQ(load.positions.rows(), static_cast<Eigen::Index>(surface.size()));
  EXPECT_LT(off_nodes(load, truth), 2 * voxel_error() + 0.02);
  EXPECT_LT(exact, 2 * voxel_error() + 0.02);
  const double weighed = off_95(solved_with(with_noise(whole, "0.3")), truth);
  std::printf("all of the surface: brain (95 %%) imposed %.4f, with noise 0.3 mm %.4f mm\n", exact, weighed);
  EXPECT_LT(weighed, 2 * 0.3) << "95 % of what is told to be the noise";
  const auto entry = nlohmann::json::parse(bytes_of(at("other/solve/stage.json")))["entry"];
  EXPECT_EQ(entry.value("notes", nlohmann::json::array()).dump().find("standard deviations from"), std::string::npos)
      << "where the brain sinks nothing is wrong";
}

TEST_F(Load, OfAFieldThatSaysNothingIsRefused) {
  EXPECT_NE(refused(field((at("head") / "labels.nii.gz").string(), " moves=\"image\"")).find("labels.nii.gz"),
            std::string::npos);
  VectorImage far = read_vector_image(written("preop_to_intraop.nii.gz"));
  far.geometry.origin.x() += 1000;
  write_image(at("far.mha"), far);
  for (const std::string& load : {field(at("far.mha").string(), " moves=\"points\""),
                                  field_all_over(at("far.mha").string(), " moves=\"points\"")}) {
    EXPECT_NE(refused(load).find("far.mha: it says nothing of the"), std::string::npos) << load;
  }
  for (const char* with : {" registration=\"unknown\"", " robust=\"yes\""}) {
    std::string unfit = field(written("preop_to_intraop.nii.gz"));
    unfit.replace(0, 5, std::string("<load noise=\"1\"") + with);
    EXPECT_NE(refused(unfit).find("the load is a <field>"), std::string::npos) << with;
  }
}

/// Twenty of the measured points, spread evenly, with noise.
solve::CraniotomyLoad twenty(const solve::CraniotomyLoad& all, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.5);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < 20; ++i) {
    rows.push_back(i * all.positions.rows() / 20);
  }
  solve::CraniotomyLoad some{all.positions(rows, Eigen::all), all.displacement(rows, Eigen::all)};
  for (double& u : some.displacement.reshaped()) {
    u += noise(random);
  }
  return some;
}

TEST_F(Load, ThatIsRobustHoldsAgainstTwoWrongPointsOfTwentyAndCostsLittleWhereNoneIs) {
  const auto error = [](const solve::CraniotomyLoad& load, const std::string& robust) {
    solve::write_craniotomy_csv(at("head/some.csv"), load);
    return off_95(solved_with("<load noise=\"0.5\"" + robust + "><craniotomy file=\"some.csv\"/>"), truth);
  };
  const std::string robust = " robust=\"yes\"";
  double without = 0, with_two = 0, plain_with_two = 0, none = 0, robust_none = 0;
  for (const unsigned seed : {1, 2, 3}) {
    const solve::CraniotomyLoad clean = twenty(measured, seed);
    solve::CraniotomyLoad wrong = clean;
    wrong.displacement.row(4) += Eigen::RowVector3d(10, 0, 0);
    wrong.displacement.row(13) += Eigen::RowVector3d(0, 0, 10);
    std::vector<Eigen::Index> rest;
    for (Eigen::Index p = 0; p < 20; ++p) {
      if (p != 4 && p != 13) {
        rest.push_back(p);
      }
    }
    without += error({clean.positions(rest, Eigen::all), clean.displacement(rest, Eigen::all)}, "");
    with_two += error(wrong, robust);
    plain_with_two += error(wrong, "");
    none += error(clean, "");
    robust_none += error(clean, robust);
  }
  std::printf(
      "95 %% of the brain, mean of three draws, mm: 18 points %.3f; two of 20 wrong %.3f, robust %.3f; none "
      "wrong %.3f, robust %.3f\n",
      without / 3, plain_with_two / 3, with_two / 3, none / 3, robust_none / 3);
  EXPECT_LT(with_two, 1.2 * without);
  EXPECT_LT(robust_none, 1.05 * none);
  EXPECT_GT(plain_with_two, 1.2 * without);
}

TEST_F(Load, OfAnUnknownRegistrationIsMetTogetherWithIt) {
  constexpr double angle = 0.05;
  const solve::CraniotomyLoad cortex = twenty(measured, 1);
  std::vector<Eigen::Index> inside;
  const Eigen::RowVector3d centre = truth.positions.colwise().mean();
  for (Eigen::Index node = 0; node < truth.positions.rows(); node += 5) {
    if ((truth.positions.row(node) - centre).norm() < 30) {
      inside.push_back(node);
    }
  }
  Points places(cortex.positions.rows() + std::ssize(inside), 3), shift = places;
  places << cortex.positions, truth.positions(inside, Eigen::all);
  shift << cortex.displacement, truth.displacement(inside, Eigen::all);
  const Eigen::Vector3d middle = places.colwise().mean();
  const Eigen::Vector3d outward = (cortex.positions.colwise().mean() - centre).normalized();
  solve::RigidMotion tracker;
  tracker.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  tracker.translation = middle + Eigen::Vector3d(3, -2, 2) + 14 * outward - tracker.rotation * middle;
  solve::CraniotomyLoad seen{places, tracker(places + shift) - places, {}};
  solve::write_craniotomy_csv(at("head/seen.csv"), seen);
  const Solution found = solved_with("<load noise=\"0.5\" registration=\"unknown\"><craniotomy file=\"seen.csv\"/>");
  const auto entry = nlohmann::json::parse(bytes_of(at("other/solve/stage.json")))["entry"];
  EXPECT_EQ(entry.value("notes", nlohmann::json::array()).dump().find("out of the head"), std::string::npos)
      << "the patient moved, not the brain";
  const auto& measures = entry["measures"];
  const solve::RigidMotion written = test::read_rigid(at("other/solve/registration_error.tfm"));
  EXPECT_NEAR(measures["registration_angle_deg"].get<double>(), written.angle(), 1e-3);
  EXPECT_NEAR(measures["registration_shift_mm"].get<double>(), (written(places) - places).colwise().mean().norm(),
              1e-3);
  // The brain turns in the phantom's smooth skull as easily as the tracker: both together are where points were seen.
  const Points deep = truth.positions(inside, Eigen::all);
  const Points said = written(deep + found.displacement(inside, Eigen::all));
  const Points was = tracker(deep + truth.displacement(inside, Eigen::all));
  EXPECT_LT((said - was).rowwise().norm().maxCoeff(), 0.5);
  EXPECT_GT((was - deep).rowwise().norm().mean(), 2) << "else this says nothing";
}

TEST_F(Load, OfAnotherFrameIsToldByTheTurnOfItsRegistration) {
  const solve::CraniotomyLoad cortex = twenty(measured, 1);
  Points turned = cortex.positions + cortex.displacement;
  turned.leftCols(2) *= -1;
  solve::write_craniotomy_csv(at("head/turned.csv"), {cortex.positions, turned - cortex.positions, {}});
  solved_with("<load noise=\"0.5\" registration=\"unknown\"><craniotomy file=\"turned.csv\"/>");
  const auto entry = nlohmann::json::parse(bytes_of(at("other/solve/stage.json")))["entry"];
  EXPECT_NE(entry["notes"].dump().find("degrees; are load and image in the same frame"), std::string::npos)
      << entry["notes"];
}

TEST_F(Load, ThatIsRobustSaysWhichPointsCountForLess) {
  solve::CraniotomyLoad wrong = twenty(measured, 1);
  wrong.displacement.row(4) += Eigen::RowVector3d(10, 0, 0);
  solve::write_craniotomy_csv(at("head/some.csv"), wrong);
  solved_with("<load noise=\"0.5\" robust=\"yes\"><craniotomy file=\"some.csv\"/>");
  const auto entry = nlohmann::json::parse(bytes_of(at("other/solve/stage.json")))["entry"];
  const std::string said = entry["notes"].dump();
  char place[64];
  std::snprintf(place, sizeof place, "(%.0f %.0f %.0f)", wrong.positions(4, 0), wrong.positions(4, 1),
                wrong.positions(4, 2));
  EXPECT_NE(said.find(place), std::string::npos) << place << said;
  EXPECT_TRUE(said.find("of 20 measured points 1 ") < said.size() ||
              said.find("of 20 measured points 2 ") < said.size())
      << said;
  EXPECT_NE(refused("<load robust=\"yes\"><craniotomy file=\"some.csv\"/>").find("needs to know how well"),
            std::string::npos);
}

}  // namespace brainshift::load_test
