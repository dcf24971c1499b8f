// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>

#include "segmentation/interface/options.hpp"
#include "segmentation/labels/label_table.hpp"
#include "tests/unit/scratch_folder.hpp"
#include "tests/unit/segmentation/builders.hpp"
#include "tests/unit/segmentation/slicer_file.hpp"

namespace brainshift::test::read_label_table_test {

using namespace segmentation;

class TableFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(scratch_.path() / name) << text;
    return scratch_.path() / name;
  }
  ScratchFolder scratch_;
};

TEST_F(TableFile, ColourTablesOfFreeSurferAndSlicerAreRead) {
  const auto table = read_label_table(write("lut.ctbl",
                                            "# colours\n0 Unknown 0 0 0 0\n\n  4 Left-Lateral-Ventricle 120 18 134 0\n"
                                            "28 Left-VentralDC 1 2 3 0\n24 CSF 60 60 60 0\n165 Skull 120 120 120 0\n"
                                            "99000 too-large 1 2 3 0\n"));
  EXPECT_EQ(table.classes, (std::map<std::uint16_t, std::uint16_t>{{0, 0}, {4, 2}, {24, 4}, {28, 1}, {165, 5}}));
}

TEST_F(TableFile, DescriptionsOfItkSnapAreReadAndZeroIsBackground) {
  const auto table = read_label_table(write("snap.txt",
                                            "    0     0    0    0        0  0  0    \"Clear Label\"\n"
                                            "    1   255    0    0        1  1  1    \"Brain\"\n"
                                            "    2     0  255    0        1  1  1    \"Left lateral ventricle\"\n"));
  EXPECT_EQ(table.classes, (std::map<std::uint16_t, std::uint16_t>{{0, 0}, {1, 1}, {2, 2}}));
}

TEST_F(TableFile, ANameMayHaveWordsBetweenItsNumberAndItsColour) {
  const auto table = read_label_table(write("a.txt",
                                            "0 None\n1 Left lateral ventricle 1 2 3 0\n2 Outer skull\n"
                                            "5 Left Inf Lat Vent 196 58 250 0\n"));
  EXPECT_EQ(table.classes, (std::map<std::uint16_t, std::uint16_t>{{0, 0}, {1, 2}, {2, 5}, {5, 2}}));
}

TEST_F(TableFile, ColumnsOfBidsAreReadInAnyOrder) {
  const auto table = read_label_table(write(
      "a_dseg.tsv", "name\tindex\tcolor\nGrey matter\t1\t#fff\nThird ventricle\t7\t#000\nWhole tumour\t9\t#0f0\n"));
  EXPECT_EQ(table.classes, (std::map<std::uint16_t, std::uint16_t>{{1, 1}, {7, 2}, {9, 3}}));
  const auto of_fastsurfer = read_label_table(
      write("lut.tsv",
            "# as FastSurfer has it\nID\t LabelName \tRed\tGreen\tBlue\tAlpha\n0\tUnknown\t0\t0\t0\t0\n"
            "2\tLeft-Cerebral-White-Matter\t245\t245\t245\t0\n4\tLeft-Lateral-Ventricle\t120\t18\t134\t0\n"));
  EXPECT_EQ(of_fastsurfer.classes, (std::map<std::uint16_t, std::uint16_t>{{0, 0}, {2, 1}, {4, 2}}));
}

TEST_F(TableFile, SegmentsOf3DSlicerAreATable) {
  const auto file = write_slicer_file(scratch_.path() / "a.seg.nrrd",
                                      slicer_segment(0, "Brain", 4, 0) + slicer_segment(1, "CSF", 40000, 0), {{4}});
  EXPECT_EQ(read_label_table(file).classes, (std::map<std::uint16_t, std::uint16_t>{{4, 1}, {40000, 4}}));
  const std::string brain = slicer_segment(0, "Brain", 1, 0);
  for (const auto& [keys, said] : {std::pair<std::string, std::string>("", "names no segment"),
                                   {brain + slicer_segment(1, "Tumour", 1, 1), "the number 1 to different tissues"}}) {
    const auto bad = write_slicer_file(scratch_.path() / "b.seg.nrrd", keys, {{1}, {1}});
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_label_table(bad); }, {"b.seg.nrrd", said}));
  }
}

TEST_F(TableFile, WhatIsNoTableIsRefusedWithItsLine) {
  const auto refused = [](const std::filesystem::path& file, const std::vector<std::string>& words) {
    return throws_saying<std::invalid_argument>([&] { read_label_table(file); }, words);
  };
  EXPECT_TRUE(refused(write("a.txt", "# nothing\n"), {"a.txt", "names no label"}));
  EXPECT_TRUE(refused(write("b.txt", "1 Brain\nbrain 2\n"), {"b.txt:2", "number and its name"}));
  EXPECT_TRUE(refused(write("d.txt", "1 255 0 0 1 1 1\n"), {"d.txt:1", "ITK-SNAP"}));
  EXPECT_TRUE(refused(write("c.tsv", "index\tname\n1\n"), {"c.tsv:2"}));
  EXPECT_TRUE(refused(scratch_.path() / "none.txt", {"no such file"}));
}

