#include "plugins/control/value_text.h"

#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/types/eigen_types.h"
#include "core/types/text_format.h"
#include "core/types/type_of.h"

namespace runnel::test {

namespace {

struct Report {
  std::string name = "a \"b\"";
  std::vector<int> numbers = {1, 2, 3};
  double value = 0.5;
};
void Describe(TypeBuilder<Report>& type) {
  type.Name("control_test.Report");
  type.Field("name", &Report::name);
  type.Field("numbers", &Report::numbers);
  type.Field("value", &Report::value);
}

template <typename T>
std::string Text(const T& value, const ValueTextOptions& options = {}) {
  return ValueText(TypeOf<T>(), &value, options);
}

}  // namespace

TEST(ValueText, IsTheTextFormatWhereNothingIsLong) {
  const Report report;
  EXPECT_EQ(Text(report), TextOf(report));
  EXPECT_EQ(Text(3.25), "3.25");
  EXPECT_EQ(Text(std::string("x y")), "x y");
  const Eigen::Matrix2d matrix = (Eigen::Matrix2d() << 1, 2, 3, 4).finished();
  EXPECT_EQ(Text(matrix), TextOf(matrix));
}

TEST(ValueText, ShortensListsAndTexts) {
  std::vector<int> numbers(640, 7);
  EXPECT_EQ(Text(numbers, {.elements = 2}), "[7, 7, … 640 in all]");
  EXPECT_EQ(Text(std::string(200, 'x'), {.string = 3}), "xxx… 200 bytes in all");
  // Not within a character.
  EXPECT_EQ(Text(std::string("aö"), {.string = 2}), "a… 3 bytes in all");
  EXPECT_EQ(Text(numbers, FullValueText()), TextOf(numbers));
}

TEST(ValueText, EndsAfterItsLimitHoweverLargeTheValueIs) {
  const std::vector<std::vector<double>> table(1000, std::vector<double>(1000, 0.125));
  EXPECT_LT(Text(table, {.elements = 1'000'000, .string = 10, .all = 5'000}).size(), 5'300U);
  const std::vector<std::uint8_t> image(6'000'000, 255);
  EXPECT_LT(Text(image, FullValueText()).size(), 4'100'000U);
}

}  // namespace runnel::test
