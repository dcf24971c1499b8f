// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad input through the program: each ends with the right code and one sentence, and leaves nothing half-written.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

#include "discretise/background_cells.hpp"
#include "discretise/node_cloud.hpp"
#include "segmentation/image/image.hpp"
#include "segmentation/surface/surface.hpp"
#include "tests/phantoms/program.hpp"
#include "tests/unit/solve/clouds.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

constexpr int grid = 28;
constexpr double voxel = 4.0;
constexpr double ball_radius = 40.0;

/// A ball of label 1 in the middle of the grid, or moved by some voxels along x.
LabelMap ball_labels(int moved = 0) {
  LabelMap map;
  map.geometry.size = {grid, grid, grid};
  map.geometry.spacing = Eigen::Vector3d::Constant(voxel);
  map.voxels.assign(map.geometry.voxel_count(), 0);
  const Eigen::Vector3d centre(grid / 2.0 + moved, grid / 2.0, grid / 2.0);
  for (int k = 0; k < grid; ++k) {
    for (int j = 0; j < grid; ++j) {
      for (int i = 0; i < grid; ++i) {
        map.at(i, j, k) = (Eigen::Vector3d(i, j, k) - centre).norm() * voxel < ball_radius ? 1 : 0;
      }
    }
  }
  return map;
}

ScalarImage ball_t1() {
  const LabelMap labels = ball_labels();
  ScalarImage image{labels.geometry, std::vector<float>(labels.voxels.begin(), labels.voxels.end())};
  return image;
}

/// A ball in a folder with everything that a run of it needs, made once.
class BadInput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch = std::make_unique<ScratchFolder>("bad_input");
    write_image(at("labels.nii.gz"), ball_labels());
    write_image(at("t1.nii.gz"), ball_t1());
    write_load("load.csv", "LPS", 0);
    write_scene("scene.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>");
    const ProgramResult made = run_shell(
        "set -e\nbrainshift segment --brain-labels 1 --edge-length 12 --labels " + at("labels.nii.gz") + " --out " +
        at("ball") + "\nbrainshift discretise --nodes 250 --surface " + at("ball/brain.vtp") + " --out " + at("ball"));
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static void TearDownTestSuite() { scratch.reset(); }

  static std::string at(const std::string& name) { return (*scratch / name).string(); }

  /// Three points at the top of the ball, or beyond it, pushed inward; written in the frame that is named, without
  /// conversion.
  static void write_load(const std::string& name, const std::string& frame, double beyond,
                         const std::string& last_line = "") {
    const double c = grid / 2 * voxel;
    std::string text = "# frame: " + frame + "\nx,y,z,ux,uy,uz\n";
    for (const auto& [x, y] : {std::pair(-6.0, 0.0), std::pair(6.0, -6.0), std::pair(6.0, 6.0)}) {
      text += std::to_string(c + x) + "," + std::to_string(c + y) + "," + std::to_string(c + ball_radius + beyond) +
              ",0,0,-2\n";
    }
    write_text(at(name), text + last_line);
  }
  static void write_scene(const std::string& name, const std::string& t1, const std::string& labels,
                          const std::string& load, const std::string& tissue = "<tissue label=\"1\"/>") {
    write_text(at(name), "<scene>\n<image t1=\"" + t1 + "\" labels=\"" + labels + "\"/>\n<tissues>" + tissue +
                             "</tissues>\n<load>" + load +
                             "</load>\n<contact/>\n<stage name=\"segment\" edge_length=\"12\"/>\n"
                             "<stage name=\"discretise\" nodes=\"250\"/>\n<stage name=\"solve\" basis=\"linear\" "
                             "points_per_cell=\"1\" tolerance=\"0.1\"/>\n</scene>\n");
  }
  static std::string run_scene(const std::string& scene) {
    return "brainshift run --quiet " + at(scene) + " --out " + at("out");
  }
  static std::string solve_ball(const std::string& more) {
    return "brainshift solve --quiet --nodes " + at("ball/nodes.vtu") + " --cells " + at("ball/cells.vtu") +
           " --material 1:3000,0.45 --skull " + at("ball/skull.vtp") + " --out " + at("out") + " " + more;
  }

  /// Solves a box whose bottom is held, or what `change` makes of it.
  static std::string solve_box(const std::string& more, const std::function<void(NodeCloud&)>& change = {}) {
    NodeCloud cloud = test::irregular_box(4, 30);
    for (Eigen::Index a = 0; a < cloud.positions.rows(); ++a) {
      if (cloud.positions(a, 2) < 1e-6) {
        cloud.prescribed_displacement.row(a).setZero();
      }
    }
    if (change) {
      change(cloud);
    }
    write_node_cloud(at("box_nodes.vtu"), cloud);
    write_background_cells(at("box_cells.vtu"), test::box_cells(3, 30));
    return "brainshift solve --quiet --nodes " + at("box_nodes.vtu") + " --cells " + at("box_cells.vtu") + " --out " +
           at("out") + " " + more;
  }

  /// One sentence on standard error that holds the parts, the exit code, and nothing in `out` but finished stages.
  static void expect_refused(const std::string& command, const std::vector<std::string>& parts, int code = 2) {
    SCOPED_TRACE(command);
    fs::remove_all(at("out"));
    ProgramResult result = run_shell(command);
    // The NIfTI library prints a line of its own when the disk is full, and cannot be told not to.
    if (result.err.starts_with("** ERROR: NWAD")) {
      result.err.erase(0, result.err.find('\n') + 1);
    }
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.err.substr(0, 12), "brainshift: ");
    for (const std::string& part : parts) {
      EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in: " << result.err;
    }
    EXPECT_TRUE(half_written(scratch->path()).empty());
    for (const char* stage : {"segment", "discretise", "solve", "register", "report"}) {
      const fs::path folder = fs::path(at("out")) / stage;
      EXPECT_EQ(fs::exists(folder), fs::exists(folder / "stage.json")) << folder;
    }
  }

  static std::unique_ptr<ScratchFolder> scratch;
};
std::unique_ptr<ScratchFolder> BadInput::scratch;

