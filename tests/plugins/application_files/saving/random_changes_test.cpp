// Whatever is done to an application: saved and loaded again it is the same.

#include <random>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "plugins/scheduling/thread_container.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

const char* const kStart = R"(<!-- first -->
<application name="demo" thread="main">
  <thread name="main" period="50ms"/>
  <thread name="other" activation="free_running"/>
  <clock type="simulated"/>
  <group name="g">   <!-- of g -->
    <port name="in" direction="input"/>
    <port name="out" direction="output" type="double"/>
    <group name="h">
      <module name="a" type="test/source" thread="other"/> <module name="b" type="test/sink"/>
      <connect from="a/value" to="b/value
                                  b/second"/>
    </group>
    <module name="m" type="test/sink"><parameter-less/></module>
    <connect from="in" to="m/value m/second h/b/second" queue="2"/>
  </group>
  <module name="s" type="test/source">
    <!-- stays -->
    <parameter name="gain" value="3.0"/>
  </module>
  <connect from="s/value" to="g/in"/><connect from="s/label" to="g/m/label"/>
</application>
)";

class Changer {
 public:
  Changer(SavingWorkshop& shop, FrameworkElement& application, unsigned seed)
      : shop_(shop), application_(application), random_(seed) {}

  void ChangeSomething() {
    switch (Below(9)) {
      case 0:
      case 1:
        return CreateModule();
      case 2:
        return CreateGroupOrPort();
      case 3:
        return DeleteSomething();
      case 4:
      case 5:
        return ConnectSomething();
      case 6:
        return DisconnectSomething();
      case 7:
        return SetSomething();
      default:
        return AssignSomething();
    }
  }

 private:
  std::size_t Below(std::size_t count) { return random_() % count; }

  template <typename T, typename Predicate>
  std::vector<T*> All(Predicate wanted) {
    std::vector<T*> found;
    application_.Visit([&](FrameworkElement& element) {
      auto* const each = dynamic_cast<T*>(&element);
      if (each != nullptr && wanted(*each)) found.push_back(each);
    });
    return found;
  }
  FrameworkElement& AnyGroup() {
    const auto groups = All<Group>([](const Group& group) { return group.name() != "threads"; });
    return *groups[Below(groups.size())];
  }
  std::string NewName(const FrameworkElement& parent) {
    // Few, so that what has been deleted comes again as something else.
    for (;;) {
      std::string name(1, static_cast<char>('a' + Below(26)));
      if (Below(4) == 0) name += "_2";
      if (parent.FindChild(name) == nullptr) return name;
    }
  }

