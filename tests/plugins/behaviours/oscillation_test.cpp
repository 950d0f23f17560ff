// What loops of inhibition do, and that the search for those that oscillate says the same.

#include "plugins/behaviours/network.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

/// As active as it may be.
class Eager final : public Behaviour {
 public:
  using Behaviour::Behaviour;

 private:
  std::optional<Outcome> Behave(double activation) override {
    return Outcome{.activity = activation, .target_rating = 0.5};
  }
};

class OscillationTest : public EditorTest {
 protected:
  OscillationTest() { Register<Eager>("test/eager"); }

  void Make(const std::vector<std::string>& names) {
    for (const std::string& each : names) {
      Must({CreateModule{"/app/" + each, "test/eager", {{"stimulation_mode", "enabled"}}}});
    }
  }
  void Inhibit(const std::string& who, const std::string& whom, bool is_late) {
    Must({ConnectPorts{"/app/" + who + "/activity", "/app/" + whom + "/inhibition1", {.late = is_late}}});
  }
  /// Of the behaviour, in the next cycles.
  std::string Activities(const std::string& of) {
    std::string all;
    for (int i = 0; i < 8; ++i) {
      Steps(1);
      At<Eager>("/app/" + of).activity.VisitLatest([&](const void* value, ValueTimes) {
        all += static_cast<const Activity*>(value)->value() > 0.5 ? '1' : '0';
      });
    }
    return all;
  }
  std::vector<NetworkFlaw> Found() { return FindOscillations(ReadNetwork(At<FrameworkElement>("/app"))); }
};

TEST_F(OscillationTest, OfTwoInOneThreadOneHoldsTheOtherDown) {
  for (const bool are_both_late : {false, true}) {
    Make({"one", "other"});
    Inhibit("one", "other", are_both_late);
    Inhibit("other", "one", true);
    (void)Activities("one");
    EXPECT_EQ(Activities("one"), "11111111");
    EXPECT_THAT(Found(), IsEmpty());
    Must({DeleteElement{"/app/one"}, DeleteElement{"/app/other"}});
  }
}

TEST_F(OscillationTest, ThreeWithTwoLateConnectionsGoOnAndOffTogether) {
  // In the order in which they run, "b" and "a" look at what "a" and "c" were.
  Make({"b", "a", "c"});
  Inhibit("a", "b", true);
  Must({ReplaceModule{"/app/c", "test/eager", {{"stimulation_mode", "auto"}}}});
  Must({ConnectPorts{"/app/b/activity", "/app/c/stimulation"}});
  Inhibit("c", "a", true);
  (void)Activities("a");
  EXPECT_THAT(Activities("a"), ::testing::AllOf(HasSubstr("01"), HasSubstr("10"))) << "without end";
  const auto found = Found();
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found.front().message, HasSubstr("2 of these can come a cycle late"));
}

TEST_F(OscillationTest, AnOddNumberOscillatesAlways) {
  Make({"one"});
  Inhibit("one", "one", true);
  EXPECT_THAT(Activities("one"), HasSubstr("0101"));
  EXPECT_THAT(Found(), SizeIs(1));
}

}  // namespace
}  // namespace runnel::test
