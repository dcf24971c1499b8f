// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/expect_parts.hpp"

namespace brainshift::pipelines {

/// There is one sentence, which holds each of the parts.
inline void expect_one(const std::vector<std::string>& sentences, const std::vector<std::string>& parts) {
  ASSERT_EQ(sentences.size(), 1U);
  test::expect_parts(sentences.front(), parts);
}

}  // namespace brainshift::pipelines
