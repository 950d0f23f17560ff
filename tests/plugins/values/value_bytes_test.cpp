#include "plugins/values/value_bytes.h"

#include "plugins/testing/guards.h"
#include "tests/plugins/values/example_types.h"

namespace runnel::test {
namespace {

using example::Point;

template <typename T>
std::size_t Bytes(const T& value) {
  return BytesOf(TypeOf<T>(), &value);
}

TEST(BytesOf, CountsFieldsElementsAndLetters) {
  EXPECT_EQ(Bytes(1.0), 8U);
  EXPECT_EQ(Bytes(std::int16_t{1}), 2U);
  EXPECT_EQ(Bytes(example::Side::kLeft), 1U);
  EXPECT_EQ(Bytes(Point{}), 16U);
  EXPECT_EQ(Bytes(std::string("abc")), 3U);
  EXPECT_EQ(Bytes(std::vector<Point>(5)), 80U);
  EXPECT_EQ(Bytes(std::vector<float>{}), 0U);
  EXPECT_EQ(Bytes(std::vector<std::vector<std::string>>{{"ab", "c"}, {}, {"d"}}), 4U);
  EXPECT_EQ(Bytes(Eigen::MatrixXd(2, 3)), 48U);
}

TEST(BytesOf, GrowsWithWhatIsInside) {
  example::Everything value;
  const std::size_t before = Bytes(value);
  value.points.resize(10);
  value.text = "four";
  EXPECT_EQ(Bytes(value), before + 160 + 4);
}

TEST(BytesOf, DoesNotAllocate) {
  const std::vector<std::vector<std::string>> words(20, {"one", "two"});
  const TypeInfo& type = TypeOf<std::vector<std::vector<std::string>>>();
  (void)BytesOf(type, &words);  // types are made known by who asks first
  const AllocationGuard guard;
  const std::size_t bytes = BytesOf(type, &words);
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(bytes, 120U);
}

}  // namespace
}  // namespace runnel::test
