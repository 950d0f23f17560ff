#include <gtest/gtest.h>

#include "plugins/genom_standalone/standalone_component.h"

namespace runnel::genom_standalone {
namespace {

// A codel closes it while a client's request looks at it.
TEST(StandaloneMultiplePort, APortStaysWhileSomebodyLooksAtIt) {
  const ValueType number{.kind = ValueKind::kDouble, .memory = kMemory<double>};
  StandaloneMultiplePort ports(number, false);
  ports.Open("left")->Put(std::vector<double>{2.5}.data());
  const auto left = ports.Find("left");
  EXPECT_TRUE(ports.Close("left"));
  EXPECT_EQ(ports.Find("left"), nullptr);
  EXPECT_EQ(left->WithNewest([](const void* value) { return *static_cast<const double*>(value); }), 2.5);
}

}  // namespace
}  // namespace runnel::genom_standalone