TEST_F(TableFile, ANumberThatIsNamedTwiceIsRefusedWithBothLines) {
  for (const auto& [name, text] :
       {std::pair("a.tsv", "index\tname\n10\tBrain\n40\tCSF\n10\tSkull\n"),
        {"b.txt", "# numbers\n10 Brain\n\n10 Brain\n"},
        {"c.txt", "9 CSF\n10 1 2 3 1 1 1 \"Brain\"\n8 Skull\n010 1 2 3 1 1 1 \"Skull\"\n"}}) {
    const auto file = write(name, text);
    EXPECT_TRUE(throws_saying<std::invalid_argument>([&] { read_label_table(file); },
                                                     {name + std::string(":4"), "number 10", "line 2"}));
  }
  EXPECT_EQ(read_label_table(write("d.txt", "1 Brain\n99000 far\n99000 too\n")).classes.size(), 1) << "not of a map";
}

TEST(ClassOfName, FollowsItsWords) {
  EXPECT_EQ(class_of_name("Right-Inf-Lat-Vent"), default_label::ventricles);
  EXPECT_EQ(class_of_name("choroid plexus"), default_label::ventricles);
  EXPECT_EQ(class_of_name("brain metastases"), default_label::tumour);
  EXPECT_EQ(class_of_name("CSF-ExtraCerebral"), default_label::csf);
  EXPECT_EQ(class_of_name("Left-Cerebral-Exterior"), 0);
  EXPECT_EQ(class_of_name("ctx-lh-precuneus"), default_label::parenchyma);
  EXPECT_EQ(class_of_name("Tumor core"), default_label::tumour);
  EXPECT_EQ(class_of_name("skull-stripped brain"), default_label::parenchyma);
  EXPECT_EQ(class_of_name("HEAD"), 0);
  EXPECT_EQ(class_of_name("Skull-base-meningioma"), default_label::tumour);
  EXPECT_EQ(class_of_name("ctx-lh-unknown"), default_label::parenchyma);
  EXPECT_EQ(class_of_name("L_Frontal_Eye_Fields"), default_label::parenchyma);
  EXPECT_EQ(class_of_name("Fusiform_Face_Complex"), default_label::parenchyma);
  EXPECT_EQ(class_of_name("Left-Eye"), 0);
  EXPECT_EQ(class_of_name("hippocampal head"), default_label::parenchyma);
}

TEST(ClassOfName, PartsWordsAtTheirCapitals) {
  EXPECT_EQ(class_of_name("LateralVentricles"), default_label::ventricles);
  EXPECT_EQ(class_of_name("leftLateralVentricle2"), default_label::ventricles);
  EXPECT_EQ(class_of_name("BrainTumor"), default_label::tumour);
  EXPECT_EQ(class_of_name("GTVEnhancing"), default_label::tumour);
  EXPECT_EQ(class_of_name("SkullBone"), default_label::skull);
  EXPECT_EQ(class_of_name("CSFSpace"), default_label::csf);
  EXPECT_EQ(class_of_name("extraCSF"), default_label::csf);
  EXPECT_EQ(class_of_name("SkullStrippedBrain"), default_label::parenchyma);
  EXPECT_EQ(class_of_name("HeadOfCaudate"), default_label::parenchyma);
}

TEST(ClassOfName, KnownTablesHaveTheirClasses) {
  for (const char* name :
       {"Left-VentralDC", "VentralDC", "WM-hypointensities", "Left-Cerebral-White-Matter", "Brain-Stem",
        "CC_Mid_Anterior", "Left-Accumbens-area", "ctx-lh-bankssts", "ctx_rh_G_and_S_cingul-Mid-Ant", "wm-lh-insula",
        "Optic-Chiasm", "left ventral DC", "Medullary-Bulb", "DCerebellarNuclei", "L_FEFarea"}) {
    EXPECT_EQ(class_of_name(name), default_label::parenchyma) << name;
  }
  for (const char* name : {"Left-Lateral-Ventricle", "3rd-Ventricle", "4th-Ventricle", "5th-Ventricle",
                           "Left-Inf-Lat-Vent", "Left-choroid-plexus", "right inferior lateral ventricle"}) {
    EXPECT_EQ(class_of_name(name), default_label::ventricles) << name;
  }
  EXPECT_EQ(class_of_name("CSF"), default_label::csf);
  for (const char* name : {"Unknown", "Head-ExtraCerebral", "BoneOrAir"}) {
    EXPECT_EQ(class_of_name(name), 0) << name;
  }
}

TEST(NameTellsClass, UnlessNobodyNamedIt) {
  for (const char* name : {"Segment_1", "segment", "SEGMENT 12", "1", ""}) {
    EXPECT_FALSE(name_tells_class(name)) << name;
  }
  for (const char* name : {"Brain", "SegmentedTumour", "SegmentTumour"}) {
    EXPECT_TRUE(name_tells_class(name)) << name;
  }
}

}  // namespace brainshift::test::read_label_table_test
