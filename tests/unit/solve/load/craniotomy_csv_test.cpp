// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/load/craniotomy_load.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::solve::craniotomy_csv_test {

using test::refusal;
using test::ScratchFolder;

const std::string header = "# frame: LPS\nx,y,z,ux,uy,uz\n";

TEST(CraniotomyCsv, GivesBackUnchangedWhatWasWritten) {
  const ScratchFolder folder;
  CraniotomyLoad load{Points(3, 3), Points(3, 3)};
  load.positions << 1.0 / 3, -2e-17, 3e5, 0.1, 0.2, 0.3, -7, 8, 9;
  load.displacement << 0, -8.125, 1e-9, 4.0 / 7, 5, 6, -1, -2, -3;
  write_craniotomy_csv(folder / "load.csv", load);
  const CraniotomyLoad again = read_craniotomy_csv(folder / "load.csv");
  EXPECT_EQ(again.positions, load.positions);
  EXPECT_EQ(again.displacement, load.displacement);
}

TEST(CraniotomyCsv, TurnsRasIntoLps) {
  const ScratchFolder folder;
  const auto load = read_craniotomy_csv(folder.write("ras.csv", "# frame: RAS\nx,y,z,ux,uy,uz\n10,20,30,1,2,3\n"));
  EXPECT_EQ(load.positions.row(0), Eigen::RowVector3d(-10, -20, 30));
  EXPECT_EQ(load.displacement.row(0), Eigen::RowVector3d(-1, -2, 3));
}

