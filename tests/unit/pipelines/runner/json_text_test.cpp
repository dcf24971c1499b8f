// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/json_text.hpp"

#include <gtest/gtest.h>

namespace brainshift::pipelines::json_text_test {

TEST(JsonText, WritesNamesThatAreNoUtf8) {
  const nlohmann::ordered_json json = {{"path", "head\xff.nii"}};
  EXPECT_EQ(json_text(json), "{\n  \"path\": \"head\xEF\xBF\xBD.nii\"\n}\n");
}

}  // namespace brainshift::pipelines::json_text_test