TEST_F(BadInput, TheBallItselfRuns) {
  const ProgramResult result = run_shell(run_scene("scene.xml"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

TEST_F(BadInput, FilesThatAreMissingEmptyTruncatedOrNoImage) {
  write_text(at("empty.nii.gz"), "");
  write_text(at("text.nii.gz"), "this is no image\n");
  write_text(at("text.nii"), "this is no image\n");
  const std::string whole = read_text(at("labels.nii.gz"));
  write_text(at("truncated.nii.gz"), whole.substr(0, whole.size() / 2));
  for (const std::string file : {"missing.nii.gz", "empty.nii.gz", "text.nii.gz", "text.nii", "truncated.nii.gz"}) {
    expect_refused("brainshift segment --quiet --brain-labels 1 --labels " + at(file) + " --out " + at("out"), {file});
    write_scene("bad.xml", "t1.nii.gz", file, "<craniotomy file=\"load.csv\"/>");
    expect_refused(run_scene("bad.xml"), {file});
    write_scene("bad.xml", file, "labels.nii.gz", "<craniotomy file=\"load.csv\"/>");
    expect_refused(run_scene("bad.xml"), {file});
  }
  for (const std::string file : {"empty.vtp", "text.stl", "text.vtu"}) {
    write_text(at(file), file == "empty.vtp" ? "" : "this is no surface\n");
  }
  expect_refused("brainshift segment --quiet --surface " + at("empty.vtp") + " --out " + at("out"), {"empty.vtp"});
  expect_refused("brainshift discretise --quiet --surface " + at("text.stl") + " --out " + at("out"), {"text.stl"});
  expect_refused("brainshift solve --quiet --nodes " + at("text.vtu") + " --cells " + at("ball/cells.vtu") +
                     " --material 1:3000,0.45 --out " + at("out"),
                 {"text.vtu"});
}

TEST_F(BadInput, LabelsAndT1OfDifferentGeometry) {
  LabelMap moved = ball_labels();
  moved.geometry.origin.x() += 10;
  write_image(at("moved.nii.gz"), moved);
  write_scene("bad.xml", "t1.nii.gz", "moved.nii.gz", "<craniotomy file=\"load.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"moved.nii.gz", "t1.nii.gz", "resample"});
}

TEST_F(BadInput, ATissueThatTheImageLacksAndALabelWithoutMaterial) {
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>",
              "<tissue label=\"1\"/>\n<tissue label=\"9\"/>");
  expect_refused(run_scene("bad.xml"), {"bad.xml:4", "tissue 9", "labels.nii.gz"});
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>", "<tissue label=\"9\"/>");
  expect_refused(run_scene("bad.xml"), {"bad.xml:3", "9"});
  expect_refused("brainshift solve --quiet --nodes " + at("ball/nodes.vtu") + " --cells " + at("ball/cells.vtu") +
                     " --material 9:3000,0.45 --skull " + at("ball/skull.vtp") + " --load " + at("load.csv") +
                     " --out " + at("out"),
                 {"label 1", "material"});
}

TEST_F(BadInput, VoxelsThatAreNoNumbers) {
  ScalarImage t1 = ball_t1();
  t1.at(3, 4, 5) = std::numeric_limits<float>::quiet_NaN();
  write_image(at("nan.nii.gz"), t1);
  write_scene("bad.xml", "nan.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"nan.nii.gz"});
}

TEST_F(BadInput, ABrainThatTouchesTheImageBorder) {
  write_image(at("border.nii.gz"), ball_labels(8));
  expect_refused("brainshift segment --quiet --brain-labels 1 --edge-length 12 --labels " + at("border.nii.gz") +
                     " --out " + at("out"),
                 {"border"});
}

TEST_F(BadInput, AnOpenOrSelfIntersectingSurface) {
  Surface surface = read_surface(at("ball/brain.vtp"));
  Surface open = surface;
  open.triangles.conservativeResize(open.triangles.rows() - 1, Eigen::NoChange);
  write_surface(at("open.vtp"), open);
  expect_refused("brainshift discretise --quiet --nodes 250 --surface " + at("open.vtp") + " --out " + at("out"),
                 {"open"});
  Surface crossed = surface;
  crossed.vertices.row(0) = 2 * crossed.vertices.colwise().mean() - crossed.vertices.row(0);
  write_surface(at("crossed.vtp"), crossed);
  expect_refused("brainshift discretise --quiet --nodes 250 --surface " + at("crossed.vtp") + " --out " + at("out"),
                 {"intersect"});
}

TEST_F(BadInput, ALoadInTheWrongFrameOrFarFromTheBrain) {
  write_load("ras.csv", "RAS", 0);
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"ras.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"132.1 mm", "RAS"});
  write_load("far.csv", "LPS", 33);
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"far.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"mm", "20"});
}

TEST_F(BadInput, ALoadUnderWhichThereIsNoNode) {
  const double c = grid / 2 * voxel;
  write_text(at("lone.csv"), "# frame: LPS\nx,y,z,ux,uy,uz\n" + std::to_string(c + 0.123) + "," +
                                 std::to_string(c + 0.456) + "," + std::to_string(c + ball_radius + 12) + ",0,0,-1\n");
  expect_refused(solve_ball("--load " + at("lone.csv") + " --margin 0"), {"node"});
  expect_refused(solve_ball(""), {"prescribe"});
}

TEST_F(BadInput, TooFewNodesForASupport) {
  NodeCloud cloud = read_node_cloud(at("ball/nodes.vtu"));
  cloud.positions.conservativeResize(3, Eigen::NoChange);
  cloud.spacing.resize(3);
  cloud.on_surface.resize(3);
  cloud.label.resize(3);
  cloud.prescribed_displacement = Points::Zero(3, 3);
  write_node_cloud(at("three.vtu"), cloud);
  expect_refused("brainshift solve --quiet --nodes " + at("three.vtu") + " --cells " + at("ball/cells.vtu") +
                     " --material 1:3000,0.45 --out " + at("out"),
                 {"node"});
}

TEST_F(BadInput, ALineThatDoesNotParse) {
  write_load("line.csv", "LPS", 0, "1,2,3,4,five,6\n");
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"line.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"line.csv", "6", "five"});
  write_load("short.csv", "LPS", 0, "1,2,3\n");
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"short.csv\"/>");
  expect_refused(run_scene("bad.xml"), {"short.csv", "6"});
  write_text(at("bad.fcsv"), "# CoordinateSystem = LPS\n# columns = id,x,y,z,label\na,1,2,3,A\nb,1,two,3,B\n");
  write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<markups before=\"bad.fcsv\" after=\"bad.fcsv\"/>");
  expect_refused(run_scene("bad.xml"), {"bad.fcsv", "4"});
  write_text(at("bad.xml"), "<scene>\n<image t1=\"t1.nii.gz\"\n</scene>");
  expect_refused(run_scene("bad.xml"), {"bad.xml:", "XML"});
}

TEST_F(BadInput, AMaterialThatCannotBe) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"1:3000,0.5", {"poisson_ratio", "'0.5'", "< 0.5"}},
      {"1:0,0.49", {"youngs_modulus", "'0'", "> 0", "Pa"}},
      {"1:-3000,0.49", {"youngs_modulus", "'-3000'"}},
      {"1:3000,0.49,0", {"density", "'0'", "> 0", "kg/m3"}},
      {"1:brain,density=0", {"density", "'0'", "> 0"}},
      {"1:brane", {"material", "'brane'", "brain | brain_ogden"}},
      {"1:law=rubber", {"law", "'rubber'", "neo_hookean | ogden"}},
      {"1:law=ogden", {"label 1", "no terms"}},
      {"1:ogden=842,-4.7", {"842,-4.7", "neo_hookean", "set the law to ogden"}},
      {"1:law=ogden,ogden=842", {"ogden", "'842'", "pairs mu,alpha"}},
      {"1:law=ogden,ogden=842,0", {"alpha = 0"}},
      {"'1:law=ogden,ogden=842,-4.7;-900,2'", {"unstable at rest", "-58 Pa"}},
      {"1:brain,prony=1.2,1", {"1.2", "below 1"}},
      {"1:brain,prony=0.2,0", {"time 0 s", "positive"}},
      {"1:brain,stiffness=3", {"no attribute 'stiffness'", "youngs_modulus"}},
      {"1:brain,law=ogden,law=ogden", {"law twice"}},
      {"1:brain --material 1:brain", {"label 1 twice"}},
  };
  for (const auto& [material, parts] : cases) {
    expect_refused(solve_box(std::string("--material ") + material), parts);
  }
}