  void CreateModule() {
    FrameworkElement& parent = AnyGroup();
    const char* const types[] = {"test/source", "test/sink", "test/optional"};
    ASSERT_TRUE(shop_.plugins.modules().Create(types[Below(3)], parent, NewName(parent)));
  }
  void CreateGroupOrPort() {
    FrameworkElement& parent = AnyGroup();
    if (&parent == &application_ || Below(3) == 0) {
      shop_.runtime.Create<Group>(parent, NewName(parent));
      return;
    }
    const auto direction = Below(2) == 0 ? Port::Direction::kInput : Port::Direction::kOutput;
    const TypeInfo& type = Below(3) == 0 ? TypeOf<std::string>() : TypeOf<double>();
    shop_.runtime.Create<ProxyPort>(parent, NewName(parent), direction, type, Below(2) == 0 ? "some <text>" : "");
  }
  void DeleteSomething() {
    const auto all = All<FrameworkElement>([&](const FrameworkElement& each) {
      if (&each == &application_ || each.name() == "threads") return false;
      const auto* const port = dynamic_cast<const Port*>(&each);
      return each.kind() == ElementKind::kModule || each.kind() == ElementKind::kGroup ||
             (port != nullptr && port->is_proxy());
    });
    if (all.size() < 4) return;
    ASSERT_TRUE(shop_.runtime.Delete(*all[Below(all.size())]));
  }
  // As a file may have it: an interface port passes on in one direction.
  void ConnectSomething() {
    const auto ports = All<Port>([](const Port&) { return true; });
    if (ports.empty()) return;
    for (int tries = 0; tries < 40; ++tries) {
      Port& from = *ports[Below(ports.size())];
      Port& to = *ports[Below(ports.size())];
      if (!FitsDirection(from, to, true) || !FitsDirection(to, from, false)) continue;
      const ConnectOptions options{.queue = Below(3), .on_full = Below(2) == 0 ? OnFull::kRefuse : OnFull::kDropOldest};
      if (Port::Connect(from, to, options)) return;
    }
  }
  static bool FitsDirection(const Port& port, const Port& other, bool sends) {
    if (!port.is_proxy()) return sends == (port.direction() == Port::Direction::kOutput);
    const bool is_inside = other.IsAtOrBelow(*port.parent());
    return sends == (is_inside == (port.direction() == Port::Direction::kInput));
  }
  void DisconnectSomething() {
    const auto ports = All<Port>([](const Port& port) { return !port.outgoing().empty(); });
    if (ports.empty()) return;
    const Port& from = *ports[Below(ports.size())];
    const Connection gone = from.outgoing()[Below(from.outgoing().size())];
    ASSERT_TRUE(Port::Disconnect(*gone.from, *gone.to));
  }
  void SetSomething() {
    const auto sources = All<Source>([](const Source&) { return true; });
    if (sources.empty()) return;
    Source& source = *sources[Below(sources.size())];
    if (Below(2) == 0 || source.life_cycle() == LifeCycle::kReady) {
      ASSERT_TRUE(source.gain.Set(static_cast<double>(Below(40)) / 4));
    } else {
      ASSERT_TRUE(source.text.SetFromText(Below(2) == 0 ? "a \"b\" & 'c'\n<d>\t" : ""));
    }
  }
  void AssignSomething() {
    const auto threads = All<ThreadContainer>([](const ThreadContainer&) { return true; });
    const auto all = All<FrameworkElement>([](const FrameworkElement& each) {
      return each.kind() == ElementKind::kModule || (each.kind() == ElementKind::kGroup && each.name() != "threads");
    });
    AssignThread(*all[Below(all.size())], *threads[Below(threads.size())]);
  }

  SavingWorkshop& shop_;
  FrameworkElement& application_;
  std::mt19937 random_;
};

TEST(RandomChanges, AreTheSameAfterSavingAndLoading) {
  const TestFolder folder;
  std::string start = kStart;
  start.erase(start.find("<parameter-less/>"), std::string("<parameter-less/>").size());
  for (unsigned seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const std::filesystem::path file = folder / "app.xml";
    WriteAll(file, start);
    SavingWorkshop shop;
    shop.Add<Optional>("test/optional");
    FrameworkElement* const application = shop.Load(file);
    ASSERT_NE(application, nullptr);
    Changer changer(shop, *application, seed);
    for (int save = 0; save < 4; ++save) {
      const int changes = 1 + static_cast<int>(seed % 12);
      for (int i = 0; i < changes; ++i) changer.ChangeSomething();
      const auto saved = SaveApplication(application->runtime(), *application, shop.tools());
      ASSERT_TRUE(saved) << saved.error().ToString();
      ExpectSame(*application, file, seed);
      if (::testing::Test::HasFatalFailure()) return;
    }
    ASSERT_THAT(ReadAll(file), ::testing::StartsWith("<!-- first -->\n"));
  }
}

TEST(RandomChanges, AreTheSameAfterWritingAWholeFile) {
  const TestFolder folder;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    SavingWorkshop shop;
    shop.Add<Optional>("test/optional");
    auto& application = shop.runtime.Create<Group>(shop.runtime.root(), "demo");
    auto& threads = shop.runtime.Create<Group>(application, "threads");
    shop.runtime.Create<ThreadContainer>(threads, "main");
    Changer changer(shop, application, seed);
    for (int i = 0; i < 40; ++i) changer.ChangeSomething();
    const std::filesystem::path file = folder / "new.xml";
    std::filesystem::remove(file);
    const auto saved = SaveApplication(application.runtime(), application, shop.tools(), file);
    ASSERT_TRUE(saved) << saved.error().ToString();
    ExpectSame(application, file, seed);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace runnel::testing
