#pragma once

#include <chrono>

#include "core/port/port_stop.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {

/// Two speeds of a vehicle.
struct Speeds {
  double forward = 0;
  double turn = 0;
};
inline void Describe(TypeBuilder<Speeds>& type) {
  type.Name("test::Speeds")
      .Field("forward", &Speeds::forward, {.unit = "m/s"})
      .Field("turn", &Speeds::turn, {.unit = "rad/s"});
}

class StopTest : public PortTest {
 protected:
  StopTest() { clock.Set(At(10)); }

  static Time At(int milliseconds) { return Time(std::chrono::milliseconds(milliseconds)); }
  static InputOptions Drives() { return {.unit = "m/s", .drives = true}; }
  static void Set(Port& port, double number, Port::Setter setter = Port::Setter::kPerson) {
    const auto set = port.PublishByHand(
        [&](void* value) -> Result<void> {
          *static_cast<double*>(value) = number;
          return {};
        },
        setter);
    ASSERT_TRUE(set) << set.error().ToString();
  }
  void Press() { EXPECT_TRUE(runtime.robot_stop().Press("a test")); }
  void Release() {
    clock.Advance(std::chrono::milliseconds(1));
    EXPECT_TRUE(runtime.robot_stop().Release("a test"));
    clock.Advance(std::chrono::milliseconds(1));
  }
};

}  // namespace runnel::test