TEST_F(BadInput, ATissueThatCannotBe) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"law=\"ogden\"", {"bad.xml:3", "no terms"}},
      {"ogden=\"842,-4.7\"", {"bad.xml:3", "842,-4.7", "law neo_hookean"}},
      {"law=\"ogden\" ogden=\"842,-4.7; -900,2\"", {"bad.xml:3", "unstable at rest"}},
      {"material=\"brian\"", {"bad.xml:3", "'brian'", "brain | brain_ogden"}},
      {"prony=\"0.5\"", {"bad.xml:3", "'0.5'", "pairs share,time"}},
  };
  for (const auto& [attributes, parts] : cases) {
    write_scene("bad.xml", "t1.nii.gz", "labels.nii.gz", "<craniotomy file=\"load.csv\"/>",
                std::string("<tissue label=\"1\" ") + attributes + "/>");
    expect_refused(run_scene("bad.xml"), parts);
  }
}

TEST_F(BadInput, OptionsInTimeThatMakeNoSense) {
  const std::string brain = "--material 1:brain ";
  expect_refused(solve_box(brain + "--dynamics transient --time-step 0.1"), {"0.1 s", "critical"});
  expect_refused(solve_box(brain + "--damping 3"), {"damping", "relaxation", "transient"});
  expect_refused(solve_box(brain + "--time-step 1e-4"), {"time_step", "relaxation"});
  expect_refused(solve_box(brain + "--duration 1"), {"duration", "relaxation"});
  expect_refused(solve_box(brain + "--curve-join straight"), {"curve_join", "no curve"});
  expect_refused(solve_box(brain + "--gravity 1,2"), {"--gravity", "'1,2'", "three numbers", "m/s2"});
  write_text(at("curve.csv"), "time,factor\n0,0\n1,1\n");
  expect_refused(solve_box(brain + "--dynamics transient --duration 2 --curve " + at("curve.csv")),
                 {"duration", "curve", "one of them"});
  expect_refused(run_scene("scene.xml") + " --set solve.damping=3", {"--set", "damping", "relaxation"});
  expect_refused(run_scene("scene.xml") + " --set solve.curve=none.csv", {"--set", "none.csv", "does not exist"});
}

