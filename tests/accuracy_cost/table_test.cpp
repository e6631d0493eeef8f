// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn::accuracy_cost::table_test {
namespace {

TEST(Table, GivesBackTheSameDoublesAndBytes) {
  Table table({"model", "error_fraction"});
  table.add("cube", 0.1 + 0.2);
  table.add("cube", std::numeric_limits<double>::denorm_min());
  table.add("torus", std::numeric_limits<double>::quiet_NaN());
  const auto again = Table::parse(table.csv());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again.value().csv(), table.csv());
  EXPECT_EQ(again.value().numbers("error_fraction", {{"model", "cube"}}),
            (std::vector{0.1 + 0.2, std::numeric_limits<double>::denorm_min()}));
  EXPECT_TRUE(std::isnan(again.value().value("error_fraction", {{"model", "torus"}}))) << "an empty cell is no number";
  EXPECT_EQ(table.csv().find("nan"), std::string::npos);
}

TEST(Table, KeepsAMeshCalledNan) {
  Table table({"model", "error_fraction"});
  table.add("nan", std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(table.texts("model"), std::vector<std::string>{"nan"});
  EXPECT_EQ(table.csv(), "model,error_fraction\nnan,\n");
}

TEST(Table, SelectsRowsByAllThatIsAsked) {
  Table table({"a", "b", "c"});
  table.add("x", "y", 1);
  table.add("x", "z", 2);
  table.add("w", "y", 3);
  EXPECT_EQ(table.select({{"a", "x"}, {"b", "z"}}), std::vector<std::size_t>{1});
  EXPECT_EQ(table.select({}).size(), 3U);
  EXPECT_EQ(table.texts("b"), (std::vector<std::string>{"y", "z"}));
  EXPECT_TRUE(table.numbers("c", {{"a", "v"}}).empty());
}

TEST(Table, RefusesWhatIsNoTable) {
  EXPECT_FALSE(Table::parse(""));
  const auto ragged = Table::parse("a,b\n1,2\n3\n");
  ASSERT_FALSE(ragged);
  EXPECT_NE(ragged.error().message.find("row 2"), std::string::npos) << ragged.error().message;
}

}  // namespace
}  // namespace cairn::accuracy_cost::table_test
