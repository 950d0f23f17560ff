// What a rule holds, when elements are made again.

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>

#include "plugins/network/network_engines.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application/state_trial.h"
#include "tests/support/fake_wire.h"

namespace runnel::test {
namespace {

// Rules act when something changes: what one holds is held when an undo has brought the port back.
TEST(HeldByRules, APortHasItsValueAgainAfterAnUndo) {
  TemporaryFolder folder;
  const auto file = folder.path() / "app.xml";
  std::ofstream(file) << kTrialText;
  setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
  AddWireEngine("fake", MakeFakeWire());
  static const double five = 5;
  Trial trial(file);
  Require(PublishByHand(trial.In(), &five, Port::Setter::kRule));
  trial.Do({CopyElement{trial.module, "n"}});
  trial.Do({DeleteElement{trial.module}});
  trial.Undo();
  ASSERT_FALSE(trial.is_refused) << trial.told;
  const auto held = trial.In().ValueByHand(Port::Setter::kRule);
  ASSERT_TRUE(held);
  EXPECT_EQ(*static_cast<const double*>(held->value.get()), five);
  EXPECT_FALSE(trial.At<Port>("/app/g/n/input/in").is_set_by_hand(Port::Setter::kRule)) << "no rule knows the copy";
}

// Rules that name what is gone would not load: who saves is told that the file loses them.
TEST(HeldByRules, ASaveTellsWhichOfThemTheFileLoses) {
  TemporaryFolder folder;
  const auto file = folder.path() / "app.xml";
  std::string text = kTrialText;
  text.insert(text.find("</application>"),
              "<on_stale input=\"sink/in\" after=\"1s\"><publish port=\"source/out\" value=\"0\"/></on_stale>\n");
  std::ofstream(file) << text;
  setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
  AddWireEngine("fake", MakeFakeWire());
  Trial trial(file);
  trial.Must({DeleteElement{"/app/source"}});
  ASSERT_TRUE(trial.application->Save({}));
  std::string told;
  for (const ApplicationEvent& each : trial.application->TakeEvents()) told += each.text + "\n";
  EXPECT_THAT(told, ::testing::HasSubstr("the file has lost <on_stale> of line 14, which names what is gone"));
}

}  // namespace
}  // namespace runnel::test