TEST_F(BadInput, ACurveThatIsNone) {
  const std::pair<const char*, std::vector<std::string>> cases[] = {
      {"t,f\n0,0\n1,1\n", {"line 1", "time,factor"}},   {"time,factor\n0,0\n2,1\n1,1\n", {"line 4", "not later"}},
      {"time,factor\n1,0\n2,1\n", {"start at time 0"}}, {"time,factor\n0,1\n2,1\n", {"factor 0"}},
      {"time,factor\n0,0\n1,one\n", {"line 3", "one"}},
  };
  for (const auto& [text, parts] : cases) {
    write_text(at("curve.csv"), text);
    std::vector<std::string> said = parts;
    said.push_back("curve.csv");
    expect_refused(solve_box("--material 1:brain --curve " + at("curve.csv")), said);
    expect_refused(run_scene("scene.xml") + " --set solve.curve=curve.csv", said);
  }
}

TEST_F(BadInput, NodesThatSayTheSame) {
  expect_refused(solve_box("--material 1:brain",
                           [](NodeCloud& cloud) {
                             cloud.positions.row(5) = cloud.positions.row(4) + Eigen::RowVector3d(5e-5, 0, 0);
                           }),
                 {"nodes 4 and 5", "apart", "remove one of them"});
}

TEST_F(BadInput, PlanesOfTheWrongCells) {
  expect_refused(solve_box("--material 1:brain --plane stress"), {"quadrilaterals or triangles"});
  expect_refused(solve_box("--material 1:brain --plane bent"), {"--plane", "bent", "strain", "stress"});
  NodeCloud cloud = test::irregular_rectangle(6, 4, 50, 30);
  cloud.prescribed_displacement.row(0).setZero();
  cloud.prescribed_displacement.row(1).setZero();
  write_node_cloud(at("flat_nodes.vtu"), cloud);
  write_background_cells(at("flat_cells.vtu"), test::rectangle_cells(5, 3, 50, 30));
  const std::string flat = "brainshift solve --quiet --nodes " + at("flat_nodes.vtu") + " --cells " +
                           at("flat_cells.vtu") + " --out " + at("out") + " --material ";
  expect_refused(flat + "1:brain", {"planar", "plane strain or plane stress"});
  expect_refused(flat + "1:brain_viscoelastic --plane stress", {"label 1", "relaxes", "plane strain"});
  expect_refused(flat + "1:brain --plane strain --points-per-cell 3", {"3"});
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  write_text(at("file"), "a file, not a folder");
  expect_refused("brainshift run --quiet " + at("scene.xml") + " --out " + at("file/run"), {at("file")}, 1);
  expect_refused("brainshift segment --quiet --brain-labels 1 --edge-length 12 --labels " + at("labels.nii.gz") +
                     " --out " + at("file/run"),
                 {at("file")}, 1);
  expect_refused("brainshift phantom --quiet --size 24 --spacing 8 --out " + at("file/head"), {at("file")}, 1);
}

