#include <gmock/gmock.h>

#include "core/element/runtime.h"

namespace runnel {
namespace {

class ScopedNode : public FrameworkElement {
 public:
  explicit ScopedNode(const Placement& placement) : FrameworkElement(placement) {}
};

TEST(ChangeScopeTest, ListenersAreToldWhenAllIsDoneThatBelongsTogether) {
  class Counter final : public ElementListener {
   public:
    explicit Counter(Runtime& runtime) : runtime_(runtime) {}
    int ready = 0;
    int ready_when_told = -1;
    int ends = 0;
    bool was_in_scope = false;
    void OnReady(FrameworkElement&) override {
      ++ready;
      was_in_scope = runtime_.is_in_change_scope();
    }
    void OnChangesEnd() override {
      ++ends;
      ready_when_told = ready;
    }

   private:
    Runtime& runtime_;
  };
  Runtime runtime;
  Counter counter(runtime);
  runtime.AddListener(counter);
  {
    const ChangeScope changes(runtime);
    ASSERT_TRUE(runtime.MakeReady(runtime.Create<ScopedNode>(runtime.root(), "a")));
    {
      const ChangeScope inner(runtime);
      ASSERT_TRUE(runtime.MakeReady(runtime.Create<ScopedNode>(runtime.root(), "b")));
    }
    EXPECT_EQ(counter.ends, 0);
    EXPECT_TRUE(counter.was_in_scope);
  }
  EXPECT_EQ(counter.ends, 1);
  EXPECT_EQ(counter.ready_when_told, 2);
  EXPECT_FALSE(runtime.is_in_change_scope());
  ASSERT_TRUE(runtime.MakeReady(runtime.Create<ScopedNode>(runtime.root(), "c")));
  EXPECT_FALSE(counter.was_in_scope);
  EXPECT_EQ(counter.ends, 1);
  runtime.RemoveListener(counter);
}

}  // namespace
}  // namespace runnel
