#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/types/type_of.h"
#include "core/types/value_tokens.h"
#include "plugins/services/callable.h"

namespace runnel::test {
namespace {

struct Step {
  double x = 0;
  double y = 0;
  std::optional<double> z = {};
};
void Describe(TypeBuilder<Step>& type) {
  type.Name("Step").Field("x", &Step::x).Field("y", &Step::y).Field("z", &Step::z);
}

// Else what is left out would be 0.
TEST(CheckAllAreSaidTest, LooksIntoListsToo) {
  const auto said = [](const std::string& text) -> std::string {
    const auto tokens = TokensOf(text);
    const auto all = CheckAllAreSaid(TypeOf<std::vector<std::vector<Step>>>(), tokens->root());
    return all ? "all" : all.error().message;
  };
  EXPECT_EQ(said("[[{x: 1, y: 2}], [], [{y: 3, x: 4}, {x: 5, y: 6}]]"), "all");
  EXPECT_EQ(said("[[{x: 1, y: 2}], [], [{y: 3, x: 4}, {x: 5}]]"), "'y' is not given");
  EXPECT_EQ(said("[]"), "all");
  EXPECT_EQ(said("[[{x: 1, y: 2, z: [3]}]]"), "all") << "an optional may be there or not";
}

}  // namespace
}  // namespace runnel::test