TEST_F(BadInput, AFullDisk) {
  // A limit on the size of files stands for it: writes fail from there on. One block is 512 bytes.
  expect_refused("ulimit -f 8\n" + run_scene("scene.xml"), {"out/"}, 1);
  expect_refused("ulimit -f 1\nbrainshift phantom --quiet --size 24 --spacing 8 --out " + at("out"), {"out"}, 1);
  // With room again the same command runs through.
  EXPECT_EQ(run_shell(run_scene("scene.xml")).code, 0);
}

TEST_F(BadInput, CommandLinesThatMakeNoSense) {
  expect_refused("brainshift run", {"scene"});
  expect_refused("brainshift fly", {"subcommand"});
  expect_refused("brainshift run --threads 0 " + at("scene.xml") + " --out " + at("out"), {"threads"});
  expect_refused("brainshift run --quiet " + at("scene.xml") + " --until lunch --out " + at("out"),
                 {"lunch", "discretise"});
  expect_refused("brainshift segment --edge-length -3 --labels a --out " + at("out"), {"--edge-length", "-3", "> 0"});
  expect_refused(solve_ball("--material 1:3000"), {"--material", "LABEL:E_Pa,nu"});
  expect_refused(solve_ball("--material 1:3000,0.7"), {"poisson_ratio", "0.7"});
}

}  // namespace
}  // namespace brainshift
