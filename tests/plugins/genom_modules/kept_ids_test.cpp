// What components in C++ leave to the module that takes their place.

#include "plugins/genom_modules/kept_ids.h"

#include <vector>

#include "core/module/kept_state.h"
#include "core/types/type_info.h"
#include "tests/plugins/genom_modules/component_fixture.h"

namespace runnel::test {
namespace {

class CupTest : public ComponentTest {
 protected:
  CupTest() : ComponentTest("cup/cup") {}
};

TEST_F(CupTest, ListsAndTextsGoOverToAnother) {
  rig.RunCycle();
  EXPECT_EQ(Call("pour", "{drink: {name: tea, parts: [water, leaves], litres: 0.25}}"), "done");
  EXPECT_EQ(Call("pour", "{drink: {name: milk, parts: [], litres: 0.5}}"), "done");
  EXPECT_EQ(Call("set_level", "{level: [3], flags: [true, false]}"), "done");
  const std::string all = Call("get_all");
  EXPECT_THAT(all, HasSubstr("parts: [\"water\", \"leaves\"]"));
  ModuleRig<FrameworkElement> other("cup/cup", 10ms);
  const auto* const from = rig.module.FindAnnotation<KeptState>();
  auto* const to = other.module.FindAnnotation<KeptState>();
  ASSERT_TRUE(from != nullptr && to != nullptr);
  EXPECT_TRUE(to->Refusals(*from).empty());
  EXPECT_EQ(to->TakeOver(*from), 1u);
  Callable& get_all = *PortOf(other.module, "get_all").FindAnnotation<Callable>();
  const auto call = get_all.NewCall();
  ASSERT_EQ(call->Begin(other.now(), 10s), CallStatus::kPending);
  for (int i = 0; i < 10 && call->Poll(other.now()) == CallStatus::kPending; ++i) other.RunCycle();
  ASSERT_EQ(call->Poll(other.now()), CallStatus::kAnswered) << call->error();
  EXPECT_EQ(ToText(*get_all.reply(), call->reply()), all);
  EXPECT_EQ(Call("get_all"), all) << "the one that goes keeps them: it may come back";
}

TEST(KeptIdsTest, GoByTheDescriptionOfTheirViewToAnotherLibrary) {
  using Texts = std::vector<std::string>;
  using Kept = genom_modules::KeptIds<genom_execution::OwnedList<genom_execution::OwnedText>, Texts>;
  Texts one{"a", "some more words than fit into a small string"}, other{"left"};
  Kept from(one), to(other);
  const TypeInfo& type = TypeOf<Kept>();
  EXPECT_TRUE(type.is_transparent());
  ASSERT_TRUE(CopyValue(type, &from, &to));
  EXPECT_EQ(other, one);
  EXPECT_EQ(one.size(), 2u);
  one.clear();
  ASSERT_TRUE(CopyValue(type, &from, &to));
  EXPECT_TRUE(other.empty());
}

}  // namespace
}  // namespace runnel::test
