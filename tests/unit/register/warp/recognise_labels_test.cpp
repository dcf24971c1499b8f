// SPDX-License-Identifier: GPL-3.0-or-later
#include "register/warp/recognise_labels.hpp"

#include <gtest/gtest.h>

#include "tests/unit/register/builders.hpp"

namespace brainshift::registration::recognise_labels_test {

using namespace builders;

const ImageGeometry g = grid({24, 22, 20});

TEST(RecogniseLabels, ByFewWholeNumbersInPatches) {
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 1 : 0; })));
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 1 : -1; })));
  EXPECT_TRUE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    return 1000 + std::floor(x.x() / 6) + 10 * std::floor(x.y() / 6) + 100 * std::floor(x.z() / 6);
  })));
}

TEST(RecogniseLabels, NotAnMriOfBytesNorNumbersBetween) {
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return std::round(texture(x)); })));
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 0.5 : 0; })));
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) { return x.x() > 3 ? 40 : -1000; })));
  EXPECT_FALSE(looks_like_labels(image(g, [](const Eigen::Vector3d& x) {
    return x.z() > centre.z() ? std::round(texture(x)) : 7;  // a background that is not 0
  })));
  int next = 0;
  EXPECT_FALSE(looks_like_labels(image(g, [&](const Eigen::Vector3d&) { return next++; })));
}

}  // namespace brainshift::registration::recognise_labels_test