TEST(CraniotomyCsv, ToleratesByteOrderMarkWindowsLineEndsBlanksAndOtherComments) {
  const ScratchFolder folder;
  const auto load = read_craniotomy_csv(folder.write(
      "windows.csv",
      "\xEF\xBB\xBF# patient 7\r\n#frame: LPS\r\nx, y, z, ux, uy, uz\r\n 1, +2,3 ,4,5,6e0\r\n\r\n# a note\r\n \r\n"));
  ASSERT_EQ(load.positions.rows(), 1);
  EXPECT_EQ(load.positions.row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(load.displacement.row(0), Eigen::RowVector3d(4, 5, 6));
}

TEST(CraniotomyCsv, RefusesALineThatDoesNotParseAndNamesIt) {
  const ScratchFolder folder;
  const char* const bad[] = {"1,2,3,4,5",       "1,2,3,4,5,6,7", "1,2,3,4,5,",    "1,2,3,4,5,six",
                             "1,2,3,4,5,6 mm",  "1,2,3,4,5,nan", "1,2,3,4,5,inf", "1;2;3;4;5;6",
                             "1,2,3,4,5,1e999", "1,2,3,0x4,5,6", "--1,2,3,4,5,6", "1,2,3,4,5,+-6"};
  for (const std::string line : bad) {
    const auto file = folder.write("bad.csv", header + "1,2,3,4,5,6\n" + line + "\n1,2,3,4,5,6\n");
    const std::string fault = refusal([&] { read_craniotomy_csv(file); });
    EXPECT_NE(fault.find("bad.csv:4:"), std::string::npos) << line << " -> " << fault;
  }
}

TEST(CraniotomyCsv, RefusesAFileWithoutFrameHeaderOrMeasurement) {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& text) {
    const auto file = folder.write("file.csv", text);
    return refusal([&] { read_craniotomy_csv(file); });
  };
  EXPECT_NE(fault("x,y,z,ux,uy,uz\n1,2,3,4,5,6\n").find("# frame"), std::string::npos);
  EXPECT_NE(fault("# frame: XYZ\nx,y,z,ux,uy,uz\n1,2,3,4,5,6\n").find("XYZ"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\n# frame: RAS\nx,y,z,ux,uy,uz\n1,2,3,4,5,6\n").find(":2:"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\n1,2,3,4,5,6\n").find(":2:"), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\nx,y,z,dx,dy,dz\n1,2,3,4,5,6\n").find("\"ux\""), std::string::npos);
  EXPECT_NE(fault("# frame: LPS\n").find("no point"), std::string::npos);
  EXPECT_NE(fault(header).find("no point"), std::string::npos);
  EXPECT_NE(fault("").find("empty"), std::string::npos);
  EXPECT_NE(fault("\n\n").find("empty"), std::string::npos);
  EXPECT_NE(fault(std::string("\x1f\x8b\0\0\x01", 5)).find(":1:"), std::string::npos);
}

TEST(CraniotomyCsv, RefusesAMissingFileAndAFolder) {
  const ScratchFolder folder;
  EXPECT_NE(refusal([&] { read_craniotomy_csv(folder / "none.csv"); }).find("none.csv"), std::string::npos);
  EXPECT_NE(refusal([&] { read_craniotomy_csv(folder / "."); }).find("folder"), std::string::npos);
}

TEST(CraniotomyCsv, SaysWhichFileCannotBeWritten) {
  const ScratchFolder folder;
  const CraniotomyLoad load{Points::Zero(1000, 3), Points::Zero(1000, 3)};
  EXPECT_THROW(write_craniotomy_csv(folder / "missing/load.csv", load), std::runtime_error);
  EXPECT_THROW(write_craniotomy_csv("/dev/full", load), std::runtime_error);
}

TEST(CraniotomyCsv, TakesOneStandardDeviationAPointOrThreeAndGivesThemBack) {
  const ScratchFolder folder;
  const auto one = read_craniotomy_csv(
      folder.write("one.csv", "# frame: RAS\nx,y,z,ux,uy,uz,sigma\n1,2,3,4,5,6,0.5\n1,2,4,4,5,6,1e-6\n"));
  EXPECT_EQ(one.sigma.row(0), Eigen::RowVector3d(0.5, 0.5, 0.5));
  const auto three = read_craniotomy_csv(
      folder.write("three.csv", "# frame: RAS\nx,y,z,ux,uy,uz,sigma_x,sigma_y,sigma_z\n1,2,3,4,5,6,0.5,0.25,2\n"));
  EXPECT_EQ(three.sigma.row(0), Eigen::RowVector3d(0.5, 0.25, 2));
  write_craniotomy_csv(folder / "again.csv", three);
  EXPECT_EQ(read_craniotomy_csv(folder / "again.csv").sigma, three.sigma);
}

TEST(CraniotomyCsv, RefusesAStandardDeviationThatIsNoneAndNamesTheLine) {
  const ScratchFolder folder;
  for (const std::string sigma : {"0", "-1", "1e-7", "", "nan", "much"}) {
    const auto file =
        folder.write("bad.csv", "# frame: LPS\nx,y,z,ux,uy,uz,sigma\n1,2,3,4,5,6,1\n1,2,3,4,5,6," + sigma + "\n");
    const std::string fault = refusal([&] { read_craniotomy_csv(file); });
    EXPECT_NE(fault.find("bad.csv:4:"), std::string::npos) << sigma << " -> " << fault;
  }
  for (const std::string column : {"Sigma", "SD", "sd_mm", "sigma_mm", "NOISE", "noise_mm", "sigma,sigma_x"}) {
    const auto named = folder.write("named.csv", "# frame: LPS\nx,y,z,ux,uy,uz," + column + "\n1,2,3,4,5,6,1" +
                                                     (column.find(',') == std::string::npos ? "" : ",1") + "\n");
    EXPECT_NE(refusal([&] { read_craniotomy_csv(named); }).find("sigma_x"), std::string::npos) << column;
  }
  const auto file = folder.write("two.csv", "# frame: LPS\nx,y,z,ux,uy,uz,sigma_x,sigma_y\n1,2,3,4,5,6,1,1\n");
  EXPECT_NE(refusal([&] { read_craniotomy_csv(file); }).find("sigma_z"), std::string::npos);
}

}  // namespace brainshift::solve::craniotomy_csv_test
